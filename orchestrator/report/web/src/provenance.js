// Where it all comes from.
import { element, table } from "./page.js";

export function provenanceSection(report) {
  const entries = [
    ["run folder", report.run_folder], ["host", report.host], ["started", report.started], ["report written", report.file_written],
    ["random seed", report.random_seed], ["campaign", report.campaign_hash], ["mesh", report.mesh_hash],
    ...Object.entries(report.versions).map(([name, version]) => [name, version]),
  ].filter(([, value]) => value !== null && value !== undefined && value !== "");
  const results = report.results.map(({ episode, stage, attempt, state, file_hash: hash, sentence }) => [`${stage} ${episode}`, `${attempt}`, state, { text: hash ?? sentence ?? "", kind: "hash" }]);
  return [element("h2", {}, "Where this comes from"),
    element("div", { class: "panel" }, element("dl", {}, entries.map(([name, value]) => [element("dt", {}, name), element("dd", {}, String(value))]))),
    results.length ? element("div", { class: "panel" }, table("Stages and their results", ["stage", "attempt", "state", "content hash of result.hdf"], results)) : null,
    element("details", { class: "panel" }, element("summary", {}, "The campaign file"), element("pre", {}, report.campaign_text)),
    element("footer", {}, "Charts by Apache ECharts. All numbers, in SI units, stand in report.json beside this file.")].filter(Boolean);
}

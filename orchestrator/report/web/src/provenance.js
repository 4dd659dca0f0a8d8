// Where it all comes from.
import { element, table } from "./page.js";

const known = (value) => value !== null && value !== undefined && value !== "";

/** Every input and result of every stage with its hash. */
function filesPanel({ stages }) {
  const rows = stages.flatMap(({ stage, episode, inputs, files }) => [
    ...Object.entries(inputs ?? {}).map(([name, { file, hash }]) => [`${stage} ${episode}`, `in: ${name}`, file, hash]),
    ...Object.entries(files ?? {}).map(([file, { hash }]) => [`${stage} ${episode}`, "out", file, hash]),
  ]);
  if (!rows.length) return null;
  return element("details", { class: "panel" }, element("summary", {}, `Inputs and results of the stages: ${rows.length} files and their hashes`),
    table("", ["stage", "", "file in the run folder", "content hash (XXH3, 128 bit)"], rows));
}

function stagesPanel({ results, provenance }) {
  if (!results.length) return null;
  const rows = results.map(({ episode, stage, attempt, state, file_hash: hash, sentence }, index) => {
    const { ranks, random_seed: seed } = provenance.stages[index] ?? {};
    return [`${stage} ${episode}`, `${attempt}`, state, known(ranks) ? `${ranks}` : "–", known(seed) ? `${seed}` : "–", hash ?? sentence ?? ""];
  });
  return element("div", { class: "panel" }, table("Stages and their results", ["stage", "attempt", "state", "ranks", "random seed", "content hash of result.hdf"], rows));
}

export function provenanceSection(report) {
  const { provenance, versions } = report;
  const { cupola, ...libraries } = versions;
  const entries = [
    ["to compute it again", provenance.command], ["ranks", provenance.ranks_changed], ["run folder", report.run_folder], ["started", report.started], ["report written", report.file_written],
    ["host", provenance.hosts.join(", ")], ["started or resumed", provenance.starts.length === 1 ? "once" : `${provenance.starts.length} times`], ["random seed of the campaign", report.random_seed],
    ["campaign (hash)", report.campaign_hash], ["mesh (hash)", report.mesh_hash], ["cupola", cupola],
    ["built with", Object.entries(libraries).map(([name, version]) => `${name} ${version}`).join(", ")],
    ["changed by retries", provenance.advice.flatMap((changes) => Object.entries(changes).map(([key, value]) => `${key} = ${value}`)).join(", ")],
  ].filter(([, value]) => known(value));
  return [element("h2", {}, "Where this comes from"),
    element("div", { class: "panel" }, element("dl", {}, entries.map(([name, value]) => [element("dt", {}, name), element("dd", {}, String(value))]))),
    stagesPanel(report),
    filesPanel(provenance),
    element("details", { class: "panel" }, element("summary", {}, "The campaign file"), element("pre", { tabindex: "0" }, report.campaign_text)),
    element("footer", {}, "Charts by Apache ECharts. All numbers, in SI units, stand in report.json beside this file; fields for ParaView in the folder fields of the run.")].filter(Boolean);
}

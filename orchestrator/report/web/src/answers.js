// What a furnace engineer asks first.
import { element } from "./page.js";

const order = ["converged", "state_of_the_bed", "certainty", "wall_time"];
const kinds = { converged: "good", failed: "bad", running: "", queued: "", "not started": "" };

export function heading(report) {
  const kind = kinds[report.state] ?? "warn";
  return element("header", {},
    element("h1", {}, report.campaign),
    element("p", {}, element("span", { class: `badge ${kind}` }, report.state), ` \u2002${report.description}`));
}

export function answers(report) {
  return element("section", { class: "answers", "aria-label": "In short" }, order.map((key) => report.answers[key]).map(({ question, answer, detail }) =>
    element("div", { class: "answer" }, element("h3", {}, question), element("strong", {}, answer), element("p", {}, detail))));
}

export function warnings(report) {
  if (!report.warnings.length) return null;
  return element("section", { class: "warnings" }, element("h3", {}, "What to know before using these results"),
    element("ul", {}, report.warnings.map((text) => element("li", {}, text))));
}

// Strategy predict-and-verify: what was marched, what was not, what each step changed.
import { duration, kelvin, metres, percent } from "./format.js";
import { element, table } from "./page.js";

const known = (value) => value !== null && value !== undefined;

export function verifiedSection({ predict_and_verify: verified }) {
  if (!verified?.steps?.length) return null;
  const body = verified.steps.map((step) => [
    step.episode > 0 ? `episode ${step.episode}` : "before", step.what, kelvin(step.mean_solid_temperature), metres(step.cohesive_zone_height),
    step.marched_seconds > 0 ? duration(step.marched_seconds) : "–", known(step.wall_seconds) ? duration(step.wall_seconds) : "–",
    known(step.changed) ? percent(step.changed) : "–", step.sentence,
  ]);
  return [
    element("h2", {}, "Predicted and verified"),
    element("div", { class: "panel" },
      table("", ["", "step", "solids, mean", "zone, mean", "marched", "wall time", "changed", ""], body),
      element("p", {}, verified.sentence),
      element("p", {}, "Changes are rms differences of the temperatures over their rms above 293 K.")),
  ];
}

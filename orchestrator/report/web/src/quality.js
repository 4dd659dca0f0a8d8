// What the numbers rest on: the gas at the tuyeres, the scaling of the granular field, its cleaning, the time steps.
import { count, duration, kelvin, number, percent } from "./format.js";
import { element, table } from "./page.js";

const rows = [
  ["DEM speed over process speed", ({ tracer }) => (tracer?.scale > 0 ? number(1 / tracer.scale, 3) : undefined)],
  ["flux of what does not melt in mid-shaft against the raceways' removal", ({ tracer }) => tracer?.scale_check, (value) => `${value > 0 ? "+" : ""}${percent(value)}`],
  ["bed's gain in the averaging window over the removal", ({ tracer }) => tracer?.storage_over_removal, (value) => percent(value)],
  ["mass error of the granular field, as averaged", ({ tracer }) => tracer?.field_cleaning?.error_before, (value) => percent(value)],
  ["mass error of the granular field, cleaned", ({ tracer }) => tracer?.field_cleaning?.error_after, (value) => percent(value)],
  ["stagnant cells", ({ tracer }) => tracer?.stagnant_cells, count],
  ["largest overlap over radius", ({ dem }) => dem?.largest_overlap, (value) => percent(value)],
  ["DEM time step", ({ dem }) => dem?.time_step, (value) => `${number(1e6 * value, 3)} µs`],
  ["tracer time step", ({ tracer }) => tracer?.time_step, duration],
  ["gas flow solved, gas energy solved", ({ tracer }) => (tracer?.flow_solves > 0 ? `${count(tracer.flow_solves)}, ${count(tracer.energy_solves)}` : undefined)],
  ["gas: inertia over drag, largest of all cells", ({ tracer }) => tracer?.inertia_over_drag_largest, (value) => number(value, 2)],
  ["top gas", ({ tracer }) => tracer?.top_gas_temperature, kelvin],
];

const known = (value) => value !== undefined && value !== null;

function tuyeres({ episodes, furnace }) {
  const last = [...episodes].reverse().find(({ tracer }) => tracer?.inlets?.length);
  if (!last) return null;
  const body = last.tracer.inlets.map(({ name, velocity, mach, pressure }) => [name, `${number(velocity, 3)} m/s`, number(mach, 2), `${number(pressure / 1e3, 4)} kPa`]);
  return element("div", { class: "panel" }, table(`Tuyeres, episode ${last.index}`, ["", "gas velocity", "Mach number", "static pressure"], body),
    known(furnace.raceway_void) ? element("p", {}, `In the raceways the gas sees a void fraction of at least ${number(furnace.raceway_void, 2)}.`) : null);
}

export function qualitySection(report) {
  const { episodes } = report;
  const body = rows.map(([name, value, format = (text) => text]) => [name, ...episodes.map((episode) => (known(value(episode)) ? format(value(episode)) : "–"))])
    .filter(([, ...values]) => values.some((value) => value !== "–"));
  const panels = [tuyeres(report), body.length ? element("div", { class: "panel" }, table("By episode", ["", ...episodes.map(({ index }) => `episode ${index}`)], body)) : null].filter(Boolean);
  return panels.length ? [element("h2", {}, "What the numbers rest on"), ...panels] : null;
}

// How far from the end, by episode and criterion.
import { lines } from "./colours.js";
import { kelvin, metres, number, percent } from "./format.js";
import { element, figure, table } from "./page.js";
import { axis, legendHeight } from "./time_series.js";

const rules = [
  { key: "temperature", name: "temperature", figure: (value) => percent(value), wanted: ({ temperature }) => percent(temperature) },
  { key: "cohesive_zone", name: "cohesive zone", figure: (value) => `${number(value, 2)} cells`, wanted: ({ cohesive_zone }) => `${number(cohesive_zone, 2)} cells` },
  { key: "granular_velocity", name: "granular velocity", figure: (value) => `${number(value, 2)} σ`, wanted: ({ granular_velocity }) => `${number(granular_velocity, 2)} σ` },
];

const mark = (change) => (change === null || change === undefined ? undefined : change < 1 ? "good" : "bad");

function convergenceTable({ episodes, criteria }) {
  const used = rules.filter(({ key }) => episodes.some(({ change }) => change[key] !== null && change[key] !== undefined));
  const head = ["episode", "solids, mean", "zone: mean", "lowest", "highest", ...used.map(({ name, wanted }) => `${name} (below ${wanted(criteria)})`)];
  const body = episodes.map(({ index, mean_solid_temperature: mean, cohesive_zone: zone, change, figures }) => [
    `${index}`, kelvin(mean), metres(zone?.height_mean), metres(zone?.height_min), metres(zone?.height_max),
    ...used.map(({ key, figure: show }) => ({
      text: change[key] === null || change[key] === undefined ? "–" : figures?.[key] !== null && figures?.[key] !== undefined ? show(figures[key]) : `${number(change[key], 2)} × wanted`,
      kind: mark(change[key]),
    }))]);
  return table("", head, body);
}

export function convergenceSection(report) {
  const { episodes } = report;
  if (!episodes.length) return null;
  const judged = rules.map((rule) => ({ ...rule, points: episodes.map(({ index, change }) => [index, change[rule.key]]).filter(([, value]) => value > 0) })).filter(({ points }) => points.length);
  const children = [element("h2", {}, "Convergence")];
  if (judged.length) {
    children.push(element("div", { class: "charts" }, figure({
      name: "convergence", title: "Remaining change over what was asked for", height: 300,
      note: `Below 1 is met; ${report.criteria.for} episode${report.criteria.for === 1 ? "" : "s"} on end must meet all. Temperature and zone: the change still to come, extrapolated from successive episodes; velocity: difference of two measurements over their joint standard error.`,
      options: (drawing) => ({
        grid: { left: 62, right: 16, top: legendHeight(judged.map(({ name }) => name), drawing.clientWidth), bottom: 46 },
        legend: { top: 0, left: 0, textStyle: { color: "#3a4356" } },
        tooltip: { trigger: "axis", confine: true, valueFormatter: (value) => number(value, 3) },
        xAxis: axis("episode", { type: "category", nameGap: 28, data: episodes.map(({ index }) => `${index}`) }),
        yAxis: axis("change / criterion", { type: "log", nameGap: 44, axisLabel: { formatter: (value) => number(value, 1) } }),
        series: judged.map(({ name, points }, position) => ({
          name, type: "line", color: lines[position], symbol: ["circle", "rect", "triangle"][position], symbolSize: 9, lineStyle: { width: 2 },
          data: points.map(([index, value]) => [`${index}`, value]),
          markLine: position === 0 ? { silent: true, symbol: "none", lineStyle: { color: "#0b6e4f", width: 2, type: "solid" }, label: { formatter: "met below", position: "insideStartTop", color: "#0b6e4f" }, data: [{ yAxis: 1 }] } : undefined,
        })),
      }),
      rows: () => [["episode", ...rules.map(({ key }) => `${key}_change_over_criterion`)], ...episodes.map(({ index, change }) => [index, ...rules.map(({ key }) => change[key])])],
    })));
  }
  children.push(element("div", { class: "panel" }, convergenceTable(report),
    element("p", {}, "A change cannot be judged in the first episode, and an extrapolation needs three.")));
  return children;
}

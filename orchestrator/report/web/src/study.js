// The page of a study: error against wall time, by setting.
import { lines } from "./colours.js";
import { duration, number } from "./format.js";
import { element, figure, table } from "./page.js";
import { axis } from "./time_series.js";

const known = (value) => typeof value === "number" && Number.isFinite(value);
const title = (metric) => metric.name.replaceAll("_", " ");
const titled = (text) => text[0].toUpperCase() + text.slice(1);

/** An error as a person reads it: in per cent, or with its unit. */
const shown = (metric, value, digits = 3) => {
  if (!known(value)) return "–";
  return metric.unit === "1" ? `${number(100 * value, digits)} %` : `${number(value, digits)} ${metric.unit}`;
};
const scaled = (metric, value) => (metric.unit === "1" ? 100 * value : value);
const unit = (metric) => (metric.unit === "1" ? "%" : metric.unit);

const text = (value) => (typeof value === "number" ? number(value, 4) : typeof value === "string" ? value : JSON.stringify(value));

/** Settings in groups, a line each: all values but those of the axis with the most numbers. */
function groups({ axes, settings }) {
  const long = axes.reduce((best, one) => (one.values[0].length > (best?.values[0].length ?? 0) ? one : best), null);
  const others = axes.filter((one) => one !== long).flatMap(({ keys }) => keys);
  const found = new Map();
  for (const setting of settings) {
    const name = others.map((key) => `${key} = ${text(setting.values[key])}`).join(", ") || long.keys.join(", ");
    found.set(name, [...(found.get(name) ?? []), setting]);
  }
  return { long, found: [...found.entries()] };
}

/** Vertical bars of a standard error to both sides. */
const bars = (points, colour) => ({
  type: "custom", silent: true, z: 1, color: colour,
  data: points.filter(({ bar }) => known(bar) && bar > 0).map(({ x, y, bar }) => [x, Math.max(y - bar, y / 10), y + bar]),
  encode: { x: 0, y: [1, 2] },
  renderItem: (_, api) => {
    const [x, low] = api.coord([api.value(0), api.value(1)]);
    const high = api.coord([api.value(0), api.value(2)])[1];
    const line = (x1, y1, x2, y2) => ({ type: "line", shape: { x1, y1, x2, y2 }, style: { stroke: colour, lineWidth: 1.5 } });
    return { type: "group", children: [line(x, low, x, high), line(x - 4, low, x + 4, low), line(x - 4, high, x + 4, high)] };
  },
});

const pointsOf = (metric, settings) => settings
  .filter(({ wall_seconds: wall, errors }) => known(wall.mean) && known(errors[metric.name]?.mean) && errors[metric.name].mean > 0)
  .map((setting) => ({
    setting, x: setting.wall_seconds.mean, y: scaled(metric, setting.errors[metric.name].mean),
    bar: known(setting.errors[metric.name].standard_error) ? scaled(metric, setting.errors[metric.name].standard_error) : null,
  }));

function errorFigure(study, metric) {
  if (!pointsOf(metric, study.settings).length) return null;
  const { found } = groups(study);
  const knee = metric.knee === null ? null : study.settings[metric.knee];
  const front = pointsOf(metric, metric.front.map((index) => study.settings[index]));
  const marks = known(metric.noise) && metric.noise > 0 ? {
    silent: true, symbol: "none", lineStyle: { color: "#7b8494", type: [4, 4] },
    label: { formatter: "seeds of the reference", position: "insideStartBottom", color: "#5a6478" }, data: [{ yAxis: scaled(metric, metric.noise) }],
  } : undefined;
  return figure({
    name: `error_${metric.name}`, title: `${titled(title(metric))}: error against wall time`, height: 380,
    note: `Error: ${metric.norm}. Against ${study.reference}.${known(metric.noise) ? ` Broken line: how far the reference's own seeds lie apart, ${shown(metric, metric.noise)}; an error below it cannot be told from chance.` : ""} ${knee ? `Knee of the front: ${knee.label}.` : "The front has no knee."}`,
    options: () => ({
      grid: { left: 70, right: 24, top: 30 + 22 * Math.ceil((found.length + 1) / 2), bottom: 46 },
      legend: { top: 0, left: 0, itemWidth: 18, textStyle: { color: "#3a4356" } },
      tooltip: {
        trigger: "item", confine: true,
        formatter: ({ data }) => (data?.label ? `${data.label.text}` : ""),
      },
      xAxis: axis("wall time (s)", { type: "log", nameGap: 28, axisLabel: { formatter: (value) => number(value, 2) } }),
      yAxis: axis(`error (${unit(metric)})`, { type: "log", nameGap: 52, axisLabel: { formatter: (value) => number(value, 2) } }),
      series: [
        { name: "Pareto front", type: "line", step: "end", color: "#9aa3b2", showSymbol: false, silent: true, lineStyle: { width: 1.5, type: [6, 4] }, z: 0, data: front.map(({ x, y }) => [x, y]) },
        ...found.flatMap(([name, settings], position) => {
          const colour = lines[position % lines.length];
          const points = pointsOf(metric, settings);
          return [{
            name, type: "line", color: colour, symbol: "circle", symbolSize: 9, lineStyle: { width: 1.5 }, markLine: position === 0 ? marks : undefined,
            data: points.map(({ setting, x, y }) => ({
              value: [x, y], symbolSize: setting.index === metric.knee ? 17 : 9, symbol: setting.index === metric.knee ? "diamond" : "circle",
              label: { show: false, text: `${setting.label}: ${shown(metric, setting.errors[metric.name].mean)} in ${duration(x)}` },
            })),
          }, bars(points, colour)];
        }),
      ],
    }),
    rows: () => [["setting", "wall_time_s", "core_hours", `${metric.name}_error_${metric.unit === "1" ? "relative" : metric.unit}`, "standard_error", "runs", "on_front", "knee"],
      ...study.settings.map((setting) => [setting.label, setting.wall_seconds.mean, setting.core_hours.mean, setting.errors[metric.name]?.mean,
        setting.errors[metric.name]?.standard_error, setting.errors[metric.name]?.runs, metric.front.includes(setting.index), setting.index === metric.knee])],
  });
}

function settingsTable(study) {
  const head = ["setting", "state", "wall time", "core-hours", ...study.metrics.map((metric) => `${title(metric)}: error`), "knee of"];
  const body = study.settings.map((setting) => {
    const bad = setting.runs.filter(({ state }) => state !== "finished");
    const error = (metric) => {
      const { mean, standard_error: bar } = setting.errors[metric.name] ?? {};
      const own = known(mean) ? `${shown(metric, mean)}${known(bar) ? ` ± ${shown(metric, bar, 2)}` : ""}` : setting.is_reference ? "reference" : "–";
      return metric.front.includes(setting.index) ? { text: own, kind: "good" } : own;
    };
    const states = [...new Set(bad.map(({ state }) => state))].join(", ");
    return [setting.label, bad.length ? { text: study.seeds > 1 ? `${bad.length} of ${study.seeds} ${states}` : states, kind: "bad" } : "finished",
      duration(setting.wall_seconds.mean), number(setting.core_hours.mean, 3), ...study.metrics.map(error),
      study.metrics.filter(({ knee }) => knee === setting.index).map(title).join(", ")];
  });
  return table("", head, body);
}

/** Why runs failed, each reason once with the settings it hit. */
function failures(study) {
  const reasons = new Map();
  for (const { label, runs } of study.settings)
    for (const { seed, state, sentence } of runs)
      if (state === "failed") reasons.set(sentence, [...(reasons.get(sentence) ?? []), study.seeds > 1 ? `${label} (seed ${seed})` : label]);
  if (!reasons.size) return null;
  return element("ul", {}, [...reasons].map(([sentence, whose]) => element("li", {}, element("strong", {}, sentence), ` ${whose.join("; ")}`)));
}

function summary(study) {
  const runs = study.settings.flatMap(({ runs: all }) => all);
  const finished = runs.filter(({ state }) => state === "finished").length;
  const failed = runs.filter(({ state }) => state === "failed").length;
  const core = runs.reduce((sum, { core_hours: hours }) => sum + (hours ?? 0), 0);
  const shared = study.shared.reduce((sum, { wall_seconds: wall }) => sum + (wall ?? 0), 0);
  const entries = [
    ["what is varied", study.axes.map(({ keys }) => keys.join(" with ")).join("; ")],
    ["what is run for each setting", { dem: "a DEM stage", tracer: "a tracer stage", episode: "an episode", campaign: "a campaign" }[study.stage]],
    ["error against", study.reference],
    ["runs", `${finished} of ${runs.length} finished${failed ? `, ${failed} failed` : ""}; ${study.seeds} seed${study.seeds === 1 ? "" : "s"} a setting`],
    ["cost", `${number(core, 3)} core-hours${study.shared.length ? `; ${study.shared.length} stage${study.shared.length === 1 ? "" : "s"} shared by the settings took ${duration(shared)} more` : ""}`],
    ["where and when", `${study.host}, ${study.file_written}, cupola ${study.program_version}${study.jobs > 1 ? `; ${study.jobs} runs at a time, so that wall times are those of a shared machine` : ""}`],
  ];
  return element("div", { class: "panel" }, element("dl", {}, entries.map(([name, value]) => [element("dt", {}, name), element("dd", {}, value)])));
}

export function studyPage(study) {
  document.title = `${study.study}: study`;
  const figures = study.metrics.map((metric) => errorFigure(study, metric)).filter(Boolean);
  return [
    element("header", {}, element("h1", {}, study.study), element("p", {}, study.about || `Study over the scene ${study.scene}.`)),
    summary(study),
    figures.length ? element("h2", {}, "Error against run time") : null,
    figures.length ? element("div", { class: "charts" }, figures) : null,
    element("h2", {}, "Settings"),
    element("div", { class: "panel" }, settingsTable(study), element("p", {}, "Green: on the Pareto front, no other setting is both faster and nearer. ± is the standard error over the seeds."), failures(study)),
    element("details", { class: "panel" }, element("summary", {}, "The study file"), element("pre", { tabindex: "0" }, study.study_text)),
    element("footer", {}, "Charts by Apache ECharts. All numbers, in SI units, stand in study.json beside this file."),
  ].filter(Boolean);
}

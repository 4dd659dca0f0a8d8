// What each error is, how it fell with the time spent on it, and where the next hour would help most.
import { lines } from "./colours.js";
import { duration, number, percent } from "./format.js";
import { element, figure, table } from "./page.js";
import { axis, legendHeight } from "./time_series.js";

const kinds = [
  { key: "granular", name: "granular velocity: standard error" },
  { key: "time_step", name: "tracers' time step: estimate" },
  { key: "gas", name: "gas: heat not accounted for" },
];

/** Nobody needs to tell errors below this apart: they are drawn at the lower edge, %. */
const least = 1e-4;
const drawnAt = (error) => Math.max(100 * error, least);

/** Curves of all episodes as one line, broken between them. */
const points = (curves) => curves.flatMap(({ wall_seconds: wall, error }) => [...wall.map((x, i) => [x, error[i]]), [null, null]])
  .filter(([x, y]) => x === null || y > 0).map(([x, y]) => [x, x === null ? null : drawnAt(y)]);

const changes = ({ episodes }) => episodes.filter(({ temperature }) => temperature > 0).map(({ wall_seconds: wall, temperature }) => [wall, drawnAt(temperature)]);

function errorFigure(accuracy) {
  const series = kinds.filter(({ key }) => accuracy[key].length).map(({ key, name }, index) => ({
    name, type: "line", showSymbol: accuracy[key].every(({ error }) => error.length < 3), symbolSize: 7, connectNulls: false, color: lines[index], lineStyle: { width: 2 }, data: points(accuracy[key]),
  }));
  const episodes = changes(accuracy);
  if (episodes.length) series.push({ name: "temperature: change still to come", type: "line", symbol: "diamond", symbolSize: 11, color: lines[4], lineStyle: { width: 2, type: [6, 4] }, data: episodes });
  if (!series.length) return null;
  return figure({
    name: "accuracy", title: "Errors over the wall time spent", height: 340,
    note: "All relative. Granular velocity: standard error of the window so far, over the rms velocity. Time step: what halving it would change, from step doubling. Gas: residual of its energy ledger over the blast. Change still to come: by episode, extrapolated where three are done. What is below 0.0001 % is drawn there; the CSV has all digits.",
    options: (drawing) => ({
      grid: { left: 66, right: 20, top: legendHeight(series.map(({ name }) => name), drawing.clientWidth, 18), bottom: 46 },
      legend: { top: 0, left: 0, itemWidth: 18, textStyle: { color: "#3a4356" } },
      tooltip: { trigger: "axis", confine: true, valueFormatter: (value) => (value === null ? "–" : value <= least ? `at most ${number(least, 1)} %` : `${number(value, 3)} %`) },
      xAxis: axis("wall time of the stages (s)", { type: "value", nameGap: 28, min: 0 }),
      yAxis: axis("error (%)", { type: "log", nameGap: 50, min: series.some(({ data }) => data.some(([, y]) => y === least)) ? least : undefined, axisLabel: { formatter: (value) => number(value, 2) } }),
      series,
    }),
    rows: () => [["what", "episode", "window_s", "wall_time_s", "relative_error"],
      ...kinds.flatMap(({ key }) => accuracy[key].flatMap(({ episode, wall_seconds: wall, error, window_seconds: window }) => wall.map((x, i) => [key, episode, window?.[i], x, error[i]]))),
      ...accuracy.episodes.map(({ episode, wall_seconds: wall, temperature }) => ["change_of_temperature", episode, null, wall, temperature])],
  });
}

export function accuracySection({ accuracy }) {
  if (!accuracy) return null;
  const chart = errorFigure(accuracy);
  if (!chart && !accuracy.sources.length) return null;
  return [element("h2", {}, "Accuracy and cost"),
    chart ? element("div", { class: "charts" }, chart) : null,
    accuracy.sources.length ? element("div", { class: "panel" },
      element("p", {}, element("strong", {}, accuracy.where_an_hour_helps)),
      table("", ["source of error", "now", "wall time it cost", "after an hour more", "by"],
        accuracy.sources.map(({ name, error, wall_seconds: wall, after_an_hour: after, cure }) => [name, percent(error), duration(wall), percent(after), { text: cure, kind: "cure" }])),
      element("p", {}, "An hour more of the averaging window lowers a standard error with the square root of its length; of shorter tracer steps in proportion; of further episodes by their contraction. A granular error is one of the velocity, the others are of temperatures.")) : null,
  ].filter(Boolean);
}

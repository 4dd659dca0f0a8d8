// Curves over process time.
import { lines } from "./colours.js";
import { kelvin, metres, number, tick } from "./format.js";
import { figure } from "./page.js";

const hour = 3600;

/** Episodes one after the other on one time axis: offset of each in seconds. */
function offsets(episodes) {
  let sum = 0;
  return episodes.map(({ time }) => {
    const begin = sum;
    sum += time.length ? time[time.length - 1] : 0;
    return begin;
  });
}

/** One curve through all episodes, broken where a value is missing: [[x, value], …]. */
const joined = (episodes, key, divisor) => {
  const begins = offsets(episodes);
  return episodes.flatMap((episode, index) => (episode[key] ?? []).map((value, i) => [(begins[index] + episode.time[i]) / divisor, value]));
};

/** Thin lines where episodes begin, labelled below the frame's top. */
export const episodeMarks = (episodes, divisor) => ({
  silent: true, symbol: "none", animation: false,
  lineStyle: { color: "#9aa3b2", type: [4, 4], width: 1 },
  label: { formatter: "{b}", position: "insideEndTop", color: "#5a6478", fontSize: 11, rotate: 0, align: "left", offset: [4, 14] },
  data: offsets(episodes).map((begin, index) => ({ xAxis: begin / divisor, name: episodes.length > 9 ? `${episodes[index].episode}` : `ep. ${episodes[index].episode}` })),
});

export const axis = (name, extra = {}) => ({
  name, nameLocation: "middle", nameTextStyle: { color: "#5a6478" }, axisLine: { show: true, onZero: false, lineStyle: { color: "#7b8494" } },
  splitLine: { lineStyle: { color: "#eceff4" } }, ...extra,
  axisLabel: { color: "#3a4356", hideOverlap: true, ...(extra.type === "category" ? {} : { formatter: tick }), ...extra.axisLabel },
});

/** Height of a legend that stands above the grid, from its entries and the width it has. */
export function legendHeight(names, width, mark = 25) {
  let rows = 1;
  let used = 0;
  for (const name of names) {
    const entry = mark + 15 + 7 * name.length;
    if (used > 0 && used + entry > width) {
      rows += 1;
      used = 0;
    }
    used += entry;
  }
  return 22 * rows + 14;
}

/** Series over time with a legend. @param series [{name, key, colour}] */
export function timeOption({ episodes, series, divisor, xName, yName, format }) {
  return {
    grid: { left: 62, right: 16, top: series.length > 1 ? 36 : 14, bottom: 46 },
    legend: series.length > 1 ? { top: 0, left: 0, itemWidth: 18, textStyle: { color: "#3a4356" } } : undefined,
    tooltip: { trigger: "axis", confine: true, valueFormatter: (value) => format(value) },
    xAxis: axis(xName, { type: "value", nameGap: 28, min: 0, axisPointer: { label: { formatter: ({ value }) => number(value, 4) } } }),
    yAxis: axis(yName, { type: "value", scale: true, nameGap: 46 }),
    series: series.map(({ name, key, data, colour, dash }, index) => ({
      name, type: "line", showSymbol: false, connectNulls: false, sampling: "lttb",
      lineStyle: { width: 2, type: dash ?? "solid" }, color: colour ?? lines[index], data: data ?? joined(episodes, key, divisor),
      markLine: index === 0 ? episodeMarks(episodes, divisor) : undefined,
    })),
  };
}

export function seriesRows(episodes, keys) {
  const begins = offsets(episodes);
  return [["episode", "time_in_episode_s", "process_time_s", ...keys],
    ...episodes.flatMap((episode, index) => episode.time.map((time, i) =>
      [episode.episode, time, begins[index] + time, ...keys.map((key) => episode[key]?.[i])]))];
}

const has = (episodes, key) => episodes.some((episode) => episode[key]?.some((value) => value !== null));

export function temperatureFigure(report) {
  const episodes = report.charts.tracer_history;
  if (!has(episodes, "mean_solid_temperature")) return null;
  const series = [{ name: "solids, mean", key: "mean_solid_temperature" }, { name: "top gas", key: "top_gas_temperature" }]
    .filter(({ key }) => has(episodes, key));
  return figure({
    name: "temperature_history", title: "Temperature over process time", height: 320,
    note: "Heat-capacity weighted mean over all solids, and the gas that leaves. Each episode begins with new granular fields; steps at its begin are the hand-over.",
    options: () => timeOption({ episodes, series, divisor: hour, xName: "process time (h)", yName: "temperature (K)", format: kelvin }),
    rows: () => seriesRows(episodes, series.map(({ key }) => key)),
  });
}

export function zoneHeightFigure(report) {
  const episodes = report.charts.tracer_history;
  if (!has(episodes, "cohesive_zone_height")) return null;
  return figure({
    name: "zone_height_history", title: "Cohesive zone height over process time", height: 320,
    note: "Mean height at which the ore has melted, over all columns that hold the zone.",
    options: () => timeOption({
      episodes, series: [{ name: "height", key: "cohesive_zone_height", colour: lines[1] }], divisor: hour,
      xName: "process time (h)", yName: "height (m)", format: metres,
    }),
    rows: () => seriesRows(episodes, ["cohesive_zone_height"]),
  });
}

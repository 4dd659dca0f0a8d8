// The stages: parcels, wall time, sizes.
import { lines, many } from "./colours.js";
import { count, duration, number, words } from "./format.js";
import { element, figure, table } from "./page.js";
import { axis, seriesRows, timeOption } from "./time_series.js";

function parcelsFigure(report) {
  // A stage that begins by building the bed has no history of that: its time counts from the first line on.
  const episodes = report.charts.dem_history.map((episode) => ({ ...episode, time: episode.time.map((time) => time - episode.time[0]) }));
  if (!episodes.some(({ time }) => time.length)) return null;
  const species = report.furnace.species.filter((name) => episodes.some((episode) => episode[`parcels.${name}`]?.length));
  const keys = ["parcels", ...species.map((name) => `parcels.${name}`)];
  return figure({
    name: "parcels", title: "Parcels in the DEM stages", height: 300,
    note: "All parcels in the furnace and its charging hopper, over the process time of the DEM stages, one after the other, without the building of the first bed.",
    options: () => timeOption({
      episodes, divisor: 1, xName: "process time (s)", yName: "parcels", format: count,
      series: keys.map((key, index) => ({ name: key === "parcels" ? "all" : key.slice("parcels.".length), key, colour: index === 0 ? "#1d2433" : lines[index - 1] })),
    }),
    rows: () => seriesRows(episodes, keys),
  });
}

/** Wall time of every stage, split by part; what no part claims is `other`. */
function wallTimes(report) {
  return report.episodes.flatMap(({ index, dem, predict, tracer, correct }) => [["DEM", dem], ["prediction", predict], ["tracer", tracer], ["correction", correct]].filter(([, stage]) => stage?.wall_seconds).map(([name, stage]) => {
    const parts = { ...(stage.wall_seconds_by_part ?? {}) };
    const claimed = Object.values(parts).reduce((sum, value) => sum + value, 0);
    if (stage.wall_seconds - claimed > 0.01 * stage.wall_seconds) parts.other = stage.wall_seconds - claimed;
    return { name: `${name} ${index}`, parts };
  }));
}

function wallTimeFigure(report) {
  const stages = wallTimes(report);
  if (!stages.length) return null;
  const total = (part) => stages.reduce((sum, stage) => sum + (stage.parts[part] ?? 0), 0);
  const parts = [...new Set(stages.flatMap((stage) => Object.keys(stage.parts)))].sort((a, b) => (a === "other") - (b === "other") || total(b) - total(a));
  return figure({
    name: "wall_time", title: "Wall time by stage and part", height: 100 + 26 * stages.length,
    note: `${duration(report.wall_seconds)} in all.`,
    options: (drawing) => {
      const legend = 22 * Math.ceil((parts.length * 105) / Math.max(drawing.clientWidth, 105)) + 8;
      drawing.style.height = `${70 + legend + 26 * stages.length}px`;
      return {
        grid: { left: 70, right: 20, top: legend, bottom: 46 },
        legend: { top: 0, left: 0, itemWidth: 14, textStyle: { color: "#3a4356" } },
        tooltip: { trigger: "axis", axisPointer: { type: "shadow" }, confine: true, valueFormatter: (value) => duration(value) },
        xAxis: axis("wall time (s)", { type: "value", nameGap: 28 }),
        yAxis: axis("", { type: "category", inverse: true, data: stages.map(({ name }) => name), splitLine: { show: false } }),
        series: parts.map((part, index) => ({
          name: words(part), type: "bar", stack: "all", color: part === "other" ? "#b6bdc9" : many[index % many.length], barWidth: 16,
          data: stages.map((stage) => stage.parts[part] ?? 0), itemStyle: { borderColor: "#fff", borderWidth: 0.5 },
        })),
      };
    },
    rows: () => [["stage", ...parts.map((part) => `${part}_s`)], ...stages.map((stage) => [stage.name, ...parts.map((part) => stage.parts[part])])],
  });
}

function stageTable({ episodes }) {
  const rows = episodes.flatMap(({ index, dem, tracer }) => [
    dem && [`DEM ${index}`, `${count(dem.parcels)} parcels`, count(dem.cells), count(dem.ranks), duration(dem.process_seconds), duration(dem.wall_seconds), number(dem.process_seconds / dem.wall_seconds, 3), count(dem.attempts)],
    tracer && [`tracer ${index}`, `${count(tracer.tracers)} tracers`, count(tracer.cells), count(tracer.ranks), duration(tracer.process_seconds), duration(tracer.wall_seconds), number(tracer.process_seconds / tracer.wall_seconds, 3), count(tracer.attempts)],
  ].filter(Boolean));
  return table("", ["stage", "size", "cells", "ranks", "process time", "wall time", "process s per wall s", "attempts"], rows);
}

export function stagesSection(report) {
  const figures = [parcelsFigure(report), wallTimeFigure(report)].filter(Boolean);
  if (!figures.length && !report.episodes.length) return null;
  return [element("h2", {}, "The stages and what they cost"),
    figures.length ? element("div", { class: "charts" }, figures) : null,
    element("div", { class: "panel" }, stageTable(report))].filter(Boolean);
}

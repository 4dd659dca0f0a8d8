// Drawings of the furnace to scale: outlines of the cohesive zone, maps of the mid-plane.
import { empty, episodeColour, ramp, rampGradient } from "./colours.js";
import { kelvin, metres, number } from "./format.js";
import { element, figure, redraw } from "./page.js";
import { axis } from "./time_series.js";

const episodeName = (episode) => (episode === 0 ? "prediction" : `episode ${episode}`);

const margins = { left: 44, right: 10, top: 8, bottom: 40 };

/** Both sides of the profile as one closed line. */
const wallLine = ({ profile }) => [
  ...profile.map(([z, half]) => [half, z]), ...[...profile].reverse().map(([z, half]) => [-half, z]), [profile[0][1], profile[0][0]],
];

/** Frame in which a metre is as long across as it is up; sets the drawing's height. */
function scaled(drawing, { profile }, greatestHeight) {
  const half = 1.06 * Math.max(...profile.map(([, width]) => width));
  const [bottom, top] = [profile[0][0], profile[profile.length - 1][0]];
  const margin = 0.02 * (top - bottom);
  const room = drawing.clientWidth - margins.left - margins.right;
  const height = top - bottom + 2 * margin;
  const scale = Math.min(room / (2 * half), (greatestHeight - margins.top - margins.bottom) / height);
  const size = { width: 2 * half * scale, height: height * scale };
  drawing.style.height = `${size.height + margins.top + margins.bottom}px`;
  return {
    grid: { left: margins.left + (room - size.width) / 2, top: margins.top, ...size },
    xAxis: axis("x (m)", { type: "value", min: -half, max: half, nameGap: 24, splitNumber: 4, axisLabel: { showMinLabel: false, showMaxLabel: false }, splitLine: { show: false } }),
    yAxis: axis("height z (m)", { type: "value", min: bottom - margin, max: top + margin, nameGap: 28, axisLabel: { showMinLabel: false, showMaxLabel: false }, splitLine: { show: false } }),
  };
}

/** Wall, stock line, raceways and tuyeres, drawn over everything else. */
function furnaceSeries(furnace, dark) {
  const thin = { silent: true, symbol: "none", type: "line", showSymbol: false, z: 5, tooltip: { show: false } };
  const series = [{ ...thin, name: "wall", data: wallLine(furnace), lineStyle: { color: "#1d2433", width: 2 }, color: "#1d2433" }];
  if (furnace.stock_line !== null) {
    const half = furnace.stock_half_width;
    series.push({ ...thin, name: "stock line", data: [[-half, furnace.stock_line], [half, furnace.stock_line]], lineStyle: { color: "#5a6478", width: 1.2, type: [6, 3] }, color: "#5a6478" });
  }
  furnace.raceways.forEach(([x0, x1, z0, z1]) => series.push({
    ...thin, name: "raceway", data: [[x0, z0], [x1, z0], [x1, z1], [x0, z1], [x0, z0]],
    lineStyle: { color: dark ? "#ffffff" : "#D55E00", width: 1.4, type: [3, 2] }, color: "#D55E00",
  }));
  if (furnace.tuyeres.length) {
    series.push({
      silent: true, type: "scatter", name: "tuyere", z: 6, symbol: "triangle", symbolSize: 11, color: "#D55E00",
      data: furnace.tuyeres.map(({ x, z }) => ({ value: [x, z], symbolRotate: x < 0 ? -90 : 90, symbolOffset: [x < 0 ? -6 : 6, 0] })),
    });
  }
  return series;
}

/** Guessed zone z = tip - slope |x|, clipped to the furnace. */
function guessedZone({ guessed_zone: zone, profile }) {
  const half = Math.max(...profile.map(([, width]) => width));
  return [-half, 0, half].map((x) => [x, zone.tip - zone.slope * Math.abs(x)]).filter(([, z]) => z >= profile[0][0]);
}

export function zoneFigure(report) {
  const { furnace } = report;
  const zones = report.charts.cohesive_zones;
  if (!zones.length) return null;
  const last = zones[zones.length - 1];
  const outlines = zones.map((zone, index) => ({
    name: episodeName(zone.episode), type: "line", showSymbol: false, connectNulls: false, z: 7,
    data: zone.x.map((x, i) => [x, zone.height_melted[i]]), color: episodeColour(index, zones.length),
    lineStyle: { width: zone === last ? 3.5 : 1.8 },
  }));
  if (last.height_softened.some((z) => z !== null)) {
    outlines.push({
      name: `softening, ${episodeName(last.episode)}`, type: "line", showSymbol: false, connectNulls: false, z: 7,
      data: last.x.map((x, i) => [x, last.height_softened[i]]), color: episodeColour(zones.length - 1, zones.length), lineStyle: { width: 1.8, type: "dotted" },
    });
  }
  if (furnace.guessed_zone) {
    outlines.unshift({ name: "guess at the start", type: "line", showSymbol: false, z: 6, data: guessedZone(furnace), color: "#7b8494", lineStyle: { width: 1.6, type: "dashed" } });
  }
  return figure({
    name: "cohesive_zones", title: "Cohesive zone by episode",
    note: `Where the ore reaches its melting temperature, ${kelvin(furnace.melting_temperature)}, over the furnace's profile, to scale. Dark is last. A gap: no melting ore in that column.`,
    options: (drawing) => {
      const rowsOfLegend = Math.ceil((outlines.length * 150) / Math.max(drawing.clientWidth, 150));
      const legend = 22 * rowsOfLegend + 6;
      const frame = scaled(drawing, furnace, drawing.clientWidth > 450 ? 660 : 560);
      drawing.style.height = `${parseFloat(drawing.style.height) + legend}px`;
      frame.grid.top += legend;
      return {
        ...frame,
        legend: { top: 0, left: 0, itemWidth: 22, data: outlines.map(({ name }) => name), textStyle: { color: "#3a4356" } },
        tooltip: { trigger: "item", confine: true },
        series: [...outlines.map((line) => ({ ...line, tooltip: { formatter: ({ seriesName, value }) => `${seriesName}<br>x ${metres(value[0])}, z ${metres(value[1])}` }, showSymbol: true, symbol: "circle", symbolSize: line.lineStyle.width + 0.5 })), ...furnaceSeries(furnace, false)],
      };
    },
    rows: () => [["episode", "x_m", "height_melted_m", "height_softened_m"],
      ...zones.flatMap((zone) => zone.x.map((x, i) => [zone.episode, x, zone.height_melted[i], zone.height_softened[i]]))],
  });
}

/** Limits that all episodes share, so that maps of two episodes can be compared. */
function limits(maps, keys, logarithmic) {
  const values = maps.episodes.flatMap(({ fields }) => keys.flatMap((key) => fields[key] ?? [])).filter((value) => value !== null && (!logarithmic || value > 0));
  const sorted = Float64Array.from(values).sort();
  if (!sorted.length) return [0, 1];
  // One odd cell must not wash the picture out; it is drawn in the end colour.
  const at = (fraction) => sorted[Math.round(fraction * (sorted.length - 1))];
  const [low, high] = logarithmic ? [Math.max(at(0.03), at(0.995) / 1e3), at(0.995)] : [at(0.002), at(0.998)];
  return high > low ? [low, high] : [low, low + (Math.abs(low) || 1)];
}

const kinds = [
  { key: "solids_temperature", title: "Solids temperature", unit: "K", ramp: "inferno", share: ["solids_temperature", "gas_temperature"], format: kelvin },
  { key: "gas_temperature", title: "Gas temperature", unit: "K", ramp: "inferno", share: ["solids_temperature", "gas_temperature"], format: kelvin },
  { key: "solids_fraction", title: "Solids fraction", unit: "1", ramp: "viridis", share: ["solids_fraction"], format: (value) => number(value, 3) },
  { key: "solids_speed", title: "Speed of the solids", unit: "mm/s", ramp: "viridis", share: ["solids_speed"], logarithmic: true, factor: 1e3, format: (value) => `${number(1e3 * value, 3)} mm/s` },
];

function colourBar({ unit, factor = 1, ramp: name, logarithmic }, [low, high]) {
  const at = (fraction) => factor * (logarithmic ? low * (high / low) ** fraction : low + fraction * (high - low));
  const ramped = element("div", { class: "ramp" });
  ramped.style.background = rampGradient(name);
  return element("div", { class: "colour-bar" }, ramped,
    element("div", { class: "ticks" }, [0, 1 / 3, 2 / 3, 1].map((fraction) => element("span", {}, number(at(fraction), logarithmic ? 2 : unit === "K" && at(fraction) >= 1000 ? 4 : 3)))),
    element("div", { class: "ticks" }, element("span", {}, `${unit === "1" ? "volume of solids over volume" : unit}${logarithmic ? ", logarithmic" : ""}`)));
}

export function mapsSection(report) {
  const { maps, cohesive_zones: zones } = report.charts;
  if (!maps.episodes.length) return null;
  const { furnace } = report;
  let shown = maps.episodes[maps.episodes.length - 1];
  const present = kinds.filter(({ key }) => maps.episodes.some(({ fields }) => fields[key]));
  const figures = present.map((kind) => {
    const [low, high] = limits(maps, kind.share, kind.logarithmic);
    const fraction = (value) => (kind.logarithmic ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low));
    const colour = (value) => (value === null || value === undefined || (kind.logarithmic && value <= 0) ? empty : ramp(kind.ramp, fraction(value)));
    const values = () => shown.fields[kind.key] ?? [];
    return figure({
      name: `map_${kind.key}`, title: kind.title, renderer: "canvas", below: [colourBar(kind, [low, high])],
      options: (drawing) => {
        const zone = kind.unit === "K" ? zones.find(({ episode }) => episode === shown.episode) : undefined;
        return {
          ...scaled(drawing, furnace, 520),
          tooltip: { trigger: "item", confine: true, formatter: ({ dataIndex }) => `x ${metres(maps.x_centre[dataIndex])}, z ${metres(maps.z_centre[dataIndex])}<br><b>${values()[dataIndex] === null ? "no solids" : kind.format(values()[dataIndex])}</b>` },
          series: [
            {
              type: "custom", progressive: 0, clip: true, data: maps.x.map((_, index) => [maps.x_centre[index], maps.z_centre[index]]),
              renderItem: ({ dataIndex }, api) => {
                const fill = colour(values()[dataIndex]);
                // A hairline of the cell's own colour closes the seams between neighbours.
                return { type: "polygon", shape: { points: maps.x[dataIndex].map((x, i) => api.coord([x, maps.z[dataIndex][i]])) }, style: { fill, stroke: fill, lineWidth: 0.6 } };
              },
            },
            ...(zone ? [{ type: "line", name: "melting", silent: true, showSymbol: false, connectNulls: false, z: 7, data: zone.x.map((x, i) => [x, zone.height_melted[i]]), color: "#56d0ff", lineStyle: { color: "#56d0ff", width: 2 } }] : []),
            ...furnaceSeries(furnace, true),
          ],
        };
      },
      rows: () => [["episode", "x_m", "z_m", `${kind.key}_SI`], ...values().map((value, i) => [shown.episode, maps.x_centre[i], maps.z_centre[i], value])],
    });
  });
  const choice = element("select", {
    id: "map-episode",
    onchange: ({ target }) => {
      shown = maps.episodes.find(({ episode }) => String(episode) === target.value);
      redraw(present.map(({ key }) => `map_${key}`));
    },
  }, maps.episodes.map(({ episode }) => element("option", { value: episode, ...(episode === shown.episode ? { selected: "" } : {}) }, episode === 0 ? "prediction" : `${episode}`)));
  const note = `Cells cut by the plane y = ${metres(maps.y)}. Fields are means over the last layer passage; velocities are scaled to the descent rate. ` +
    `${present.some(({ unit }) => unit === "K") ? "Blue line: the ore has melted. " : ""}Grey: above the stock line.`;
  return [element("h2", {}, "Fields in the mid-plane"),
    element("div", { class: "choose" }, element("label", { for: "map-episode" }, "Episode"), choice, element("span", {}, note)),
    element("div", { class: "maps" }, figures)];
}

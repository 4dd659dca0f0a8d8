// Where mass and heat came from and went, by tracer stage.
import { count, energyUnit, massUnit, number, percent, words } from "./format.js";
import { element, table } from "./page.js";

/** Nested numbers as paths: {out: {raceway: 1}} -> ["out/raceway", 1]. */
const flat = (ledger, prefix = "") => Object.entries(ledger ?? {}).flatMap(([key, value]) =>
  typeof value === "object" && value !== null ? flat(value, `${prefix}${key}/`) : [[`${prefix}${key}`, value]]);

// What is known by name comes in this order; what a later program adds follows.
const massRows = [
  ["in", "in: charged"], ["out/melted", "out: melted"], ["out/raceway", "out: removed in the raceways"], ["out/unmelted", "out: did not melt in time"],
  ["out/lost", "out: lost by the model"], ["stored", "stored in the bed"],
];
const heatRows = [
  ["blast", "in: blast"], ["charge", "in: charge"], ["top_gas", "out: top gas"], ["melt", "out: melt"], ["removed_coke", "out: removed in the raceways"],
  ["unmelted", "out: ore that did not melt"], ["lost", "out: lost by the model"], ["walls", "out: through the walls"], ["stored", "stored in the bed"],
];
const heatAside = [["to_solids", "gas to solids"], ["handover", "hand-over from the episode before"]];

function rowsOf(columns, known) {
  const rest = [...new Set(columns.flatMap(({ values }) => [...values.keys()]))].filter((key) => key !== "residual" && !known.some(([name]) => name === key));
  return [...known, ...rest.map((key) => [key, words(key).replaceAll("/", ": ")])].filter(([key]) => columns.some(({ values }) => values.has(key)));
}

function ledgerPanel({ title, note, episodes, kind, unitOf, known, aside, residual }) {
  const columns = episodes.filter(({ tracer }) => tracer?.ledger?.[kind]).map(({ index, tracer }) => ({ index, values: new Map(flat(tracer.ledger[kind])), residual: tracer[residual] }));
  if (!columns.length) return null;
  const [size, unit] = unitOf(columns.flatMap(({ values }) => [...values.values()]));
  const line = ([key, name]) => [name, ...columns.map(({ values }) => number(values.get(key) / size, 4))];
  const asideKeys = aside.map(([key]) => key);
  const rows = rowsOf(columns, [...known, ...aside]);
  const body = [
    ...rows.filter(([key]) => !asideKeys.includes(key)).map(line),
    { kind: "total", cells: ["not accounted for", ...columns.map(({ residual: share }) => percent(share))] },
    ...rows.filter(([key]) => asideKeys.includes(key)).map(line),
  ];
  return element("div", { class: "panel" }, table(`${title} (${unit})`, ["", ...columns.map(({ index }) => `episode ${index}`)], body), element("p", {}, note));
}

function clampPanel(episodes) {
  const columns = episodes.filter(({ tracer }) => tracer?.clamps).map(({ index, tracer }) => ({ index, values: new Map(flat(tracer.clamps)) }));
  if (!columns.length) return null;
  return element("div", { class: "panel" }, table("Limits of the model, how often they were met", ["", ...columns.map(({ index }) => `episode ${index}`)],
    rowsOf(columns, [["void_fraction_cells", "cells denser than the gas model allows, at the end"]]).map(([key, name]) => [name, ...columns.map(({ values }) => count(values.get(key)))])));
}

export function ledgerSection({ episodes }) {
  const panels = [
    ledgerPanel({
      title: "Solids", episodes, kind: "mass", unitOf: massUnit, known: massRows, aside: [], residual: "mass_residual",
      note: "Mass of solids in the tracer stage. Stored: what the bed holds more at the end than at the beginning. Not accounted for: share of the charge.",
    }),
    ledgerPanel({
      title: "Heat", episodes, kind: "energy", unitOf: energyUnit, known: heatRows, aside: heatAside, residual: "energy_residual",
      note: "Enthalpies from 293 K. Not accounted for: share of the blast's enthalpy. Hand-over: what changes when an episode's tracers take the bed over from the last one's.",
    }),
    clampPanel(episodes),
  ].filter(Boolean);
  return panels.length ? [element("h2", {}, "Mass and heat"), ...panels] : null;
}

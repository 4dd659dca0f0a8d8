// Holds the figures of a study against committed ones: node compare_figures.mjs STUDY_JSON FIGURES_JSON [--accept]
// A bed of grains is chaotic, and another processor adds up otherwise: figures may differ by what two beds differ by, the error of the
// temperature by a factor of three.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";

const allowed = { temperature: 0.1, cohesive_zone: 0.4, descent: 0.4, pressure_drop: 0.25, top_gas_temperature: 0.15 };
const [results, figuresFile, accept] = process.argv.slice(2);
const study = JSON.parse(readFileSync(results, "utf8"));
const found = Object.fromEntries(study.settings.filter(({ runs }) => runs.every(({ state }) => state === "finished"))
  .map(({ label, figures, errors }) => [label, Object.fromEntries(study.metrics.map(({ name }) => [name, { figure: figures[name].mean, error: errors[name].mean }]))]));
if (accept) {
  writeFileSync(figuresFile, `${JSON.stringify(found, null, 2)}\n`);
} else {
  const wanted = JSON.parse(readFileSync(figuresFile, "utf8"));
  assert.deepEqual(Object.keys(found), Object.keys(wanted), "the settings that finished");
  for (const [label, metrics] of Object.entries(wanted))
    for (const [name, { figure, error }] of Object.entries(metrics)) {
      const now = found[label][name];
      assert(Math.abs(now.figure - figure) <= allowed[name] * Math.abs(figure), `${label}: ${name} is ${now.figure}, was ${figure}: the figures are stale`);
      assert.equal(now.error === null, error === null, `${label}: ${name}`);
      if (error > 0 && name === "temperature") assert(now.error < 3 * error && now.error > error / 3, `${label}: error of ${name} is ${now.error}, was ${error}: the figures are stale`);
    }
}
console.log(`${Object.keys(found).length} settings`);

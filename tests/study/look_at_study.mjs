// What study.json of tests/study/study.yaml must say: node look_at_study.mjs STUDY_JSON
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";

const study = JSON.parse(readFileSync(process.argv[2], "utf8"));
assert.equal(study.kind, "study");
assert.equal(study.settings.length, 6);
const good = study.settings.filter(({ si }) => si["dem.limits.overlap"] === 0.3);
const bad = study.settings.filter(({ si }) => si["dem.limits.overlap"] !== 0.3);

for (const { runs } of bad)
  for (const { state, sentence } of runs) {
    assert.equal(state, "failed");
    assert.match(sentence, /overlap/, "a failed row says why");
  }
const reference = good.find(({ is_reference: is }) => is);
assert.equal(reference.si["tracer.time_step"], 10);
for (const setting of good) {
  assert.equal(setting.runs.length, 2);
  for (const { state, notes, figures } of setting.runs) {
    assert.equal(state, "finished");
    assert(notes.steps > 0 && figures.temperature > 293 && figures.pressure_drop > 0 && figures.descent > 0);
    assert(figures.top_gas_temperature > 293 && figures.cohesive_zone > 0);
  }
  assert(setting.core_hours.mean > 0);
}
const error = (seconds, metric) => good.find(({ si }) => si["tracer.time_step"] === seconds).errors[metric];
assert.equal(error(10, "temperature").mean, null, "the reference has no error against itself");
for (const metric of ["temperature", "cohesive_zone", "top_gas_temperature"]) {
  assert(error(150, metric).mean > 0 && error(50, metric).mean > 0, `${metric}: another step, another answer`);
  assert(error(150, metric).standard_error >= 0 && error(150, metric).runs === 2);
}
assert(error(150, "temperature").mean > error(50, "temperature").mean, "a longer step is worse");
// One granular field: what does not depend on the tracer step is the same to the last bit.
assert.equal(error(150, "descent").mean, 0);
for (const { name, front, knee, noise } of study.metrics) {
  assert(front.length >= 1, `${name}: no Pareto front`);
  assert(noise === null || noise >= 0);
  if (knee !== null) assert(front.includes(knee));
}
assert(study.metrics.find(({ name }) => name === "descent").noise > 0, "two seeds of a DEM stage differ");
assert.equal(study.shared.length, 2);
console.log(good.map(({ label, wall_seconds: wall, errors }) => `${label}: ${wall.mean.toFixed(2)} s, temperature ${errors.temperature.mean}`).join("\n"));

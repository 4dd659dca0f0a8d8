// Compares two report.json, numbers within a relative tolerance (0: bit for bit), without what depends on the day and the machine.
//   node compare_reports.mjs A B [TOLERANCE] [KEY,KEY…: of no interest either]
import { readFileSync } from 'node:fs';

const [fileA, fileB, toleranceText, otherKeys] = process.argv.slice(2);
const tolerance = Number(toleranceText ?? 0);
// The hash of a result is among it: its summary holds wall times; so is everything that is said about where a run was made.
const ofTheDay = new Set([
  'wall_seconds', 'wall_seconds_by_part', 'wall_time', 'started', 'file_written', 'file_hash', 'host', 'run_folder',
  'provenance', 'hash', 'imbalance', 'after_an_hour', 'where_an_hour_helps',
  ...(otherKeys ?? '').split(','),
]);
const differences = [];

function compare(a, b, path) {
  if (typeof a === 'number' && typeof b === 'number') {
    const scale = Math.max(Math.abs(a), Math.abs(b));
    if (!Object.is(a, b) && Math.abs(a - b) > tolerance * scale) differences.push(`${path}: ${a} and ${b}`);
  } else if (a !== null && b !== null && typeof a === 'object' && typeof b === 'object') {
    for (const key of new Set([...Object.keys(a), ...Object.keys(b)]))
      if (Array.isArray(a) || !ofTheDay.has(key)) compare(a[key], b[key], `${path}/${key}`);
  } else if (a !== b) {
    differences.push(`${path}: ${JSON.stringify(a)} and ${JSON.stringify(b)}`);
  }
}

compare(JSON.parse(readFileSync(fileA)), JSON.parse(readFileSync(fileB)), '');
if (differences.length > 0) {
  console.error(`${fileA} and ${fileB} differ in ${differences.length} places:`);
  for (const difference of differences.slice(0, 40)) console.error(`  ${difference.slice(0, 300)}`);
  process.exit(1);
}

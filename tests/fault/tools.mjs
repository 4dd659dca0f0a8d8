// What the fault tests share: the campaign, starting and watching `cupola`, numbers by chance from a printed seed.
import { spawn, spawnSync } from 'node:child_process';
import { cpSync, existsSync, mkdirSync, readFileSync, readdirSync, rmSync, statSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { fileURLToPath } from 'node:url';

export const [cupola, sourceFolder, workFolder] = process.argv.slice(2);
export const aloneFolder = path.join(workFolder, 'alone');
export const campaignFile = path.join(workFolder, 'campaign.yaml');
/// Checkpoints every moment, so that a kill of a stage of seconds finds one.
export const environment = { ...process.env, CUPOLA_CHECKPOINT_SECONDS: '0.3' };

export function fail(sentence, output = '') {
  console.error(`FAILED: ${sentence}`);
  if (output) console.error(output.split('\n').slice(-40).join('\n'));
  process.exit(1);
}

export function check(holds, sentence, output = '') {
  if (!holds) fail(sentence, output);
}

/// A generator of numbers in [0, 1) (mulberry32).
export function chance(seed) {
  let state = seed >>> 0;
  return () => {
    state = (state + 0x6d2b79f5) >>> 0;
    let t = Math.imul(state ^ (state >>> 15), 1 | state);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
  };
}

/// From the command line or the clock; printed, so that a failure can be repeated.
export function seedOfTheDay(given) {
  const seed = given === undefined ? Date.now() % 1000000007 : Number(given);
  console.log(`seed ${seed}`);
  return seed;
}

export const sleep = (seconds) => new Promise((resolve) => setTimeout(resolve, 1000 * seconds));

export async function waitFor(seconds, what, condition) {
  const end = Date.now() + 1000 * seconds;
  for (;;) {
    const found = condition();
    if (found) return found;
    if (Date.now() > end) fail(`waited ${seconds} s in vain for ${what}`);
    await sleep(0.02);
  }
}

/// Runs `cupola` to its end. @return {status, output}
export function run(words, more = {}) {
  const ended = spawnSync(cupola, words, { env: { ...environment, ...more.environment }, encoding: 'utf8', cwd: more.cwd, maxBuffer: 1 << 28 });
  return { status: ended.status ?? 128, output: `${ended.stdout}${ended.stderr}` };
}

/// Starts `cupola`. @return {pid, ended: Promise of {status, output}, alive()}
export function start(words, more = {}) {
  const child = spawn(cupola, words, { env: { ...environment, ...more.environment }, stdio: ['ignore', 'pipe', 'pipe'] });
  let output = '';
  let alive = true;
  const at = words.indexOf('--run-dir');
  begun.push({ child, folder: at < 0 ? words[1] : words[at + 1] });
  for (const stream of [child.stdout, child.stderr]) stream.on('data', (text) => (output += text));
  const ended = new Promise((resolve) =>
    child.on('exit', (status, signal) => {
      alive = false;
      resolve({ status: status ?? `killed by ${signal}`, output });
    }),
  );
  return { pid: child.pid, ended, alive: () => alive, kill: (signal) => alive && child.kill(signal), output: () => output };
}

export function journal(folder) {
  const file = path.join(folder, 'journal.jsonl');
  if (!existsSync(file)) return [];
  return readFileSync(file, 'utf8').split('\n').filter(Boolean).flatMap((line) => {
    try {
      return [JSON.parse(line)];
    } catch {
      return [];
    }
  });
}

function childrenOf(pid) {
  try {
    return readdirSync(`/proc/${pid}/task`).flatMap((task) =>
      readFileSync(`/proc/${pid}/task/${task}/children`, 'utf8').split(' ').filter(Boolean).map(Number));
  } catch {
    return [];
  }
}

/// The stage that runs in this folder now, by the journal: {mpirun, ranks[]}; none where none does.
export function stageOf(folder) {
  const started = journal(folder).filter((record) => record.event === 'stage-started').at(-1);
  if (!started || !existsSync(`/proc/${started.pid}`)) return undefined;
  const begun = readFileSync(`/proc/${started.pid}/stat`, 'utf8').replace(/^.*\) /, '').split(' ')[19];
  if (Number(begun) !== started.process_started) return undefined;
  return { mpirun: started.pid, ranks: childrenOf(started.pid) };
}

/// Whatever of this folder still runs is ended: stages whose orchestrator was killed.
export async function endStagesOf(folder) {
  const stage = stageOf(folder);
  if (!stage) return;
  for (const pid of [stage.mpirun, ...stage.ranks]) kill(pid, 'SIGKILL');
  await waitFor(20, 'the end of a stage', () => !stageOf(folder));
}

export function kill(pid, signal) {
  try {
    process.kill(pid, signal);
    return true;
  } catch {
    return false;
  }
}

/// The ends must be the same, numbers within a relative tolerance (0: bit for bit).
export function compare(folder, tolerance = 0) {
  const script = path.join(path.dirname(fileURLToPath(import.meta.url)), '../workflow/compare_reports.mjs');
  const words = [script, ...[aloneFolder, folder].map((run) => path.join(run, 'report/report.json')), String(tolerance)];
  const ended = spawnSync(process.execPath, words, { encoding: 'utf8' });
  check(ended.status === 0, `${folder} ended otherwise than the run left alone`, ended.stderr);
}

export function expectedStatus() {
  return Number(readFileSync(path.join(workFolder, 'expected_status'), 'utf8'));
}

/// Goes on until the campaign has ended as the one left alone, and compares.
export function finishAndCompare(folder, words = []) {
  const ended = run(['resume', folder, ...words]);
  check(ended.status === expectedStatus(), `${folder}: ended with ${ended.status} instead of ${expectedStatus()}`, ended.output);
  compare(folder);
}

/// File systems that an aborted test left mounted below a folder.
function unmountBelow(folder) {
  for (const line of readFileSync('/proc/mounts', 'utf8').split('\n')) {
    const place = (line.split(' ')[1] ?? '').replace(/\\([0-7]{3})/g, (_, code) => String.fromCharCode(parseInt(code, 8)));
    if (place === path.join(folder, '.') || place.startsWith(path.join(folder, '/'))) spawnSync('umount', ['-l', place]);
  }
}

/// Mounts a small file system until the end of this program; undefined where that is not possible.
export function mounted(name, size) {
  const place = freshFolder(name);
  const ended = spawnSync('mount', ['-t', 'tmpfs', '-o', `size=${size}`, 'none', place], { encoding: 'utf8' });
  if (ended.status !== 0) {
    console.log(`SKIPPED: full disk and read-only folder: no file system can be mounted here: ${(ended.stderr ?? '').trim()}`);
    return undefined;
  }
  process.on('exit', () => spawnSync('umount', ['-l', place]));
  return place;
}

// Whatever way a test ends, nothing that it began goes on: `cupola` first, then the stages of all folders it was given.
const begun = [];
process.on('exit', () => {
  for (const { child, folder } of begun) {
    if (child.exitCode === null && child.signalCode === null) kill(child.pid, 'SIGKILL');
    const stage = folder && stageOf(folder);
    if (stage) for (const pid of [stage.mpirun, ...stage.ranks]) kill(pid, 'SIGKILL');
  }
});
for (const signal of ['SIGINT', 'SIGTERM', 'SIGHUP']) process.on(signal, () => process.exit(1));

/// A folder of its own for a test, empty.
export function freshFolder(name) {
  const folder = path.join(workFolder, name);
  unmountBelow(folder);
  rmSync(folder, { recursive: true, force: true });
  mkdirSync(folder, { recursive: true });
  return folder;
}

export function copyOfAlone(name) {
  const folder = path.join(workFolder, name);
  rmSync(folder, { recursive: true, force: true });
  cpSync(aloneFolder, folder, { recursive: true, preserveTimestamps: true });
  return folder;
}

export { cpSync, existsSync, mkdirSync, path, readFileSync, readdirSync, rmSync, statSync, writeFileSync };

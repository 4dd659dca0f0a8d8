// Where a campaign may be: a path with blanks and letters beyond ASCII, moved in the middle, with the clock put back, on a full
// disk, in a folder that became read-only; on another number of ranks; with other versions; held by another.
//   node places.mjs CUPOLA SOURCE_DIR WORK_DIR SHIM
import { spawnSync } from 'node:child_process';
import { renameSync } from 'node:fs';
import { aloneFolder, campaignFile, check, compare, copyOfAlone, cpSync, cupola, endStagesOf, existsSync, expectedStatus, finishAndCompare, freshFolder, journal, mkdirSync, mounted, path, readFileSync, rmSync, run, start, waitFor, workFolder, writeFileSync } from './tools.mjs';

const shim = process.argv[5];
const seconds = (begin) => `${((Date.now() - begin) / 1000).toFixed(1)} s`;

/// Starts a campaign and waits until a stage of the first episode is at work.
async function begun(campaign, folder, stage = 'tracer') {
  const orchestrator = start(['run', campaign, '--run-dir', folder]);
  const history = path.join(folder, `episodes/001/${stage}/attempt-1/history.jsonl`);
  await waitFor(600, `the first ${stage} stage`, () => existsSync(history) || !orchestrator.alive());
  check(orchestrator.alive(), 'the campaign ended before its time', orchestrator.output());
  return orchestrator;
}

async function blanksAndMoving() {
  const begin = Date.now();
  const place = path.join(freshFolder('places'), 'Lauf 1 für ß, größer & "kühner" 炉');
  mkdirSync(place, { recursive: true });
  const campaign = path.join(place, "mein Ofen's Plan.yaml");
  cpSync(campaignFile, campaign);
  const folder = path.join(place, 'der Lauf');
  const orchestrator = await begun(campaign, folder);
  // Two at once: one works, the other says who.
  const second = run(['resume', folder]);
  check(second.status === 73, `a second orchestrator left with ${second.status}`, second.output);
  check(new RegExp(`held by process ${orchestrator.pid} on \\S+ since \\d{4}-\\d\\d-\\d\\dT`).test(second.output), 'who holds the folder is not said', second.output);
  orchestrator.kill('SIGTERM');
  const { status, output } = await orchestrator.ended;
  check(status === 75, `SIGTERM: left with ${status}`, output);
  // Another place, and the clock is an hour back.
  const moved = path.join(workFolder, 'places', 'moved');
  renameSync(place, moved);
  const ended = run(['resume', path.join(moved, 'der Lauf')], { environment: { LD_PRELOAD: shim, CUPOLA_FAULT_CLOCK: '-3600' } });
  check(ended.status === expectedStatus(), `moved and an hour back: ended with ${ended.status}`, ended.output);
  compare(path.join(moved, 'der Lauf'));
  const times = journal(path.join(moved, 'der Lauf')).map((record) => record.time);
  check(times.some((time, i) => i > 0 && time < times[i - 1]), 'the clock was not put back');
  console.log(`blanks and other letters in the path, a second writer, a move and a clock put back: the same end (${seconds(begin)})`);
}

async function fullAndReadOnly() {
  const begin = Date.now();
  const place = mounted('small', '64m');
  if (!place) return;
  const folder = path.join(place, 'run');
  const orchestrator = await begun(campaignFile, folder, 'dem');
  // All that is left of the disk is taken.
  spawnSync('dd', ['if=/dev/zero', `of=${path.join(place, 'ballast')}`, 'bs=4k']);
  const { status, output } = await orchestrator.ended;
  check(status === 74, `a full disk: left with ${status}`, output);
  check(/No space left|full/.test(output), 'that the disk is full is not said', output);
  rmSync(path.join(place, 'ballast'));
  await endStagesOf(folder);
  spawnSync('mount', ['-o', 'remount,ro', place]);
  const refused = run(['resume', folder]);
  check(refused.status === 74 && /[Rr]ead-only/.test(refused.output), `a read-only folder: left with ${refused.status}`, refused.output);
  check(run(['status', folder]).status === 0, 'status of a read-only folder');
  check(run(['verify', folder]).status === 0, 'verify of a read-only folder');
  spawnSync('mount', ['-o', 'remount,rw', place]);
  finishAndCompare(folder);
  console.log(`a full disk and a read-only folder: said with 74, and the same end after (${seconds(begin)})`);
}

/// State is kept by parcel and tracer, so that another number of ranks can read it; sums are then added up in another order.
async function otherRanks() {
  const begin = Date.now();
  const folder = path.join(freshFolder('ranks'), 'run');
  const orchestrator = await begun(campaignFile, folder, 'dem');
  orchestrator.kill('SIGTERM');
  check((await orchestrator.ended).status === 75, 'SIGTERM inside the DEM stage');
  const ended = run(['resume', folder, '--ranks', '1']);
  check([0, 75].includes(ended.status), `on one rank: ended with ${ended.status}`, ended.output);
  const [alone, other] = [aloneFolder, folder].map((run) => JSON.parse(readFileSync(path.join(run, 'report/report.json'))));
  check(other.episodes.length === alone.episodes.length, 'another number of episodes');
  other.episodes.forEach((episode, i) => {
    check(episode.dem.ranks === 1 && episode.tracer.ranks === 1, 'the stages did not run on one rank');
    const expected = alone.episodes[i].mean_solid_temperature;
    const difference = Math.abs(episode.mean_solid_temperature - expected) / expected;
    console.log(`  episode ${episode.index}: mean temperature of the solids ${(100 * difference).toFixed(3)} % from that on two ranks`);
    check(difference < 0.02, 'another number of ranks gives another temperature');
    check(Math.abs(episode.dem.parcels - alone.episodes[i].dem.parcels) < 0.02 * alone.episodes[i].dem.parcels, 'another number of parcels');
  });
  console.log(`begun on two ranks, ended on one: mean temperatures within 2 % (${seconds(begin)})`);
}

function swappedAndChanged() {
  const begin = Date.now();
  const folder = copyOfAlone('swapped');
  // The result of the second episode in the place of the first.
  const results = ['001', '002'].map((episode) => path.join(folder, `episodes/${episode}/dem/attempt-1`));
  rmSync(results[0], { recursive: true });
  cpSync(results[1], results[0], { recursive: true });
  const swapped = run(['resume', folder]);
  check(swapped.status === 74 && /swapped/.test(swapped.output) && /tracer stage of episode 2/.test(swapped.output), 'a swapped result is not named, or not what is whole', swapped.output);
  check(run(['verify', folder]).status === 74, 'verify takes a swapped result');
  rmSync(folder, { recursive: true });
  const changed = copyOfAlone('swapped');
  const file = path.join(changed, 'campaign.yaml');
  writeFileSync(file, readFileSync(file, 'utf8').replace('2 mm/s', '3 mm/s'));
  const refused = run(['resume', changed]);
  check(refused.status === 65 && /campaign\.yaml/.test(refused.output) && /Whole and usable/.test(refused.output), 'a changed campaign is not named, or not what is whole', refused.output);
  rmSync(changed, { recursive: true });
  console.log(`a swapped result and a changed campaign file: named, with what can still be used (${seconds(begin)})`);
}

/// A damaged result, and the cure that its message names.
function removedAndAnew() {
  const begin = Date.now();
  const folder = copyOfAlone('removed');
  const last = path.join(folder, 'episodes/002/tracer/attempt-1');
  writeFileSync(path.join(last, 'result.hdf'), 'nothing');
  const damaged = run(['resume', folder]);
  check(damaged.status === 74 && /remove its task folder and run again/.test(damaged.output), 'a damaged result is not refused', damaged.output);
  rmSync(last, { recursive: true });
  finishAndCompare(folder);
  check(run(['verify', folder]).status === 0, 'verify of a run with a stage that began anew');
  // An earlier one cannot go alone.
  rmSync(path.join(folder, 'episodes/002/dem/attempt-1'), { recursive: true });
  const refused = run(['resume', folder]);
  check(refused.status === 74 && refused.output.includes('episodes/002/tracer'), 'a stage in the middle was done again', refused.output);
  rmSync(path.join(folder, 'episodes/002/tracer'), { recursive: true });
  finishAndCompare(folder);
  rmSync(folder, { recursive: true });
  console.log(`damaged results: refused, and done anew where they are removed (${seconds(begin)})`);
}

/// Programs whose libraries have been exchanged under the run.
function otherVersions() {
  const begin = Date.now();
  const programs = path.join(freshFolder('versions'), 'bin');
  mkdirSync(programs, { recursive: true });
  const real = path.dirname(cupola);
  cpSync(cupola, path.join(programs, 'cupola'));
  for (const stage of ['cupola-dem', 'cupola-tracer']) {
    const said = JSON.parse(spawnSync(path.join(real, stage), ['--versions'], { encoding: 'utf8' }).stdout);
    for (const library of ['OpenFOAM', 'HDF5', 'Open MPI', 'cupola']) check(said[library], `${stage} does not say its ${library}`);
    const other = JSON.stringify({ ...said, OpenFOAM: '9999' });
    writeFileSync(path.join(programs, stage), `#!/bin/sh\ncase "$1" in --versions) echo '${other}' ;; *) exec '${path.join(real, stage)}' "$@" ;; esac\n`, { mode: 0o755 });
  }
  const folder = copyOfAlone('versions/run');
  const resume = (...words) => {
    const ended = spawnSync(path.join(programs, 'cupola'), ['resume', folder, ...words], { encoding: 'utf8' });
    return { status: ended.status, output: ended.stdout + ended.stderr };
  };
  const refused = resume();
  check(refused.status === 65 && /OpenFOAM \S+ \(here 9999\)/.test(refused.output) && /--accept-versions/.test(refused.output) && /Whole and usable/.test(refused.output), 'another version is not named', refused.output);
  const accepted = resume('--accept-versions');
  check(accepted.status === expectedStatus(), 'another version is not accepted', accepted.output);
  check(resume().status === expectedStatus(), 'an accepted version is asked for again');
  const information = JSON.parse(readFileSync(path.join(folder, 'run.json')));
  check(information.versions.LIGGGHTS && information.versions.HDF5, 'run.json does not say the versions of the libraries');
  console.log(`another version of a library: named, refused, and taken when accepted (${seconds(begin)})`);
}

await blanksAndMoving();
await fullAndReadOnly();
await otherRanks();
swappedAndChanged();
removedAndAnew();
otherVersions();

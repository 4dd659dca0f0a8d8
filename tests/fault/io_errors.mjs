// Errors of the file system at places by chance: short writes, a full disk (ENOSPC), EIO of writes, syncs, renames and reads,
// and power cuts that lose what was not synced.  `cupola` says so and leaves, or gets on; after that `cupola resume` ends
// as the campaign left alone, bit for bit.
//   node io_errors.mjs CUPOLA SOURCE_DIR WORK_DIR SHIM FAULTS [SEED]
import { campaignFile, chance, check, compare, endStagesOf, existsSync, expectedStatus, freshFolder, kill, path, readFileSync, run, seedOfTheDay, sleep, start, workFolder } from './tools.mjs';

const [shim, faultsText, seedText] = process.argv.slice(5);
const random = chance(seedOfTheDay(seedText));
const pick = (list) => list[Math.floor(random() * list.length)];
// How many changes and reads each start of a program made in the run left alone.
const operations = readFileSync(path.join(workFolder, 'operations'), 'utf8').trim().split('\n').map((line) => line.split(' '))
  .filter(([program, changes]) => program.startsWith('cupola') && Number(changes) > 0);
const kinds = ['enospc', 'eio', 'short', 'power-cut', 'read-eio'];

/// A report that could not be written is made anew.
function finished() {
  const report = run(['report', folder]);
  check(report.status === 0, 'no report after the faults', report.output);
  compare(folder);
}

let happened = 0;
let said = 0;
const wanted = Number(faultsText);
const folder = path.join(freshFolder('io'), 'run');
const once = path.join(workFolder, 'io', 'happened');
let ended = false;
let starts = 0;
while (happened < wanted || !ended) {
  if (ended) {
    finished();
    freshFolder('io');
    ended = false;
  }
  let environment = {};
  let fault = '';
  if (happened < wanted) {
    const kind = kinds[happened % kinds.length];
    const [program, changes, reads] = pick(operations);
    const at = 1 + Math.floor(random() * Math.max(1, Number(kind === 'read-eio' ? reads : changes)));
    fault = `${kind} in ${program} at operation ${at}`;
    environment = { LD_PRELOAD: shim, CUPOLA_FAULT_PROGRAM: program, CUPOLA_FAULT_UNDER: folder, CUPOLA_FAULT_KIND: kind, CUPOLA_FAULT_AT: String(at), CUPOLA_FAULT_ONCE: `${once}-${happened}` };
  }
  check(++starts < 20 * (wanted + 2), 'the campaign does not get on');
  const orchestrator = start(['run', campaignFile, '--run-dir', folder], { environment });
  if (fault.startsWith('power-cut')) {
    // The power goes for all programs at once.
    while (orchestrator.alive() && !existsSync(`${once}-${happened}`)) await Promise.race([sleep(0.02), orchestrator.ended]);
    if (existsSync(`${once}-${happened}`)) {
      orchestrator.kill('SIGKILL');
      await orchestrator.ended;
      await endStagesOf(folder);
    }
  }
  const { status, output } = await orchestrator.ended;
  const struck = fault !== '' && existsSync(`${once}-${happened}`);
  if (struck) {
    ++happened;
    console.log(`${fault}: ended with ${status}`);
    const words = output.trim().split('\n').at(-1);
    if (status === 74) {
      ++said;
      check(/cannot|could not|No space|Input\/output|full|HDF5|write/i.test(output), 'the reason is not said', output);
    }
    check([expectedStatus(), 74, 'killed by SIGKILL'].includes(status), `${fault}: ended with ${status}: ${words}`, output);
  } else {
    check(status === expectedStatus(), `ended with ${status} although nothing happened`, output);
  }
  ended = status === expectedStatus();
}
finished();
const verified = run(['verify', folder]);
check(verified.status === 0, 'verify finds damage after the faults', verified.output);
console.log(`${happened} faults survived, ${said} of them ended the program with 74 and a reason; the end is that of the run left alone`);

// The campaign of the fault tests, left alone: what all others must end as.
//   node alone.mjs CUPOLA SOURCE_DIR WORK_DIR SHIM
import { aloneFolder, campaignFile, check, freshFolder, path, readFileSync, run, sourceFolder, workFolder, writeFileSync } from './tools.mjs';

const shim = process.argv[5];
freshFolder('.');
const tiny = readFileSync(path.join(sourceFolder, 'cases/tiny/campaign.yaml'), 'utf8');
writeFileSync(campaignFile, tiny.replace(/^launch:.*$/m, `launch: {ranks: ${process.env.CUPOLA_FAULT_RANKS ?? 2}}`));
// Counts the changes and reads of files by program on the way: places for faults.
const ended = run(['run', campaignFile, '--run-dir', aloneFolder], {
  environment: { LD_PRELOAD: shim, CUPOLA_FAULT_PROGRAM: '*', CUPOLA_FAULT_UNDER: aloneFolder, CUPOLA_FAULT_COUNT: path.join(workFolder, 'operations') },
});
check([0, 75].includes(ended.status), `the undisturbed campaign ended with ${ended.status}`, ended.output);
writeFileSync(path.join(workFolder, 'expected_status'), `${ended.status}\n`);
const verified = run(['verify', aloneFolder]);
check(verified.status === 0, 'the undisturbed run does not pass verify', verified.output);
console.log(readFileSync(path.join(workFolder, 'operations'), 'utf8'));

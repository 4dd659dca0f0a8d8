// Kills by chance, several in one campaign: the orchestrator, a rank, mpirun, everything; SIGTERM, SIGINT twice, SIGHUP.
// Whatever is killed, whenever, `cupola resume` ends as the campaign left alone, bit for bit.
//   node kills.mjs CUPOLA SOURCE_DIR WORK_DIR KILLS [SEED]
import { campaignFile, chance, check, compare, endStagesOf, existsSync, expectedStatus, freshFolder, journal, kill, path, seedOfTheDay, sleep, stageOf, start } from './tools.mjs';

const kills = Number(process.argv[5]);
const random = chance(seedOfTheDay(process.argv[6]));
const pick = (list) => list[Math.floor(random() * list.length)];

/// What can be done to a campaign at work. Each returns whether the orchestrator ends by it.
const blows = {
  'SIGKILL of the orchestrator': ({ orchestrator }) => orchestrator.kill('SIGKILL'),
  'SIGKILL of a rank': ({ stage }) => stage && stage.ranks.length > 0 && kill(pick(stage.ranks), 'SIGKILL') && false,
  'SIGKILL of mpirun': ({ stage }) => stage && kill(stage.mpirun, 'SIGKILL') && false,
  'SIGKILL of everything': ({ orchestrator, stage }) => {
    orchestrator.kill('SIGKILL');
    if (stage) for (const pid of [stage.mpirun, ...stage.ranks]) kill(pid, 'SIGKILL');
    return true;
  },
  'SIGTERM': ({ orchestrator }) => orchestrator.kill('SIGTERM'),
  'SIGINT twice': ({ orchestrator }) => {
    orchestrator.kill('SIGINT');
    setTimeout(() => orchestrator.kill('SIGINT'), 30);
    return true;
  },
  'SIGHUP': ({ orchestrator }) => orchestrator.kill('SIGHUP'),
};

const onStage = new Set(['SIGKILL of a rank', 'SIGKILL of mpirun']);

const counts = {};
let done = 0;
for (let campaign = 1; done < kills; ++campaign) {
  const folder = path.join(freshFolder('killed'), `campaign-${campaign}`);
  let inThis = 0;
  let stageBlows = 0; // since the last start: a stage that dies four times on end ends the campaign, as it should
  for (let ended = false; !ended; ) {
    const orchestrator = start(['run', campaignFile, '--run-dir', folder]);
    let ending = false;
    stageBlows = 0;
    while (orchestrator.alive() && !ending) {
      // Anything from the very beginning to the middle of a stage.
      await Promise.race([sleep(random() < 0.3 ? 0.5 * random() : 4 * random()), orchestrator.ended]);
      // After six blows a campaign is let go, so that each is also followed to its end.
      if (!orchestrator.alive() || done >= kills || inThis >= 6) break;
      const name = pick(Object.keys(blows));
      if (onStage.has(name) && stageBlows >= 3) continue;
      const result = blows[name]({ orchestrator, stage: stageOf(folder) });
      if (result === undefined) continue; // there was no stage to hit
      ending = result;
      if (onStage.has(name)) ++stageBlows;
      counts[name] = (counts[name] ?? 0) + 1;
      ++done;
      ++inThis;
      console.log(`campaign ${campaign}: ${name}, after ${existsSync(folder) ? journal(folder).at(-1)?.event : 'nothing'}`);
    }
    const { status, output } = await orchestrator.ended;
    const stopped = status === 75 && journal(folder).at(-1)?.event !== 'campaign-ended';
    check(ending || status === expectedStatus(), `ended with ${status} although nobody asked it to`, output);
    if (ending) check(stopped || status === expectedStatus() || String(status).startsWith('killed by'), `ended with ${status} after a blow`, output);
    ended = status === expectedStatus() && journal(folder).at(-1)?.event === 'campaign-ended';
  }
  compare(folder);
  await endStagesOf(folder);
  console.log(`campaign ${campaign}: ${inThis} blows survived, the end is that of the run left alone, bit for bit`);
}
console.log(`${done} kills survived: ${Object.entries(counts).map(([name, count]) => `${count} ${name}`).join(', ')}`);

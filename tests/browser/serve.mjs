// Looks at a run through `cupola serve`, in Chromium and without it:  node serve.mjs CUPOLA RUN OUTPUT_FOLDER
import assert from "node:assert/strict";
import { spawn, spawnSync } from "node:child_process";
import { appendFileSync, cpSync, mkdirSync, mkdtempSync, readFileSync, rmSync, statSync } from "node:fs";
import { request } from "node:http";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import puppeteer from "puppeteer-core";

const [cupola, original, outputFolder] = process.argv.slice(2).map((path) => resolve(path));
assert(outputFolder, "usage: node serve.mjs CUPOLA RUN OUTPUT_FOLDER");
mkdirSync(outputFolder, { recursive: true });
const work = mkdtempSync(join(tmpdir(), "cupola-serve-"));
const run = join(work, "run");
cpSync(original, run, { recursive: true });

const server = spawn(cupola, ["serve", run, "--port", "0"], { stdio: ["ignore", "pipe", "inherit"] });
const ended = new Promise((done) => server.on("exit", (code) => done(code)));
const address = await new Promise((done, failed) => {
  server.stdout.once("data", (text) => done(String(text).match(/http:\/\/127\.0\.0\.1:\d+\//)[0]));
  server.on("exit", () => failed(new Error("cupola serve ended at once")));
});

/** Status of a plain request. */
const status = (method, path, headers = {}) => new Promise((done, failed) => {
  const asked = request(new URL(path, address), { method, headers }, (answer) => { answer.resume(); answer.on("end", () => done(answer.statusCode)); });
  asked.on("error", failed);
  asked.end();
});

let browser;
try {
  assert.equal(await status("GET", "report.json"), 200);
  assert.equal(await status("GET", "../../run.json"), 404, "a file of the run folder was handed out");
  assert.equal(await status("POST", "status.json"), 404, "it takes more than questions");
  assert.equal(await status("GET", "status.json", { Host: "somewhere.example" }), 403, "a foreign name leads here");
  const { port } = new URL(address);
  const second = spawnSync(cupola, ["serve", run, "--port", port], { encoding: "utf8", timeout: 60000 });
  assert.equal(second.status, 74, "a second server on the same port does not fail");
  assert(second.stderr.includes(`127.0.0.1:${port}`), `the port is not named: ${second.stderr}`);
  const before = statSync(join(run, "report", "index.html")).mtimeMs;

  browser = await puppeteer.launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    userDataDir: join(work, "profile"),
    headless: true,
    args: ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
      "--disable-component-update", "--disable-sync", "--disable-dev-shm-usage"],
  });
  const page = await browser.newPage();
  const complaints = [];
  page.on("pageerror", (error) => complaints.push(error.message));
  await page.setViewport({ width: 360, height: 800 });
  await page.goto(address, { waitUntil: "load" });
  const { campaign } = JSON.parse(readFileSync(join(run, "report", "report.json"), "utf8"));
  await page.waitForFunction((name) => document.querySelector(".live")?.innerText.startsWith(`${name}: `), { timeout: 20000 }, campaign);
  await page.screenshot({ path: join(outputFolder, "serve-360.png") });
  assert((await page.$$("figure[data-chart]")).length > 3, "the report is not there");

  // The run folder is broken while it is shown: that is said, and nothing ends.
  appendFileSync(join(run, "campaign.yaml"), "# changed\n");
  await page.waitForFunction(() => document.querySelector(".live").innerText.includes("changed after the run began"), { timeout: 20000 });
  assert.equal(statSync(join(run, "report", "index.html")).mtimeMs, before, "it wrote into the run folder");
  assert.deepEqual(complaints, [], "the page complains");
} finally {
  await browser?.close();
  server.kill("SIGTERM");
  const code = await ended;
  rmSync(work, { recursive: true, force: true });
  assert.equal(code, 0, "cupola serve does not leave well");
}
console.log("served and watched");

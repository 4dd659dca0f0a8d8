// Opens the page of a study in Chromium as a reader would: node study.mjs STUDY_FOLDER OUTPUT_FOLDER
import assert from "node:assert/strict";
import { existsSync, mkdirSync, mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import puppeteer from "puppeteer-core";

const [folder, outputFolder] = process.argv.slice(2).map((path) => resolve(path));
assert(outputFolder, "usage: node study.mjs STUDY_FOLDER OUTPUT_FOLDER");
const study = JSON.parse(readFileSync(join(folder, "study.json"), "utf8"));
mkdirSync(outputFolder, { recursive: true });
const drawable = study.metrics.filter(({ name }) => study.settings.some(({ errors }) => errors[name]?.mean > 0)).map(({ name }) => `error_${name}`);

const profile = mkdtempSync(join(tmpdir(), "cupola-chromium-"));
const browser = await puppeteer.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", userDataDir: profile, headless: true,
  args: ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync", "--disable-dev-shm-usage"],
});
try {
  for (const width of [1280, 360]) {
    const page = await browser.newPage();
    const complaints = [];
    page.on("console", (message) => ["error", "warn"].includes(message.type()) && complaints.push(message.text()));
    page.on("pageerror", (error) => complaints.push(error.message));
    page.on("request", (request) => /^(file|data|blob):/.test(request.url()) || complaints.push(`asks for ${request.url()}`));
    await page.setViewport({ width, height: 800 });
    await page.goto(pathToFileURL(join(folder, "index.html")).href, { waitUntil: "load" });
    await page.screenshot({ path: join(outputFolder, `study-${width}.png`), fullPage: true });

    const charts = await page.evaluate(() => Object.fromEntries([...document.querySelectorAll("figure[data-chart]")].map((figure) => {
      const paths = [...figure.querySelectorAll(".drawing svg path")].filter((path) => path.getBBox().width + path.getBBox().height > 2);
      return [figure.dataset.chart, paths.length];
    })));
    assert.deepEqual(Object.keys(charts).sort(), [...drawable].sort(), "a chart for each metric that has an error");
    for (const [name, marks] of Object.entries(charts)) assert(marks > 8, `chart ${name} has not drawn: ${marks} marks`);
    const text = await page.evaluate(() => document.body.innerText);
    for (const { label, runs } of study.settings) {
      assert(text.includes(label), `the setting ${label} is missing`);
      for (const { state, sentence } of runs) assert(state !== "failed" || text.includes(sentence.slice(0, 60)), `why ${label} failed is missing`);
    }
    assert(!/\b(undefined|NaN|\[object)/.test(text), "a number is missing in the text");
    const overflow = await page.evaluate(() => document.documentElement.scrollWidth - window.innerWidth);
    assert(overflow <= 0, `the page is ${overflow} pixels wider than a screen of ${width}`);
    if (width > 1000) {
      const client = await browser.target().createCDPSession();
      await client.send("Browser.setDownloadBehavior", { behavior: "allow", downloadPath: outputFolder });
      for (const name of drawable) {
        const file = join(outputFolder, `${name}.csv`);
        rmSync(file, { force: true });
        await page.evaluate((chart) => document.querySelector(`figure[data-chart="${chart}"] button`).click(), name);
        for (let waited = 0; !existsSync(file) && waited < 5000; waited += 50) await new Promise((done) => setTimeout(done, 50));
        assert.equal(readFileSync(file, "utf8").trim().split("\r\n").length, study.settings.length + 1, `the CSV of ${name}`);
      }
    }
    assert.deepEqual(complaints, [], "the page complains");
    await page.close();
  }
} finally {
  await browser.close();
  rmSync(profile, { recursive: true, force: true });
}
console.log(`drawn: ${drawable.join(", ")}`);

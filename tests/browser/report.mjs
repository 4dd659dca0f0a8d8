// Opens a report in Chromium as a reader would and looks whether everything has been drawn:
//   node report.mjs REPORT_FOLDER OUTPUT_FOLDER
// Screenshots and the printed page are left in OUTPUT_FOLDER.
import assert from "node:assert/strict";
import { existsSync, mkdirSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import puppeteer from "puppeteer-core";

const [reportFolder, outputFolder] = process.argv.slice(2).map((path) => resolve(path));
assert(outputFolder, "usage: node report.mjs REPORT_FOLDER OUTPUT_FOLDER");
const report = JSON.parse(readFileSync(join(reportFolder, "report.json"), "utf8"));
mkdirSync(outputFolder, { recursive: true });

/** Charts this report must show, from its numbers. */
function expectedCharts({ charts, episodes, has_heat: hot }) {
  const finished = episodes.some(({ tracer }) => tracer?.state === "finished");
  const names = [];
  if (hot && charts.tracer_history.some(({ mean_solid_temperature: values }) => values?.length)) names.push("temperature_history");
  if (charts.cohesive_zones.length) names.push("cohesive_zones");
  if (finished) names.push("map_solids_fraction", "map_solids_speed", "wall_time");
  if (finished && hot) names.push("map_solids_temperature");
  if (charts.maps.episodes.some(({ fields }) => fields.gas_temperature)) names.push("map_gas_temperature");
  if (charts.dem_history.some(({ time }) => time.length)) names.push("parcels");
  if (episodes.some(({ change }) => change.granular_velocity > 0)) names.push("convergence");
  return names;
}

/** In the page: how much of each chart has been drawn. */
const lookAtCharts = () => Object.fromEntries([...document.querySelectorAll("figure[data-chart]")].map((figure) => {
  const svg = figure.querySelector(".drawing svg");
  const canvas = figure.querySelector(".drawing canvas");
  const box = figure.querySelector(".drawing").getBoundingClientRect();
  let marks = 0;
  let colours = 0;
  if (svg) {
    marks = [...svg.querySelectorAll("path")].filter((path) => path.getBBox().width + path.getBBox().height > 2).length;
    colours = new Set([...svg.querySelectorAll("path")].flatMap((path) => [path.getAttribute("stroke"), path.getAttribute("fill")])).size;
  } else if (canvas) {
    const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    const seen = new Set();
    for (let i = 0; i < data.length; i += 4) {
      if (data[i + 3] > 0) {
        marks += 1;
        seen.add((data[i] << 16) | (data[i + 1] << 8) | data[i + 2]);
      }
    }
    colours = seen.size;
  }
  return [figure.dataset.chart, { kind: svg ? "svg" : canvas ? "canvas" : "none", marks, colours, width: box.width, height: box.height }];
}));

/** In the page: entries of legends that reach into their chart's frame, as `chart: entry`. */
const legendsOverCharts = (entries) => [...document.querySelectorAll("figure[data-chart]")].flatMap((figure) => {
  const frame = [...figure.querySelectorAll('.drawing svg path[stroke="#7b8494"]')].map((path) => path.getBoundingClientRect()).filter(({ height }) => height > 50);
  if (!frame.length) return [];
  const top = Math.min(...frame.map((line) => line.top));
  return [...figure.querySelectorAll(".drawing svg text")].filter((text) => entries.includes(text.textContent) && text.getBoundingClientRect().bottom > top)
    .map((text) => `${figure.dataset.chart}: ${text.textContent}`);
});
const legendEntries = ["temperature", "cohesive zone", "granular velocity", "granular velocity: standard error", "tracers' time step: estimate",
  "gas: heat not accounted for", "temperature: change still to come"];

/** In the page: what the label of the criterion's line lies over. */
const underTheCriterion = () => {
  const texts = [...document.querySelectorAll('figure[data-chart="convergence"] .drawing svg text')];
  const label = texts.find((text) => text.textContent === "met below")?.getBoundingClientRect();
  return label ? texts.filter((text) => {
    const box = text.getBoundingClientRect();
    return text.textContent !== "met below" && box.left < label.right && box.right > label.left && box.top < label.bottom && box.bottom > label.top;
  }).map((text) => text.textContent) : [];
};

/** In the page: tables of which no number is seen without moving them sideways. */
const tablesWithoutNumbers = () => [...document.querySelectorAll(".scroll table")].filter((table) => table.offsetParent !== null)
  .flatMap((table) => {
    const numbers = [...table.querySelectorAll("tbody tr:first-child td")].filter((cell) => /^[\d−-]/.test(cell.textContent));
    const seen = document.documentElement.clientWidth;
    return numbers.length && numbers[0].getBoundingClientRect().right > seen ? [table.textContent.slice(0, 60)] : [];
  });

/** Prints, and looks at the page as it is laid out for paper. */
async function print(page, file) {
  await page.evaluate(() => matchMedia("print").addEventListener("change", ({ matches }) => {
    if (!matches) return;
    const width = document.documentElement.getBoundingClientRect().width;
    window.onPaper = {
      width,
      cut: [...document.querySelectorAll("table")].filter((table) => table.getBoundingClientRect().right > width + 1).map((table) => table.textContent.slice(0, 60)),
      closed: [...document.querySelectorAll("details")].filter((panel) => panel.lastElementChild.getBoundingClientRect().height < 20
        || !panel.lastElementChild.checkVisibility({ contentVisibilityAuto: true })).map((panel) => panel.textContent.slice(0, 60)),
    };
  }));
  writeFileSync(file, await page.pdf({ format: "A4" }));
  const paper = await page.evaluate(() => window.onPaper);
  console.log("on paper:", paper);
  assert(paper, "it was not laid out for paper");
  assert(paper.width < 720, `the page is shrunk on paper: laid out ${paper.width} pixels wide, where A4 has 703`);
  assert.deepEqual(paper.closed, [], "closed panels do not print");
  assert.deepEqual(paper.cut, [], "tables are cut off on paper");
}

/** Goes through the page with the Tab key alone: everything that can be used is reached, and says what it is. */
async function useKeys(page, charts) {
  const reached = new Set();
  for (let i = 0; i < 200; ++i) {
    await page.keyboard.press("Tab");
    const here = await page.evaluate(() => {
      const { activeElement: at } = document;
      if (at === document.body) return null;
      const outline = getComputedStyle(at);
      return {
        what: at.closest("figure")?.dataset.chart ?? at.tagName, name: at.getAttribute("aria-label") ?? at.innerText,
        seen: outline.outlineStyle !== "none" && parseFloat(outline.outlineWidth) >= 2,
      };
    });
    if (here === null) break;
    assert(here.name, `${here.what} is reached by the Tab key but has no name`);
    assert(here.seen, `one does not see that ${here.name} is reached`);
    reached.add(here.what);
  }
  for (const chart of charts) assert(reached.has(chart), `the CSV of ${chart} is not reached by the Tab key`);
  assert(!charts.length || reached.has("SUMMARY"), "the campaign file is not reached by the Tab key");
}

const profile = mkdtempSync(join(tmpdir(), "cupola-chromium-"));
const browser = await puppeteer.launch({
  executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
  userDataDir: profile,
  headless: true,
  args: ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
    "--disable-component-update", "--disable-sync", "--disable-dev-shm-usage"],
});

try {
  for (const width of [1280, 360]) {
    const page = await browser.newPage();
    const complaints = [];
    page.on("console", (message) => ["error", "warn"].includes(message.type()) && complaints.push(message.text()));
    page.on("pageerror", (error) => complaints.push(error.message));
    page.on("request", (request) => /^(file|data|blob):/.test(request.url()) || complaints.push(`asks for ${request.url()}`));
    await page.setViewport({ width, height: 800 });
    await page.goto(pathToFileURL(join(reportFolder, "index.html")).href, { waitUntil: "load" });

    // Before anything is asserted, so that a failure can be looked at; the charts are drawn by now or never.
    await page.screenshot({ path: join(outputFolder, `report-${width}.png`), fullPage: true });

    // Without any scrolling: what stands below the fold must be there too.
    const charts = await page.evaluate(lookAtCharts);
    console.log(`width ${width}:`, charts);
    for (const name of expectedCharts(report)) assert(name in charts, `chart ${name} is missing`);
    for (const [name, { kind, marks, colours, width: drawn, height }] of Object.entries(charts)) {
      assert(drawn > 200 && height > 80, `chart ${name} is ${drawn} x ${height}`);
      assert(kind === "svg" ? marks > 8 && colours >= 3 : marks > 5000 && colours > 20, `chart ${name} has not drawn: ${marks} marks, ${colours} colours`);
    }
    const pageText = await page.evaluate(() => document.body.innerText);
    for (const { question, answer } of Object.values(report.answers)) {
      assert(pageText.includes(question) && pageText.includes(answer), `the answer to "${question}" is missing`);
    }
    for (const warning of report.warnings) assert(pageText.includes(warning), `the warning "${warning}" is missing`);
    assert(!/\b(undefined|NaN|\[object)/.test(pageText), "a number is missing in the text");
    if (!report.furnace.species.includes("coke")) assert(!/coke/i.test(pageText), "the text says coke, and there is none");
    const overflow = await page.evaluate(() => document.documentElement.scrollWidth - window.innerWidth);
    assert(overflow <= 0, `the page is ${overflow} pixels wider than a screen of ${width}`);

    if (width < 1000) await useKeys(page, Object.keys(charts));
    if (width > 1000 && Object.keys(charts).length) {
      const client = await browser.target().createCDPSession();
      await client.send("Browser.setDownloadBehavior", { behavior: "allow", downloadPath: outputFolder });
      for (const [index, name] of Object.keys(charts).entries()) {
        if (index > 0 && index % 8 === 0) await page.reload();  // Chromium allows a page ten downloads
        const file = join(outputFolder, `${name}.csv`);
        rmSync(file, { force: true });
        await page.evaluate((chart) => document.querySelector(`figure[data-chart="${chart}"] button`).click(), name);
        for (let waited = 0; !existsSync(file) && waited < 30000; waited += 50) await new Promise((done) => setTimeout(done, 50));
        const lines = readFileSync(file, "utf8").trim().split("\r\n");
        assert(lines.length > 1, `the CSV of ${name} has no rows`);
        assert(lines.every((line) => line.split(",").length === lines[0].split(",").length), `the CSV of ${name} is ragged`);
      }
    }
    assert.deepEqual(await page.evaluate(legendsOverCharts, legendEntries), [], "legends lie over charts");
    assert.deepEqual(await page.evaluate(underTheCriterion), [], "\"met below\" lies over other text");
    if (width < 1000) assert.deepEqual(await page.evaluate(tablesWithoutNumbers), [], "tables show no number");
    if (width > 1000) await print(page, join(outputFolder, "report.pdf"));
    assert.deepEqual(complaints, [], "the page complains");
    await page.close();
  }
} finally {
  await browser.close();
  rmSync(profile, { recursive: true, force: true });
}
console.log(`drawn; pictures in ${outputFolder}: ${readdirSync(outputFolder).join(", ")}`);

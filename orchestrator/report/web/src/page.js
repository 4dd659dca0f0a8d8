// Elements of the page, and figures with a chart and a CSV of what it shows.
import { BarChart, CustomChart, LineChart, ScatterChart } from "echarts/charts";
import { AriaComponent, GridComponent, LegendComponent, MarkLineComponent, TooltipComponent } from "echarts/components";
import * as echarts from "echarts/core";
import { CanvasRenderer, SVGRenderer } from "echarts/renderers";

echarts.use([
  AriaComponent, BarChart, CanvasRenderer, CustomChart, GridComponent, LegendComponent, LineChart, MarkLineComponent,
  ScatterChart, SVGRenderer, TooltipComponent,
]);

/** An element with attributes and children; text is always text, never markup. */
export function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) made.addEventListener(name.slice(2), value);
    else made.setAttribute(name, value);
  }
  made.append(...children.flat(Infinity).filter((child) => child !== null && child !== undefined));
  return made;
}

const cell = (value) => {
  const text = value === null || value === undefined || Number.isNaN(value) ? "" : String(value);
  return /[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
};

/** Rows (the first is the header, with units) as a downloaded file. */
export function download(name, rows) {
  const text = rows.map((row) => row.map(cell).join(",")).join("\r\n") + "\r\n";
  const address = URL.createObjectURL(new Blob([text], { type: "text/csv" }));
  element("a", { href: address, download: `${name}.csv` }).click();
  setTimeout(() => URL.revokeObjectURL(address), 1000);
}

const drawn = [];

/**
 * A figure with a chart.
 * @param name    for tests and for the CSV file
 * @param options (drawing element) => ECharts option; called again when the width changes
 * @param rows    () => rows of the CSV
 */
export function figure({ name, title, note, height, renderer = "svg", options, rows, below = [] }) {
  const drawing = element("div", { class: "drawing", role: "img", "aria-label": title });
  if (height) drawing.style.height = `${height}px`;
  const button = element("button", { type: "button", onclick: () => download(name, rows()) }, "CSV");
  button.setAttribute("aria-label", `CSV of ${title}`);
  button.title = `The numbers of this chart as ${name}.csv`;
  const made = element("figure", { "data-chart": name },
    element("figcaption", {}, element("h3", {}, title), button), note ? element("p", {}, note) : null, drawing, below);
  drawn.push({ drawing, renderer, options, chart: null });
  return made;
}

const common = {
  animation: false,
  aria: { enabled: false },
  textStyle: { fontFamily: "system-ui, -apple-system, 'Segoe UI', Roboto, 'Liberation Sans', sans-serif" },
};

function draw(entry) {
  const option = entry.options(entry.drawing);
  entry.chart ??= echarts.init(entry.drawing, null, { renderer: entry.renderer });
  entry.chart.resize();
  entry.chart.setOption({ ...common, ...option }, { notMerge: true });
}

/** Draws every figure; to be called once all stand in the page, since a chart needs its width. */
export function drawAll() {
  drawn.forEach(draw);
  let width = window.innerWidth;
  window.addEventListener("resize", () => {
    if (window.innerWidth === width) return;  // a phone's address bar changes the height alone
    width = window.innerWidth;
    drawn.forEach(draw);
  });
  window.matchMedia("print").addEventListener("change", () => drawn.forEach(draw));
}

/** Draws the figures again whose data changed. */
export function redraw(names) {
  drawn.filter((entry) => names.includes(entry.drawing.parentElement.dataset.chart)).forEach(draw);
}

/** A table; `head` is one row of texts, `body` rows of texts or of {text, kind}; a row may be {cells, kind}. */
export function table(caption, head, body) {
  const row = (tag) => (cells) => cells.map((content, index) => {
    const { text, kind } = typeof content === "object" && content !== null ? content : { text: content };
    const attributes = kind ? { class: kind } : {};
    return index === 0 && tag === "td" ? element("th", { scope: "row", ...attributes }, text) : element(tag, attributes, text);
  });
  const rows = body.map((line) => (Array.isArray(line) ? { cells: line } : line));
  // One that is wider than the window is moved sideways with the keys too.
  return element("div", { class: "scroll", tabindex: "0", role: "region", "aria-label": caption || head.filter(Boolean).join(", ") }, element("table", {},
    caption ? element("caption", {}, caption) : null,
    element("thead", {}, element("tr", {}, row("th")(head))),
    element("tbody", {}, rows.map(({ cells, kind }) => element("tr", kind ? { class: kind } : {}, row("td")(cells))))));
}

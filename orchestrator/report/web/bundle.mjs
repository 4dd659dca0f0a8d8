// Puts style, charts and page into one HTML text: `node bundle.mjs OUTPUT`.  The marker of the data stays in it for cupola to
// fill in.
import { readFileSync, writeFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import { build } from "esbuild";

const here = (name) => fileURLToPath(new URL(name, import.meta.url));
const output = process.argv[2];
if (!output) throw new Error("usage: node bundle.mjs OUTPUT");

const bundled = await build({
  entryPoints: [here("src/main.js")],
  bundle: true,
  minify: true,
  format: "iife",
  target: "es2020",
  charset: "utf8",
  legalComments: "inline",
  write: false,
  logLevel: "warning",
});
const style = await build({ entryPoints: [here("report.css")], minify: true, write: false, charset: "utf8" });

// Inside a script element no text may end it.
const script = bundled.outputFiles[0].text.replaceAll("</script", "<\\/script");
const page = readFileSync(here("template.html"), "utf8")
  .replace("/*STYLE*/", () => style.outputFiles[0].text)
  .replace("/*SCRIPT*/", () => script);
if (page.split("/*DATA*/").length !== 2) throw new Error("the page must hold the marker of the data exactly once");
writeFileSync(output, page);

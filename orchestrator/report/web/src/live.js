// Where `cupola serve` shows the page: how the run stands now, and the report anew when something has been done.
import { element } from "./page.js";

const between = 5000;  // milliseconds

export function live() {
  if (!location.protocol.startsWith("http")) return null;
  const text = element("pre", {}, "");
  const bar = element("section", { class: "live", role: "status", "aria-label": "How the run stands now" }, text);
  let records = null;
  const look = async () => {
    try {
      const answer = await fetch("status.json", { cache: "no-store" });
      if (!answer.ok) throw new Error(await answer.text());
      const status = await answer.json();
      if (text.textContent !== status.text) text.textContent = status.text;
      if (records !== null && status.records !== records) location.reload();  // keeps the place one reads at
      records = status.records;
    } catch (problem) {
      text.textContent = `No answer from cupola serve: ${problem.message}`;
    }
    setTimeout(look, between);
  };
  look();
  return bar;
}

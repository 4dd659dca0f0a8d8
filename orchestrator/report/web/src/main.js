// The report's page: reads the data that stands in it and lays it out.
import { accuracySection } from "./accuracy.js";
import { answers, heading, warnings } from "./answers.js";
import { convergenceSection } from "./convergence.js";
import { mapsSection, zoneFigure } from "./furnace.js";
import { ledgerSection } from "./ledgers.js";
import { live } from "./live.js";
import { drawAll, element } from "./page.js";
import { provenanceSection } from "./provenance.js";
import { qualitySection } from "./quality.js";
import { stagesSection } from "./stages.js";
import { studyPage } from "./study.js";
import { verifiedSection } from "./verified.js";
import { temperatureFigure, zoneHeightFigure } from "./time_series.js";

function reportPage(report) {
  document.title = `${report.campaign}: ${report.state}`;
  const courseFigures = [zoneFigure(report), temperatureFigure(report), zoneHeightFigure(report)].filter(Boolean);
  return [
    heading(report),
    live(),
    answers(report),
    warnings(report),
    courseFigures.length ? element("h2", {}, "The thermal state and the way to it") : null,
    courseFigures.length ? element("div", { class: "charts" }, courseFigures) : null,
    mapsSection(report),
    convergenceSection(report),
    verifiedSection(report),
    accuracySection(report),
    ledgerSection(report),
    qualitySection(report),
    stagesSection(report),
    provenanceSection(report),
  ];
}

const data = JSON.parse(document.getElementById("report-data").textContent);
const sections = data.kind === "study" ? studyPage(data) : reportPage(data);
document.getElementById("report").append(...sections.filter(Boolean).flat());
drawAll();

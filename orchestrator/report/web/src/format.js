// Numbers for people: SI in, text with a unit out.

const missing = "–";
const isNumber = (value) => typeof value === "number" && Number.isFinite(value);

/** A number with `digits` significant figures, thousands set apart by a thin space. */
export function number(value, digits = 3) {
  if (!isNumber(value)) return missing;
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size < 1e-4 || size >= 1e9) {
    const [mantissa, exponent] = value.toExponential(digits - 1).split("e");
    return `${mantissa}·10${superscript(Number(exponent))}`;
  }
  const decimals = Math.max(0, digits - 1 - Math.floor(Math.log10(size)));
  const [whole, fraction] = value.toFixed(Math.min(decimals, 6)).split(".");
  const grouped = whole.replace(/\B(?=(\d{3})+$)/g, "\u202f");
  return fraction ? `${grouped}.${fraction}` : grouped;
}

function superscript(exponent) {
  return [...String(exponent)].map((sign) => ({ "-": "⁻" })[sign] ?? "⁰¹²³⁴⁵⁶⁷⁸⁹"[sign]).join("");
}

/** A round number of an axis: all its digits, no more. */
export const tick = (value) => value.toLocaleString("en", { maximumFractionDigits: 6 }).replaceAll(",", "\u202f");

/** Whole numbers, all digits. */
export const count = (value) => (isNumber(value) ? Math.round(value).toLocaleString("en").replaceAll(",", "\u202f") : missing);

export const kelvin = (value) => (isNumber(value) ? `${Math.round(value)} K` : missing);

export const metres = (value) => (isNumber(value) ? `${value.toFixed(2)} m` : missing);

export const percent = (value, digits = 2) => (isNumber(value) ? `${number(100 * value, digits)} %` : missing);

/** Seconds as a person says them. */
export function duration(seconds) {
  if (!isNumber(seconds)) return missing;
  if (seconds < 1) return `${number(seconds, 2)} s`;
  if (seconds < 60) return `${number(seconds, 3)} s`;
  const whole = Math.round(seconds);
  if (whole < 3600) return `${Math.floor(whole / 60)} min${whole % 60 ? ` ${whole % 60} s` : ""}`;
  const minutes = Math.round(seconds / 60);
  if (whole < 48 * 3600) return `${Math.floor(minutes / 60)} h${minutes % 60 ? ` ${minutes % 60} min` : ""}`;
  return `${number(seconds / 86400, 3)} days`;
}

const massSteps = [[1e3, "t"], [1, "kg"], [1e-3, "g"]];
const energySteps = [[1e12, "TJ"], [1e9, "GJ"], [1e6, "MJ"], [1e3, "kJ"], [1, "J"]];

/** The unit in which the largest of `values` reads well: [divisor, name]. */
const unitOf = (steps) => (values) => {
  const largest = Math.max(0, ...values.filter(isNumber).map(Math.abs));
  return steps.find(([size]) => largest >= size) ?? steps[steps.length - 1];
};
export const massUnit = unitOf(massSteps);
export const energyUnit = unitOf(energySteps);

/** `top_gas` -> `top gas`. */
export const words = (key) => key.replaceAll("_", " ");

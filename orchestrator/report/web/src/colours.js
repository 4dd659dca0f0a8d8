// Colours that survive colour blindness and a grey printer: Okabe and Ito's set for lines, viridis and inferno for fields.

export const lines = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000", "#8a7000"];

/** For stacks of many parts: the same set, then lighter and darker ones of it. */
export const many = [...lines.slice(0, 6), "#8a7000", "#80b8d8", "#7a3300", "#005c44", "#f0c878", "#4d3b6b"];

const ramps = {
  viridis: ["440154", "482878", "3e4989", "31688e", "26828e", "1f9e89", "35b779", "6ece58", "b5de2b", "fde725"],
  inferno: ["000004", "1b0c41", "4a0c6b", "781c6d", "a52c60", "cf4446", "ed6925", "fb9b06", "f7d13d", "fcffa4"],
};

const channels = (hex) => [0, 2, 4].map((start) => parseInt(hex.slice(start, start + 2), 16));

/** Colour of a ramp at a fraction 0 … 1. */
export function ramp(name, fraction) {
  const stops = ramps[name];
  const place = Math.min(Math.max(fraction, 0), 1) * (stops.length - 1);
  const lower = Math.min(Math.floor(place), stops.length - 2);
  const [from, to] = [channels(stops[lower]), channels(stops[lower + 1])];
  const mixed = from.map((value, i) => Math.round(value + (place - lower) * (to[i] - value)));
  return `rgb(${mixed.join(",")})`;
}

export const rampGradient = (name) => `linear-gradient(to right, ${ramps[name].map((hex) => `#${hex}`).join(", ")})`;

/** Colours of episodes: pale and yellow-green first, dark and blue last, so that time reads without a legend. */
export function episodeColour(index, total) {
  return ramp("viridis", total > 1 ? 0.85 - (0.8 * index) / (total - 1) : 0.05);
}

/** Outside a field: no solids, no value. */
export const empty = "#e9ecf1";

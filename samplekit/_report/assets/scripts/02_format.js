// Numbers as people read them.

const SUPERSCRIPTS = {
  "-": "⁻",
  ".": "·",
  0: "⁰",
  1: "¹",
  2: "²",
  3: "³",
  4: "⁴",
  5: "⁵",
  6: "⁶",
  7: "⁷",
  8: "⁸",
  9: "⁹",
};

function superscript(text) {
  return [...String(text)].map((character) => SUPERSCRIPTS[character] ?? character).join("");
}

function power(exponent) {
  return `10${superscript(exponent)}`;
}

function formatNumber(value, digits = 3) {
  if (value === null || value === undefined || Number.isNaN(value)) return "–";
  if (value === 0) return "0";
  const size = Math.abs(value);
  const sign = value < 0 ? "−" : "";
  const rounded = size.toExponential(digits - 1);
  const [mantissa, exponent] = rounded.split("e");
  if (exponent < -3 || exponent >= 5) return `${sign}${mantissa}·${power(Number(exponent))}`;
  return sign + Number(rounded).toFixed(Math.max(0, digits - 1 - exponent));
}

const TIME_UNITS = [
  [1, "s"],
  [1e-3, "ms"],
  [1e-6, "µs"],
  [1e-9, "ns"],
];

function formatSeconds(seconds, digits = 3) {
  if (seconds === null || seconds === undefined) return "–";
  if (seconds === 0) return "0 s";
  const [unit, name] = TIME_UNITS.find(([size]) => seconds >= 0.9995 * size) ?? TIME_UNITS.at(-1);
  return `${formatNumber(seconds / unit, digits)} ${name}`;
}

function formatCount(count) {
  return String(count).replace(/\B(?=(\d{3})+$)/g, "\u202f");
}

function formatInterval(low, high) {
  if (low === null || high === null) return "no interval";
  return `${formatNumber(low)} … ${formatNumber(high)}`;
}

function formatSigned(value, digits = 3) {
  return (value > 0 ? "+" : "") + formatNumber(value, digits);
}

/** Numbers as people write them: decimal comma in German, ten to a power instead of "e-9". */

const RAISED = { "-": "⁻", 0: "⁰", 1: "¹", 2: "²", 3: "³", 4: "⁴", 5: "⁵", 6: "⁶", 7: "⁷", 8: "⁸", 9: "⁹" };

/** @param {number} exponent */
function raised(exponent) {
  return [...String(exponent)].map((c) => RAISED[/** @type {keyof typeof RAISED} */ (c)]).join("");
}

/** What stands before the decimals, where it is not a point. @type {Record<string, string>} */
const MARK = { de: "," };

/** Between digits; the lengths of LaTeX, as 0.3em, have a point in every language. */
const POINT = /(\d)\.(?=\d+(?!\d|\s*(?:em|ex|mu|pt)\b))/g;

/** A formula whose numbers have the decimal mark of a language. @param {string} latex @param {string} lang */
export const withDecimalMark = (latex, lang) =>
  MARK[lang] ? latex.replace(POINT, (_, digit) => `${digit}{${MARK[lang]}}`) : latex;

/**
 * Fixed number of decimals; a true minus sign, and never a negative zero.
 * @param {number} value @param {number} decimals @param {string} lang
 */
export function fixed(value, decimals, lang) {
  if (!Number.isFinite(value)) return "–";
  const text = value.toFixed(decimals).replace(".", MARK[lang] ?? ".");
  return text.replace(/^-/, /[1-9]/.test(text) ? "−" : "");
}

/** As many of so many digits as it has, with a true minus sign. @param {number} value @param {number} digits @param {string} lang */
export const brief = (value, digits, lang) =>
  value.toLocaleString(lang, { maximumSignificantDigits: digits, useGrouping: false }).replace(/^-/, "−");

/** A number as it stands in a field: its shortest digits, as somebody would type them. @param {number} value @param {string} lang */
export const numberText = (value, lang) => String(value).replace(".", MARK[lang] ?? ".");

/** A number that somebody typed, with a comma or a point; NaN where it is none. @param {string} text */
export function numberIn(text) {
  const plain = text.trim().replace(/^[−–]/, "-").replace(",", ".");
  return plain && Number.isFinite(Number(plain)) ? Number(plain) : NaN;
}

/**
 * Significant digits; scientific outside 10⁻³ … 10⁵.
 * @param {number} value @param {number} digits @param {string} lang
 */
export function significant(value, digits, lang) {
  if (!Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  const [mantissa, exponent] = value
    .toExponential(digits - 1)
    .split("e")
    .map(Number);
  if (exponent >= -3 && exponent < 5) return fixed(value, Math.max(0, digits - 1 - exponent), lang);
  const factor = fixed(mantissa, digits - 1, lang);
  return `${factor}·10${raised(exponent)}`;
}

/** A time to wait, told so coarsely that it does not change at every look: tens of seconds, or minutes. @param {number} seconds */
export const roughly = (seconds) =>
  seconds <= 60 ? `${Math.max(10, 10 * Math.ceil(seconds / 10))} s` : `${Math.ceil(seconds / 60)} min`;

/**
 * A duration of computing: µs, ms or s.
 * @param {number} seconds @param {string} lang
 */
export function duration(seconds, lang) {
  if (seconds < 1e-3) return `${significant(seconds * 1e6, 2, lang)} µs`;
  if (seconds < 1) return `${significant(seconds * 1e3, 2, lang)} ms`;
  return `${significant(seconds, 3, lang)} s`;
}

/**
 * How many decimals show every step of a slider.
 * @param {number} step
 */
export function decimalsOf(step) {
  return Math.max(0, Math.min(6, Math.ceil(-Math.log10(step) - 1e-9)));
}

/**
 * The largest of 1, 2, 5 times a power of ten that is not above x.
 * @param {number} x
 */
export function niceFloor(x) {
  const power = 10 ** Math.floor(Math.log10(x) + 1e-9);
  const lead = x / power + 1e-9;
  return (lead >= 5 ? 5 : lead >= 2 ? 2 : 1) * power;
}

/** What a field is called, with its unit if it has one. @param {string} label @param {string} unit */
export const withUnit = (label, unit) => (unitText(unit) ? `${label} (${unitText(unit)})` : label);

/** The unit of a rate. @param {string} unit of what changes */
export const perSecond = (unit) => `${unit || "1"}/s`;

/**
 * A unit as it is printed: "m/s^2" becomes "m/s²", and a number without a unit, whose unit is "1", has none.
 * @param {string} unit
 */
export function unitText(unit) {
  if (unit === "1") return "";
  return unit.replace(/\^(-?\d+)/g, (_, n) => raised(n)).replace(/\*/g, "·");
}

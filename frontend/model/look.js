/** How the plots are looked at: what is hidden, how much of the time, angles wrapped or not, one axis or several. */

/**
 * @typedef {object} Look
 * @property {boolean} wrapped  angles within (−π, π]
 * @property {"" | "one" | "each"} axes  curves of one unit share an axis while each is to be seen on it, always, or never
 * @property {readonly string[]} hidden  keys of curves
 * @property {readonly [number, number] | null} span  seconds that are shown; null for all
 */

/** Less of the time is never shown: a part of all of it. */
const LEAST = 1e-3;

/** As the address has it: "wrapped,each,-phi,2:4.5". @param {string} text @returns {Look} */
export function readLook(text) {
  const parts = text.split(",");
  const [, from, to] = parts.map((part) => part.match(/^([\d.]+):([\d.]+)$/)).find(Boolean) ?? [];
  return {
    wrapped: parts.includes("wrapped"),
    axes: parts.includes("one") ? "one" : parts.includes("each") ? "each" : "",
    hidden: parts.filter((part) => /^-\w/.test(part)).map((part) => part.slice(1)),
    span: Number(to) > Number(from) ? [Number(from), Number(to)] : null,
  };
}

/** @param {Look} look */
export function writeLook({ wrapped, axes, hidden, span }) {
  const time = span ? span.map((t) => String(Number(t.toFixed(4)))).join(":") : "";
  return [wrapped ? "wrapped" : "", axes, ...hidden.map((key) => `-${key}`), time].filter(Boolean).join(",");
}

/** @param {Look} look @param {string} key of a curve @returns {Look} */
export const toggled = (look, key) => ({
  ...look,
  hidden: look.hidden.includes(key) ? look.hidden.filter((other) => other !== key) : [...look.hidden, key],
});

/** What is shown of a motion: within it, and all of it where the address asks for nothing. @param {Look} look @param {number} end @returns {readonly [number, number]} */
export function spanOf({ span }, end) {
  return span && span[0] < end ? [span[0], Math.min(span[1], end)] : [0, end];
}

/**
 * Nearer to a moment, which keeps its place, or further away from it.
 * @param {Look} look @param {number} end @param {number} t @param {number} factor  below one is nearer
 * @returns {Look}
 */
export function zoomed(look, end, t, factor) {
  const [from, to] = spanOf(look, end);
  const about = Math.max(from, Math.min(to, t));
  const width = Math.max(LEAST * end, factor * (to - from));
  const part = (about - from) / (to - from);
  const begin = Math.max(0, Math.min(end - width, about - part * width));
  return { ...look, span: width >= end ? null : [begin, begin + width] };
}

/** From one moment to another, whichever comes first. @param {Look} look @param {number} end @param {number} a @param {number} b @returns {Look} */
export const between = (look, end, a, b) => ({
  ...look,
  span: Math.abs(a - b) < LEAST * end ? look.span : [Math.max(0, Math.min(a, b)), Math.min(end, Math.max(a, b))],
});

/** Turns to be taken off an angle. @param {number} angle */
const turnsOf = (angle) => Math.ceil(angle / (2 * Math.PI) - 0.5);

/** An angle within (−π, π]. @param {number} angle */
export const wrap = (angle) => angle - 2 * Math.PI * turnsOf(angle);

/**
 * A polyline of an angle within (−π, π]: it ends at one edge and goes on at the other, with a gap (NaN) between.
 * @param {readonly number[]} x @param {readonly number[]} y
 */
export function folded(x, y) {
  const made = { x: /** @type {number[]} */ ([]), y: /** @type {number[]} */ ([]) };
  const add = (/** @type {number} */ t, /** @type {number} */ value) => void (made.x.push(t), made.y.push(value));
  let turns = 0;
  y.forEach((angle, n) => {
    const next = turnsOf(angle);
    if (n === 0) turns = next;
    const step = Math.sign(next - turns);
    for (; turns !== next; turns += step) {
      const edge = (2 * turns + step) * Math.PI;
      const t = x[n - 1] + ((edge - y[n - 1]) / (angle - y[n - 1])) * (x[n] - x[n - 1]);
      for (const value of [step * Math.PI, NaN, -step * Math.PI]) add(t, value);
    }
    add(x[n], angle - 2 * Math.PI * turns);
  });
  return made;
}

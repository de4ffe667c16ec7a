/** Plane geometry in pixels, and the paths made of it. */

/** @typedef {import("../types.js").Pixel} Pixel */

/** @param {Pixel} a @param {Pixel} b @returns {Pixel} */
export const add = (a, b) => [a[0] + b[0], a[1] + b[1]];
/** @param {Pixel} a @param {Pixel} b @returns {Pixel} */
export const subtract = (a, b) => [a[0] - b[0], a[1] - b[1]];
/** @param {Pixel} a @param {number} s @returns {Pixel} */
export const scaled = (a, s) => [a[0] * s, a[1] * s];
/** @param {Pixel} a */
export const lengthOf = (a) => Math.hypot(a[0], a[1]);
/** A quarter turn, clockwise on the screen. @param {Pixel} a @returns {Pixel} */
export const normal = (a) => [-a[1], a[0]];

/** Direction of a; `otherwise` if it has none. @param {Pixel} a @param {Pixel} [otherwise] @returns {Pixel} */
export function unit(a, otherwise = [0, 1]) {
  const length = lengthOf(a);
  return length < 1e-9 ? otherwise : scaled(a, 1 / length);
}

/** @param {number} x */
const digits = (x) => Math.round(x * 100) / 100;
/** @param {Pixel} p */
export const at = (p) => `${digits(p[0])} ${digits(p[1])}`;
/** @param {Pixel} a @param {Pixel} b */
export const line = (a, b) => `M${at(a)}L${at(b)}`;
/** @param {readonly Pixel[]} points */
export const polyline = (points) => (points.length ? `M${points.map(at).join("L")}` : "");
/** @param {readonly Pixel[]} points */
export const polygon = (points) => `${polyline(points)}Z`;

/** @param {number} radius @param {Pixel} [centre] */
export function circle(radius, centre = [0, 0]) {
  const [x, y] = centre;
  const r = digits(radius);
  return `M${at([x - r, y])}a${r} ${r} 0 1 0 ${digits(2 * r)} 0a${r} ${r} 0 1 0 ${digits(-2 * r)} 0Z`;
}

/**
 * Arc from a direction, given by its angle from the downward vertical, by an angle that is positive counterclockwise.
 * @param {number} start @param {Pixel} centre @param {number} radius @param {number} angle
 */
export function arcFrom(start, centre, radius, angle) {
  const [begin, end] = [start, start + angle].map((turn) => add(centre, scaled(fromDown(turn), radius)));
  const large = Math.abs(angle) > Math.PI ? 1 : 0;
  const sweep = angle > 0 ? 0 : 1;
  return `M${at(begin)}A${digits(radius)} ${digits(radius)} 0 ${large} ${sweep} ${at(end)}`;
}

/**
 * The same arc there and back: it encloses nothing, so a path that is filled shows no more of it than its line.
 * @param {number} start @param {Pixel} centre @param {number} radius @param {number} angle
 */
export function sliverFrom(start, centre, radius, angle) {
  const large = Math.abs(angle) > Math.PI ? 1 : 0;
  const back = angle > 0 ? 1 : 0;
  const begin = add(centre, scaled(fromDown(start), radius));
  return `${arcFrom(start, centre, radius, angle)}A${digits(radius)} ${digits(radius)} 0 ${large} ${back} ${at(begin)}`;
}

/** Unit vector at an angle from the downward vertical. @param {number} angle @returns {Pixel} */
export const fromDown = (angle) => [Math.sin(angle), Math.cos(angle)];

/** The same angle between −π and π. @param {number} angle */
export const wrapped = (angle) => Math.atan2(Math.sin(angle), Math.cos(angle));

/** An arc as straight lines. @param {Pixel} centre @param {number} radius @param {number} start @param {number} turn @returns {import("../types.js").Strip[]} */
export function chords(centre, radius, start, turn) {
  const count = Math.ceil(Math.abs(turn) / 0.6);
  const on = (/** @type {number} */ i) => add(centre, scaled(fromDown(start + (turn * i) / count), radius));
  return Array.from({ length: count }, (_, i) => [on(i), on(i + 1)]);
}

/** Head of an arrow with its tip at `tip`. @param {Pixel} tip @param {Pixel} along @param {number} size */
export function arrowHead(tip, along, size) {
  const back = add(tip, scaled(along, -size));
  const side = scaled(normal(along), size * 0.36);
  return polygon([tip, add(back, side), add(back, scaled(along, size * 0.18)), subtract(back, side)]);
}

/**
 * A coil spring seen from the side: straight ends and the projection of a helix, stretched between its ends.
 * @param {Pixel} from @param {Pixel} to @param {number} radius @param {number} coils
 */
export function coil(from, to, radius, coils) {
  const along = unit(subtract(to, from));
  const across = normal(along);
  const length = lengthOf(subtract(to, from));
  const lead = Math.min(radius, length * 0.14);
  const body = Math.max(0, length - 2 * lead);
  const loop = Math.min(radius * 0.45, (body / coils) * 0.8);
  const steps = coils * 14;
  let path = `M${at(from)}`;
  // In plain numbers: a hundred pairs in every frame would soon be garbage to collect.
  for (let i = 0; i <= steps; i += 1) {
    const turn = (i / steps) * coils * 2 * Math.PI;
    const s = lead + loop * 0.5 + ((body - loop) * i) / steps - loop * 0.5 * Math.cos(turn);
    const aside = radius * Math.sin(turn);
    path += `L${digits(from[0] + along[0] * s + across[0] * aside)} ${digits(from[1] + along[1] * s + across[1] * aside)}`;
  }
  return `${path}L${at(to)}`;
}

/**
 * Short parallel strokes along a line, on the side `towards`.
 * @param {Pixel} from @param {Pixel} to @param {Pixel} towards @param {number} depth
 */
export function hatching(from, to, towards, depth) {
  const along = unit(subtract(to, from), [1, 0]);
  const length = lengthOf(subtract(to, from));
  const count = Math.max(2, Math.round(length / (depth * 0.8)));
  const stroke = add(scaled(towards, depth), scaled(along, depth * 0.8));
  return Array.from({ length: count }, (_, i) => {
    const start = add(from, scaled(along, (length - depth * 0.8) * (i / (count - 1))));
    return line(start, add(start, stroke));
  }).join("");
}

/**
 * How space is seen: by parallel rays from a camera that can be turned about the vertical and raised.
 *
 * On the screen x points to the right, and what is vertical up; away from the viewer is what makes the axes right-handed.
 */

/** @typedef {import("../types.js").Pixel} Pixel */
/** @typedef {{turn: number, raised: number}} Camera  angles in radians: about the vertical, and above the horizon */

/** From the front right, a little from above. @type {Camera} */
export const FRONT = { turn: 0.35, raised: 0.28 };
/** From straight above a turn about the vertical could not be told from a turn of the picture. */
const HIGHEST = 1.5;
/** Radians for each pixel of a dragging hand. */
const BY_HAND = 0.008;

/**
 * What a camera sees of a place in space: to the right, and along the vertical axis as its values grow; of a place in the
 * plane, the place itself.
 * @param {Camera} camera @param {boolean} up  whether the last component grows upwards
 * @returns {(position: readonly number[]) => Pixel}
 */
export function viewBy({ turn, raised }, up) {
  const [cos, sin] = [Math.cos(turn), Math.sin(turn)];
  const [level, above] = [Math.cos(raised), Math.sin(raised)];
  const sign = up ? 1 : -1;
  return (p) => {
    if (p.length < 3) return [p[0], p[1]];
    const away = sign * p[1];
    return [p[0] * cos - away * sin, p[2] * level + sign * (p[0] * sin + away * cos) * above];
  };
}

/** The camera after a hand has dragged space by so many pixels. @param {Camera} camera @param {Pixel} by @returns {Camera} */
export function turned({ turn, raised }, [dx, dy]) {
  const higher = Math.max(-HIGHEST, Math.min(HIGHEST, raised + BY_HAND * dy));
  return { turn: Math.atan2(Math.sin(turn + BY_HAND * dx), Math.cos(turn + BY_HAND * dx)), raised: higher };
}

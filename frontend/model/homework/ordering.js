/** Blocks in an order, and those left out. The answer is the letters of the first ones: `c; a; b`. */

/** @typedef {import("../types.js").Contract["TaskBlock"]} Block */
/** @typedef {{used: Block[], left: Block[]}} Arrangement  in their order; those left out as they came */

/** Whether blocks are to be put in order. @param {Pick<import("./sheet.js").Task, "form">} task */
export const isOrdering = ({ form }) => form === "order";

/** How a text arranges the blocks: as they came, where nothing has been moved yet. @param {readonly Block[]} blocks @param {string} text @returns {Arrangement} */
export function arranged(blocks, text) {
  const letters = [...new Set(text.toLowerCase().split(/[^a-z]+/))];
  const used = letters.flatMap((letter) => blocks.filter(({ id }) => id === letter));
  return used.length
    ? { used, left: blocks.filter((block) => !used.includes(block)) }
    : { used: [...blocks], left: [] };
}

/** @param {Arrangement} arrangement */
export const textOf = ({ used }) => used.map(({ id }) => id).join("; ");

/**
 * The block at a place among those in order, or left out (null). The last one stays: an order has a block.
 * @param {Arrangement} arrangement @param {string} id @param {number | null} place @returns {Arrangement}
 */
export function placed({ used, left }, id, place) {
  const block = [...used, ...left].find((one) => one.id === id);
  const rest = used.filter((one) => one !== block);
  if (!block || (place === null && !rest.length)) return { used, left };
  if (place === null) return { used: rest, left: [...left.filter((one) => one !== block), block].sort(byLetter) };
  return { used: [...rest.slice(0, place), block, ...rest.slice(place)], left: left.filter((one) => one !== block) };
}

/** @param {Block} a @param {Block} b */
const byLetter = (a, b) => (a.id < b.id ? -1 : 1);

/**
 * Where a step up (−1) or down (1) leads; undefined if nowhere. Those left out are below all others.
 * @param {Arrangement} arrangement @param {string} id @param {-1 | 1} by @returns {number | null | undefined}
 */
export function stepFrom({ used }, id, by) {
  const place = used.findIndex((one) => one.id === id);
  if (place < 0) return by < 0 ? used.length : undefined;
  const next = place + by;
  if (next === used.length) return used.length > 1 ? null : undefined;
  return next < 0 ? undefined : next;
}

/**
 * Where the letters of a drawing stand: each at the first of its places that is free, and there as long as it stays so.
 *
 * A place of its own is as good as the others, but for their order; elsewhere it stands the worse the further away it is.
 * A letter that finds no place on which it would cover no other letter, no head of an arrow and no body is not shown.
 */

import { sizeOf } from "../measure.js";
import { lengthOf, subtract } from "./geometry.js";

/** @typedef {import("../types.js").Figure} Figure */
/** @typedef {import("../types.js").Label} Label */
/** @typedef {import("../types.js").Pixel} Pixel */
/** @typedef {import("../types.js").Box} Box */
/** @typedef {import("../types.js").Strip} Strip */
/** @typedef {import("./stage.js").Stage} Stage */
/** @typedef {{boxes: Box[], strips: Strip[]}} Ground  what is drawn: letters keep off the boxes, and off the lines if they can */
/** @typedef {{label: Label, width: number, height: number, kept: Kept}} Guest */
/** @typedef {{choice: number, fresh: boolean, hidden: boolean, turn: number, moves: number}} Kept  of a letter: the number of its place; fresh: it has not been given one yet */

/** Costs, in the same unit as a place's distance from the first one in units of the drawing. */
const COVERS = 1000;
const LEAVES = 1500;
const CROSSES = 8;
const CROWDS = 20;
const STAYS = 4;
/** Of each place of its own further down in the order, in the same unit: all of these are near what it belongs to. */
const NEXT = 0.5;
/** Of going far from where it stands. */
const JUMPS = 0.6;
/** Units from its first place beyond which it is hard to see what a letter belongs to, and how much worse each further one is. */
const NEAR = 2.4;
const REMOTE = 6;
/** Above this a place is none. */
const MOST = 100;
/** How often in a second of the motion a letter looks for a better place than one that will do. */
const LOOKS = 1;
/** Directions about its first place that any letter can move to, and how far in units: beside a body as far as that is large; wide ones by their width more. */
const AROUND = 12;
const REACHES = [1.3, 2.4, 3.6, 5, 6.5];
/** Room about a letter, in em; and how large KaTeX sets one. */
const PADDING = 0.12;
const KATEX = 1.21;
/** Fractions are measured as in a formula of their own; in a line they are set smaller. */
const IN_LINE = 0.78;

/** The least and the usual size of letters, in rem and in units of the drawing: as in figure.css. */
const LETTER = { rem: 0.95, unit: 1.15 };

/** @param {Stage} stage */
export const letterSize = ({ rem, unit }) => Math.max(LETTER.rem * rem, LETTER.unit * unit);

/** Width and height of a letter in pixels. @param {Stage} stage @param {string} latex @returns {[number, number]} */
function extent(stage, latex) {
  const { width, height, depth } = stage.once(`extent ${latex}`, () => sizeOf(latex));
  const em = letterSize(stage) * (latex.includes("\\frac") ? IN_LINE : 1);
  return [(width * KATEX + 2 * PADDING) * em, Math.max(1, (height + depth) * KATEX) * em];
}

/** A box about a place. @param {Pixel} at @param {number} across @param {number} [along] @returns {Box} */
export const boxAbout = ([x, y], across, along = across) => [x - across, y - along, x + across, y + along];

/** The area that two boxes share. @param {Box} a @param {Box} b */
export function shared(a, b) {
  const across = Math.min(a[2], b[2]) - Math.max(a[0], b[0]);
  const along = Math.min(a[3], b[3]) - Math.max(a[1], b[1]);
  return across > 0 && along > 0 ? across * along : 0;
}

/** Whether a line passes through a box (Liang and Barsky). @param {Strip} strip @param {Box} box */
export function passes([[x, y], [x1, y1]], box) {
  const [dx, dy] = [x1 - x, y1 - y];
  let [enters, leaves] = [0, 1];
  for (const [by, room] of [
    [-dx, x - box[0]],
    [dx, box[2] - x],
    [-dy, y - box[1]],
    [dy, box[3] - y],
  ]) {
    if (by === 0 && room < 0) return false;
    if (by < 0) enters = Math.max(enters, room / by);
    if (by > 0) leaves = Math.min(leaves, room / by);
  }
  return enters < leaves;
}

/** @param {Figure} figure @returns {Ground} */
export function groundOf({ shapes }) {
  return {
    boxes: shapes.flatMap(({ boxes }) => boxes ?? []),
    strips: shapes.flatMap(({ strips }) => strips ?? []),
  };
}

/** Where a letter can stand, the best first. @param {Guest} guest @param {number} unit @returns {Pixel[]} */
function placesOf({ label: { at, others = [] }, width }, unit) {
  const more = Math.max(0, width / 2 - unit);
  const around = REACHES.flatMap((reach) =>
    Array.from({ length: AROUND }, (_, i) => {
      const turn = (i * 2 * Math.PI) / AROUND;
      const [across, along] = [reach * unit + more, reach * unit];
      return /** @type {Pixel} */ ([at[0] + across * Math.cos(turn), at[1] + along * Math.sin(turn)]);
    }),
  );
  return [at, ...others, ...around];
}

/** @param {Guest} guest @param {Pixel} at @returns {Box} */
const boxOf = ({ width, height }, at) => boxAbout(at, width / 2, height / 2);

/** What is wrong with a place. @param {Box} box @param {Stage} stage @param {Ground} ground @param {readonly Box[]} taken */
function faults(box, { size, reserved }, ground, taken) {
  const area = (box[2] - box[0]) * (box[3] - box[1]);
  let cost = 0;
  for (const other of taken) if (shared(box, other) > 0) return Infinity;
  for (const other of ground.boxes) if (shared(box, other) > 0) cost += COVERS;
  for (const other of reserved) cost += (LEAVES * shared(box, other)) / area;
  cost += LEAVES * (1 - shared(box, [0, 0, size.width, size.height]) / area);
  for (const strip of ground.strips) if (passes(strip, box)) cost += CROSSES;
  return cost;
}

/**
 * Chooses a place among all: the one with the least to be said against it and nearest to the first.
 * @param {Guest} guest @param {Stage} stage @param {Ground} ground @param {readonly Box[]} taken @param {readonly Box[]} coming  where the letters behind it stand now
 */
function choose(guest, stage, ground, taken, coming) {
  const { label, kept } = guest;
  const places = placesOf(guest, stage.unit);
  const present = kept.hidden || kept.fresh ? -1 : kept.choice;
  let [best, least] = [-1, MOST];
  for (let choice = 0; choice < places.length; choice += 1) {
    const own = choice <= (label.others?.length ?? 0);
    const off = own ? NEXT * stage.unit * choice : lengthOf(subtract(places[choice], label.at));
    const jump = present < 0 ? 0 : lengthOf(subtract(places[choice], places[present]));
    const remote = own ? 0 : REMOTE * Math.max(0, off / stage.unit - NEAR);
    const far = (off + JUMPS * jump) / stage.unit + remote - (choice === present ? STAYS : 0);
    if (far >= least) continue;
    const box = boxOf(guest, places[choice]);
    let cost = far + faults(box, stage, ground, taken);
    for (const other of coming) if (cost < least && shared(box, other) > 0) cost += CROWDS;
    if (cost < least) [best, least] = [choice, cost];
  }
  return best;
}

/** Whether a letter may stay where it is without looking further. @param {Guest} guest @param {Stage} stage @param {Ground} ground @param {readonly Box[]} taken @param {Pixel} at */
function stays({ kept, width, height }, stage, ground, taken, at) {
  return !kept.hidden && faults(boxAbout(at, width / 2, height / 2), stage, ground, taken) < MOST;
}

/**
 * The figure with its letters where they find room. Letters are given their places in their order.
 * @param {Stage} stage @param {Figure} figure @param {number} t
 * @param {Ground & {letters: Box[], turn?: number}} [beside]  what is drawn already, to be kept off; turn: what makes all letters look for a place anew when it changes
 * @returns {Figure & {ground: Ground & {letters: Box[]}}}
 */
export function placed(stage, figure, t, beside = { boxes: [], strips: [], letters: [] }) {
  const own = groundOf(figure);
  const ground = { boxes: [...own.boxes, ...beside.boxes], strips: [...own.strips, ...beside.strips] };
  const turn = Math.floor(t * LOOKS) + (beside.turn ?? 0);
  const guests = figure.labels.map((label) => guestOf(stage, label, turn));
  const taken = [...beside.letters];
  const labels = guests.map((guest, i) => {
    const { label, kept } = guest;
    if (label.opacity === 0) return label;
    const present = placesOf(guest, stage.unit)[kept.choice];
    if (kept.turn !== turn || !stays(guest, stage, ground, taken, present)) {
      const coming = guests.slice(i + 1).flatMap((other) => nowOf(other, stage.unit));
      settle(kept, choose(guest, stage, ground, taken, coming), turn);
    }
    const at = kept.hidden ? label.at : placesOf(guest, stage.unit)[kept.choice];
    if (!kept.hidden) taken.push(boxOf(guest, at));
    return { ...label, at, moves: kept.moves + (label.moves ?? 0), ...(kept.hidden ? { opacity: 0 } : {}) };
  });
  return { shapes: figure.shapes, labels, ground: { ...ground, letters: taken } };
}

/** @param {Stage} stage @param {Label} label @param {number} turn @returns {Guest} */
function guestOf(stage, label, turn) {
  const [width, height] = extent(stage, label.latex);
  const kept = stage.once(`place ${label.key}`, () => ({
    choice: 0,
    fresh: true,
    hidden: false,
    turn: turn - 1,
    moves: 0,
  }));
  return { label, width, height, kept };
}

/** @param {Guest} guest @param {number} unit @returns {Box[]} */
function nowOf(guest, unit) {
  const { label, kept } = guest;
  return kept.hidden || label.opacity === 0 ? [] : [boxOf(guest, placesOf(guest, unit)[kept.choice])];
}

/** @param {Kept} kept @param {number} choice @param {number} turn */
function settle(kept, choice, turn) {
  const hidden = choice < 0;
  if (!hidden && (kept.hidden || choice !== kept.choice)) kept.moves += 1;
  Object.assign(kept, { choice: hidden ? kept.choice : choice, fresh: false, hidden, turn });
}

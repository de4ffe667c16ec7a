/**
 * What the page draws of scenes, held against their motion asked for with many more samples; in pixels.
 *
 * Reads a line {scene, changes, method} for each case and answers it with {worst: {curve: pixels}, samples, coarse}. In
 * between it asks for what the page asks for, {ask: request}, and reads the answer.
 */

import { createInterface } from "node:readline";
import { figureOf, withDrawing } from "../../frontend/model/drawing/figure.js";
import { trailOf } from "../../frontend/model/drawing/trail.js";
import { placed } from "../../frontend/model/drawing/placing.js";
import { stageOf } from "../../frontend/model/drawing/stage.js";
import { portraitsOf } from "../../frontend/model/figure/phase.js";
import { picturesOf } from "../../frontend/model/history.js";
import { unpacked } from "../../frontend/model/columns.js";
import { rowsOf } from "../../frontend/model/curves.js";
import { layoutOf, scalesOf, tracesOf } from "../../frontend/model/plots.js";
import { requestOf } from "../../frontend/model/request.js";
import { sampled } from "../../frontend/model/sampling.js";
import { coverage } from "./symbols.js";
import { START } from "../../frontend/model/state.js";
import { degreesOf } from "../../frontend/model/subject.js";
import { kinematicsOf } from "../../frontend/model/kinematics/kinematics.js";
import { endOf, snapshotAt } from "../../frontend/model/trajectory.js";
import { readChoice } from "../../frontend/model/virtual/choice.js";
import { virtualFigure } from "../../frontend/model/virtual/figure.js";
import { virtualOf } from "../../frontend/model/virtual/virtual.js";

/** The plots of a lecture on a projector. */
const FRAME = { width: 1280, height: 700, em: 16, duration: 10 };
const PALETTE = { ink: "", muted: "", grid: "", paper: "", of: () => "" };
/** Dense samples to an interval: none of them in its middle, where a polynomial is best. */
const FINER = 3;

const lines = createInterface({ input: process.stdin })[Symbol.asyncIterator]();
const read = async () => JSON.parse((await lines.next()).value ?? "null");
const tell = (/** @type {object} */ said) => process.stdout.write(`${JSON.stringify(said)}\n`);

/** In planes, whose bits are as few as on the page. @param {object} request */
async function simulate(request) {
  tell({ ask: { ...request, columns: "planes" } });
  return unpacked(await read());
}

/** How far a point is from a chord. */
function beside([x, y], [ax, ay], [bx, by]) {
  const [dx, dy] = [bx - ax, by - ay];
  const s = Math.max(0, Math.min(1, ((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy || 1)));
  return Math.hypot(x - ax - s * dx, y - ay - s * dy);
}

/** Corners of a polyline ahead of the last one met, among which the next may be; and pixels beyond which nothing is followed. */
const AHEAD = 12;
const LOST = 2;

/**
 * The largest distance of points, in the order of time, from a polyline that is followed along with them (Fréchet's):
 * a line that is gone over again and again is met in its order, too.
 */
function departure(points, corners) {
  const last = Math.max(0, corners.length - 2);
  /** Largest distance on the best way to each chord from number `first` on. */
  let [first, here] = [0, [0]];
  for (const point of points) {
    const found = [];
    for (let n = first; n <= Math.min(last, first + here.length - 1 + AHEAD); n += 1) {
      let best = LOST;
      for (let from = Math.max(0, n - AHEAD - first); from <= n - first && from < here.length; from += 1) best = Math.min(best, here[from]);
      found.push(best < LOST ? Math.min(LOST, Math.max(best, beside(point, corners[n], corners[n + 1] ?? corners[n]))) : LOST);
    }
    const begin = found.findIndex((far) => far < LOST);
    if (begin < 0) return LOST;
    [first, here] = [first + begin, found.slice(begin, found.findLastIndex((far) => far < LOST) + 1)];
  }
  return Math.min(...here);
}

/** Corners of a path "M1 2L3 4". */
const cornersOf = (d) => d.slice(1).split("L").map((pair) => pair.split(" ").map(Number));

/** All that has a curve over time, by its key. */
function valuesOf({ coordinates, energy, multipliers, friction, contacts }) {
  const reactions = Object.entries(multipliers ?? {}).map(([name, column]) => [`reaction-${name}`, column]);
  const frictions = Object.entries(friction ?? {}).flatMap(([name, { force, largest }]) => [
    [`friction-${name}`, force],
    [`most-${name}`, largest],
    [`least-${name}`, largest.map((value) => -value)],
  ]);
  const pushing = Object.entries(contacts ?? {}).map(([name, { force }]) => [`contact-${name}`, force]);
  return { ...coordinates, ...energy, ...Object.fromEntries([...reactions, ...frictions, ...pushing]) };
}

/** Seconds around a jump in which two motions may be on either side of it. */
const JUMP = 1e-9;

/** The numbers of the samples that are not at a jump, whose time stands twice. */
function apartFromJumps({ t: times }, { t }) {
  const jumps = times.filter((at, i) => at === times[i + 1]);
  return t.flatMap((at, i) => (jumps.some((jump) => Math.abs(at - jump) < JUMP) ? [] : [i]));
}

/** Curves over time, as they are handed to Plotly. */
function ofPlots(scene, drawn, dense) {
  const rows = rowsOf(scene, drawn);
  const scales = scalesOf(rows, FRAME);
  const layout = layoutOf(rows, FRAME.duration, PALETTE, "en", FRAME.height, FRAME.em);
  const traces = tracesOf(rows, drawn, PALETTE, FRAME).filter((trace) => !("fill" in trace));
  const values = valuesOf(dense);
  return traces.map(({ name, x, y, yaxis }) => {
    const r = Number(yaxis.slice(1) || 1) - 1;
    const [low, high] = layout[r ? `yaxis${r + 1}` : "yaxis"].range;
    const shown = dense.t.map((t, i) => [t, values[name][i]]).filter(([, value]) => value >= low && value <= high);
    return [`plot ${name}`, departure(shown.map(([t, v]) => scales[r](t, v)), x.map((t, i) => scales[r](t, y[i])))];
  });
}

/** From values to pixels, by the first and the last number on an axis. @param {{value: number, position: number}[]} ticks */
function axisOf(ticks) {
  const [a, b] = [ticks[0], ticks[ticks.length - 1]];
  return (/** @type {number} */ value) => a.position + ((value - a.value) / (b.value - a.value)) * (b.position - a.position);
}

/** Phase portraits, from the path in the page's SVG; its axes are read off two of their numbers. */
function ofPhase(scene, drawn, dense) {
  return portraitsOf(scene, [drawn], FRAME, FRAME.em).flatMap((portrait) => {
    const { name, columns, rows, paths, where } = portrait;
    if (columns.length < 2 || rows.length < 2) return [];
    const [x, y] = [axisOf(columns), axisOf(rows)];
    const points = dense.t.map((_, i) => [x(dense.coordinates[name][i]), y(dense.rates[name][i])]);
    const state = Math.max(...apartFromJumps(drawn, dense).map((i) => Math.hypot(...where(dense.t[i]).map((x, c) => x - points[i][c]))));
    return [[`phase ${name}`, departure(points, cornersOf(paths[0]))], [`state ${name}`, state]];
  });
}

/** The rates with which the portraits end, as they are read off the paper. */
function endsOf(scene, drawn) {
  const read = portraitsOf(scene, [drawn], FRAME, FRAME.em).filter(({ rows }) => rows.length > 1).map(({ name, rows, paths }) => {
    const [a, b] = [rows[0], rows[rows.length - 1]];
    return [name, a.value + ((cornersOf(paths[0]).at(-1)[1] - a.position) / (b.position - a.position)) * (b.value - a.value)];
  });
  return Object.fromEntries(read);
}

/** Places in the drawing: at each moment, and the paths they leave. */
function ofDrawing(scene, drawn, dense) {
  const stage = stageOf(withDrawing(scene, drawn), drawn, FRAME);
  figureOf(stage, snapshotAt(drawn, endOf(drawn) / 3));
  const now = dense.t.map((t) => snapshotAt(drawn, t).positions);
  return Object.entries(dense.positions).flatMap(([name, path]) => {
    const points = path.map(stage.project);
    const moving = Math.max(...apartFromJumps(drawn, dense).map((i) => Math.hypot(...stage.project(now[i][name]).map((x, c) => x - points[i][c]))));
    const trail = trailOf(stage, name, 0, endOf(drawn));
    return [[`place ${name}`, moving], [`path ${name}`, departure(points, cornersOf(trail))]];
  });
}

/** The panes of the drawing on a laptop, beside its plots and on a slide, and moments of the motion in a second that are looked at. */
const PANES = { page: [{ width: 560, height: 330 }, 16], slide: [{ width: 445, height: 690 }, 19.8] };
const LOOKS = 12;
/** Letters count as shown from this opacity on. */
const SEEN = 0.3;

/** The corners of a box from points. @param {number[]} xs @param {number[]} ys */
const around = (xs, ys) => [Math.min(...xs), Math.min(...ys), Math.max(...xs), Math.max(...ys)];
const meet = (a, b) => Math.min(a[2], b[2]) - Math.max(a[0], b[0]) > 1 && Math.min(a[3], b[3]) - Math.max(a[1], b[1]) > 1;

/** Part of the width and height of a rim in space that its disc fills for sure, whichever way it is turned: a square within an ellipse. */
const FILLED = 0.7;
/** The middle of a box. */
const within = ([x0, y0, x1, y1], part) => [
  ...[[x0, x1], [y0, y1]].map(([a, b]) => (a + b) / 2 - (part * (b - a)) / 2),
  ...[[x0, x1], [y0, y1]].map(([a, b]) => (a + b) / 2 + (part * (b - a)) / 2),
];

/** What a letter may not cover: the heads of arrows, which are the last closed part of their paths, and bodies: balls, discs, carts and blocks. */
function forbidden({ d, at, className }) {
  const numbers = d.slice(d.lastIndexOf("M")).match(/-?[\d.]+/g)?.map(Number) ?? [];
  if (/pointed|head/.test(className) && d.endsWith("Z")) return [around(numbers.filter((_, i) => i % 2 === 0), numbers.filter((_, i) => i % 2))];
  if (!/^ink steel .*\bbody-/.test(className)) return [];
  if (!at) return [within(around(numbers.filter((_, i) => i % 2 === 0), numbers.filter((_, i) => i % 2)), FILLED)];
  const [x, y] = at;
  const [left, top] = [-numbers[0], -Math.abs(numbers[1] || numbers[0])];
  return [[x - left, y + top, x + left, y - top]];
}

/** The read-outs of all coordinates, one below the other in a corner. @param {any} scene @param {number} rem */
const readouts = (scene, rem) =>
  scene.coordinates.map((_, i) => [rem, (0.75 + 1.25 * i) * rem, 8 * rem, (2 + 1.25 * i) * rem]);

/** The box of a letter as it is seen. @param {{latex: string, at: [number, number]}} label @returns {[string, number[]]} */
function seenBox({ latex, at: [x, y] }, rem = 16) {
  const letter = 0.95 * rem * 1.21;
  const [above, below] = /\\frac\{(.*?)\}\{(.*)/.exec(latex)?.slice(1) ?? [latex, ""];
  const letters = (text) => text.replace(/\\mathbf|\\[,!]|[{}_]/g, "").replace(/\\[a-z]+/g, "x").replace(/\s/g, "").length;
  const half = (0.9 * letter * Math.max(letters(above), letters(below)) * 0.5) / 2;
  const high = below ? 0.6 * letter : 0.35 * letter;
  return [latex, [x - half, y - high, x + half, y + high]];
}

/** Counts which of the letters that come last cover which others or what they may not, and which find no place. */
function counted(count, letters, others, forbiddenBoxes, rem) {
  const shown = letters.filter(({ opacity = 1 }) => opacity > SEEN).map((label) => seenBox(label, rem));
  shown.forEach(([latex, box], i) => {
    const covered = [...shown.slice(i + 1), ...others].filter(([, other]) => meet(box, other)).map(([other]) => other);
    for (const other of forbiddenBoxes) if (meet(box, other)) covered.push("a head or body");
    for (const one of covered) count.covers[`${latex} on ${one}`] = (count.covers[`${latex} on ${one}`] ?? 0) + 1;
  });
  count.shown += shown.length;
  for (const { latex } of letters.filter(({ opacity }) => opacity === 0)) {
    count.hidden += 1;
    count.without[latex] = (count.without[latex] ?? 0) + 1;
  }
  return shown;
}

/** Which letters cover what, and how many there are and are not shown: while the motion runs, and of δr with its parts. */
function ofLetters(scene, drawn, result, [pane, rem]) {
  const numbers = readouts(scene, rem);
  const stage = stageOf(withDrawing(scene, drawn), drawn, pane, { rem, reserved: numbers });
  const [own, varied] = [0, 1].map(() => ({ covers: {}, shown: 0, hidden: 0, without: {} }));
  const kinematics = kinematicsOf(scene, result, {});
  const bodies = scene.bodies.map(({ name }) => name);
  const delta = readChoice("on", scene.coordinates.filter(({ name }) => kinematics.free.includes(name)));
  for (let t = 0; t < endOf(drawn); t += 1 / LOOKS) {
    const now = snapshotAt(drawn, t);
    const { labels, shapes, ground } = placed(stage, figureOf(stage, now), t);
    const heads = shapes.flatMap(forbidden);
    const shown = counted(own, labels, numbers.map((box) => ["a number", box]), heads, rem);
    const { over } = virtualFigure(stage, virtualOf(kinematics, now, bodies, delta));
    const above = placed(stage, over, t, ground);
    counted(varied, above.labels, shown, [...heads, ...above.shapes.flatMap(forbidden)], rem);
  }
  return { own, varied };
}

/** The pictures of a handout. */
function ofHandout(scene, drawn, dense) {
  const values = valuesOf(dense);
  const keys = Object.fromEntries(rowsOf(scene, drawn).flatMap(({ curves }) => curves.map(({ latex, key }) => [latex, key])));
  return picturesOf(scene, drawn).filter(({ rows }) => rows.length > 1).flatMap(({ lines, columns, rows }) => lines.map(({ latex, path }) => {
    const [x, y] = [axisOf(columns), axisOf(rows)];
    return [`handout ${latex}`, departure(dense.t.map((t, i) => [x(t), y(values[keys[latex]][i])]), cornersOf(path))];
  }));
}

/** @param {{scene: any, derivation?: any, changes?: object, method?: string}} asked */
async function measure({ scene, derivation, changes = {}, method = "" }) {
  const methods = [{ id: "rk4", adaptive: false }, { id: "dop853", adaptive: true }, { id: "bogacki-shampine-32", adaptive: true }];
  const place = { ...START.place, scene: scene.id, duration: FRAME.duration, lang: "en" };
  const request = requestOf({ ...START, place, methods }, { initial: {}, parameters: {}, ...changes }, method);
  const drawn = await sampled(simulate)(request);
  const intervals = Math.round(request.t_end / (drawn.t[1] - drawn.t[0]));
  const dense = await simulate({ ...request, samples: Math.min(FINER * intervals, 20000) + 1 });
  const found = [ofPlots, ofPhase, ofDrawing, ofHandout].flatMap((of) => of(scene, drawn, dense));
  tell({ worst: Object.fromEntries(found), samples: drawn.t.length, coarse: drawn.coarse, end: endsOf(scene, drawn), degrees: degreesOf(scene), ...(derivation && { letters: Object.values(PANES).flatMap((pane) => Object.values(ofLetters(scene, drawn, derivation.result, pane))), symbols: coverage(scene, drawn, derivation) }) });
}

for (let asked = await read(); asked; asked = await read()) await measure(asked);

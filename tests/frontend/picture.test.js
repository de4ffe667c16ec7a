import { strict as assert } from "node:assert";
import { test } from "node:test";
import { rowsOf } from "../../frontend/model/curves.js";
import { readLook } from "../../frontend/model/look.js";
import { lettersOf } from "../../frontend/model/picture/letters.js";
import { familiesOf, paint, svgOf } from "../../frontend/model/picture/picture.js";
import { withLength } from "../../frontend/model/picture/webm.js";
import { tableOf } from "../../frontend/model/picture/table.js";
import { isShown } from "../../frontend/model/plots.js";
import { decimalsKnown } from "../../frontend/model/trajectory.js";
import { scene, trajectory } from "./fixtures.js";

const FONT = { weight: "400", style: "italic", size: 20, family: "KaTeX_Math, serif" };
const LETTER = { kind: "text", text: "a<b & \"c\"", x: 10, y: 20.12345, font: FONT, fill: "#112233", opacity: 1 };
const SHAPE = {
  kind: "shape", d: "M0 0L1 1", matrix: [1, 0, 0, 1, 0, 0], fill: "none", stroke: "#000000", width: 2, dash: [4, 2], cap: "round",
  join: "miter", fillOpacity: 1, strokeOpacity: 0.5, clip: null,
};
const CLIP = { x: 1, y: 2, width: 30, height: 40 };
const picture = (...marks) => ({ width: 100, height: 50, background: "#ffffff", marks });
const AROUND = { title: "Bob & rod", fonts: "" };

test("letters of a picture cannot become marks of the file", () => {
  const made = svgOf(picture(LETTER), AROUND);
  assert.match(made, /<title>Bob &amp; rod<\/title>/);
  assert.match(made, /<text xml:space="preserve" x="10" y="20.123" fill="#112233" font-family="KaTeX_Math, serif" font-size="20" font-style="italic">a&lt;b &amp; &quot;c&quot;<\/text>/);
  assert.doesNotMatch(svgOf(picture({ ...LETTER, fill: '"/><script>' }), AROUND), /<script/);
});

test("lines keep their width, dashes, ends and opacity, and what is usual is not written", () => {
  assert.match(svgOf(picture(SHAPE), AROUND), /<path d="M0 0L1 1" fill="none" stroke="#000000" stroke-width="2" stroke-opacity="0.5" stroke-dasharray="4 2" stroke-linecap="round"\/>/);
  const filled = { ...SHAPE, fill: "#ff0000", stroke: "none", fillOpacity: 0.25 };
  assert.match(svgOf(picture(filled), AROUND), /<path d="M0 0L1 1" fill="#ff0000" fill-opacity="0.25"\/>/);
  assert.match(svgOf(picture({ ...SHAPE, matrix: [2, 0, 0, 2, 5, 6] }), AROUND), /transform="matrix\(2 0 0 2 5 6\)"/);
});

test("each box that cuts is named once", () => {
  const other = { ...SHAPE, clip: { ...CLIP, x: 7 } };
  const made = svgOf(picture({ ...SHAPE, clip: CLIP }, other, { ...SHAPE, clip: { ...CLIP } }, SHAPE), AROUND);
  assert.equal(made.match(/<clipPath/g)?.length, 2);
  assert.deepEqual([...made.matchAll(/<g clip-path="url\(#(clip-\d)\)"/g)].map(([, name]) => name), ["clip-0", "clip-1", "clip-0"]);
  assert.match(made, /<clipPath id="clip-1"><path d="M7 2h30v40h-30z"\/>/);
});

test("only the letters that are used go with a picture", () => {
  assert.deepEqual(familiesOf(picture(LETTER, SHAPE), ["KaTeX_Main", "KaTeX_Math", "Source Serif 4"]), ["KaTeX_Math"]);
});

test("a canvas is painted in the order of the marks, each by itself", () => {
  const said = [];
  const ink = new Proxy({}, {
    get: (_, name) => (...given) => said.push([name, ...given]),
    set: (_, name, value) => said.push([`${name} =`, value]) > 0,
  });
  globalThis.Path2D = class { constructor(d) { this.d = d; } };
  paint(ink, picture({ ...SHAPE, clip: CLIP, fill: "#00ff00" }, LETTER), 2);
  const did = (name) => said.findIndex(([what]) => what === name);
  assert.deepEqual(said[0], ["setTransform", 2, 0, 0, 2, 0, 0]);
  assert.ok(did("fillRect") < did("save") && did("rect") < did("clip") && did("clip") < did("transform") && did("fill") < did("stroke") && did("stroke") < did("fillText"));
  assert.deepEqual(said.filter(([what]) => what === "save" || what === "restore").map(([what]) => what), ["save", "restore", "save", "restore"]);
  assert.ok(said.some(([what, value]) => what === "font =" && value === "italic 400 20px KaTeX_Math, serif"));
});

test("a table has the moments of the samples, and the curves that are shown", () => {
  const rows = rowsOf(scene, trajectory);
  const lines = tableOf(rows, isShown).trimEnd().split("\r\n");
  const [first] = scene.coordinates;
  assert.equal(lines.length, trajectory.t.length + 1);
  assert.equal(lines[0].split(",").length, 1 + rows.flatMap(({ curves }) => curves).length);
  assert.ok(lines[0].startsWith(`t in s,${first.name} in `));
  for (const [i, t] of trajectory.t.entries()) {
    const [at, value] = lines[i + 1].split(",").map(Number);
    assert.equal(at, t);
    assert.ok(Math.abs(value - trajectory.coordinates[first.name][i]) <= trajectory.error.estimate[i]);
  }
  const hidden = rowsOf(scene, trajectory, [], readLook(`-${first.name}`));
  assert.ok(!tableOf(hidden, isShown).split("\r\n")[0].includes(`${first.name} in`));
});

test("the last digit of a table is the first in doubt", () => {
  const values = [0.123456789, 1e-7, -12345.678912345, 2];
  const rows = [
    ["error 3e-4", [3e-4, 3e-4, 3e-4, 3e-4], ["0.1235", "0", "-12345.6789", "2"]],
    ["error 2", [2, 2, 2, 2], ["0", "0", "-12346", "2"]],
    ["the larger one of two", [1e-9, 1e-9, 1e-3, 1e-3], ["0.123456789", "1e-7", "-12345.679", "2"]],
    ["as written, without an estimate", [], ["0.123456789", "1e-7", "-12345.678912345", "2"]],
    ["as written, where there is none", [null, null, null, null], ["0.123456789", "1e-7", "-12345.678912345", "2"]],
  ];
  const at = (t) => values[t];
  for (const [name, errors, wanted] of rows) {
    const curve = { key: "q", values, times: [0, 1, 2, 3], at, decimals: decimalsKnown([0, 1, 2, 3], values, errors), beside: false, wrapped: false };
    const lines = tableOf([{ unit: "m", curves: [curve] }], () => true).trimEnd().split("\r\n").slice(1);
    assert.deepEqual(lines.map((line) => line.split(",")[1]), wanted, name);
  }
});

test("a film has its length where players look for it, and the rest as it was", () => {
  const bytes = (text) => Uint8Array.from(Buffer.from(text.replaceAll(" ", ""), "hex"));
  const head = "1A45DFA3 84 42868101";
  const open = "18538067 01FFFFFFFFFFFFFF";
  const scale = "2AD7B1 83 0F4240"; // 1,000,000 ns: ticks are milliseconds
  const cluster = "1F43B675 01FFFFFFFFFFFFFF E7 81 00";
  const film = bytes(`${head} ${open} 1549A966 87 ${scale} ${cluster}`);
  const long = "4489 88 40A7700000000000"; // 3000 as a double
  assert.deepEqual(withLength(film, 3), bytes(`${head} ${open} 1549A966 0100000000000012 ${scale} ${long} ${cluster}`));
  const fine = bytes(`${head} ${open} 1549A966 87 2AD7B1 83 07A120 ${cluster}`); // half as long ticks
  assert.equal(new DataView(withLength(fine, 1.5).buffer).getFloat64(head.replaceAll(" ", "").length / 2 + 12 + 12 + 7 + 3), 3000);
  for (const same of [`${head} ${open} 1549A966 92 ${scale} ${long} ${cluster}`, `${head} 18538067 8C 1549A966 87 ${scale}`, head, "00 01 02", ""])
    assert.deepEqual(withLength(bytes(same), 3), bytes(same));
});

test("runs beside have columns of their own, which end where they end", () => {
  const until = trajectory.t[Math.floor(trajectory.t.length / 2)];
  const count = trajectory.t.filter((t) => t <= until).length;
  const cut = (values) => values.slice(0, count);
  const every = (record) => Object.fromEntries(Object.entries(record).map(([name, values]) => [name, cut(values)]));
  const short = { ...trajectory, t: cut(trajectory.t), coordinates: every(trajectory.coordinates), rates: every(trajectory.rates), energy: trajectory.energy && every(trajectory.energy) };
  const [head, ...lines] = tableOf(rowsOf(scene, trajectory, [short, trajectory]), isShown).trimEnd().split("\r\n");
  const names = head.split(",");
  const [name] = scene.coordinates.map((one) => one.name);
  const [one, two, three] = ["", " (2)", " (3)"].map((run) => names.findIndex((column) => column.startsWith(`${name}${run} in `)));
  assert.ok(one > 0 && two > 0 && three > 0);
  const cells = lines.map((line) => line.split(","));
  assert.deepEqual(cells.map((row) => row[two] !== ""), trajectory.t.map((t) => t <= until));
  assert.deepEqual(cells.map((row) => row[three]), cells.map((row) => row[one]));
});

test("letters go along as data, and those that cannot be had are left out", async () => {
  const data = Uint8Array.from({ length: 20_000 }, (_, i) => i % 256);
  const send = async (address) => {
    if (address.endsWith("lost.woff2")) throw new TypeError("no network");
    return new Response(address.endsWith("gone.woff2") ? null : data, { status: address.endsWith("gone.woff2") ? 404 : 200 });
  };
  const face = (name) => ({ family: `Family ${name}`, slant: "italic", weight: "", address: `https://a.example/${name}.woff2` });
  const made = await lettersOf(send, ["here", "lost", "gone"].map(face));
  const [, described, written] = made.match(/^@font-face\{(.*);src:url\(data:font\/woff2;base64,(.*)\) format\("woff2"\)\}$/);
  assert.equal(described, 'font-family:"Family here";font-style:italic;font-weight:normal');
  assert.deepEqual(new Uint8Array(Buffer.from(written, "base64")), data);
});

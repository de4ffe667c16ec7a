/**
 * A picture of what is seen: marks in the order in which they are painted, in pixels of the screen; as SVG, and on a
 * canvas.
 */

/** @typedef {readonly [number, number, number, number, number, number]} Matrix  as SVG and canvas have it: a b c d e f */
/** @typedef {{x: number, y: number, width: number, height: number}} Box */
/** @typedef {{weight: string, style: string, size: number, family: string}} Font  family: a list as CSS has it */
/**
 * @typedef {{kind: "shape", d: string, matrix: Matrix, fill: string, stroke: string, width: number, dash: readonly number[],
 *   cap: string, join: string, fillOpacity: number, strokeOpacity: number, clip: Box | null}} ShapeMark
 * @typedef {{kind: "text", text: string, x: number, y: number, font: Font, fill: string, opacity: number}} TextMark  from the left, on the baseline
 * @typedef {ShapeMark | TextMark} Mark
 * @typedef {{width: number, height: number, background: string, marks: readonly Mark[]}} Picture
 */

/** @param {string} text */
const escaped = (text) =>
  text.replace(/[&"<>]/g, (sign) => ({ "&": "&amp;", '"': "&quot;", "<": "&lt;", ">": "&gt;" })[sign] ?? "");

/** @param {number} value */
const short = (value) => String(Number(value.toFixed(3)));

/** @param {Record<string, string | number | null>} attributes  those that are null are left out */
const written = (attributes) =>
  Object.entries(attributes)
    .filter(([, value]) => value !== null)
    .map(([name, value]) => ` ${name}="${typeof value === "number" ? short(value) : escaped(String(value))}"`)
    .join("");

/** @param {Box} box */
const boxPath = ({ x, y, width, height }) =>
  `M${short(x)} ${short(y)}h${short(width)}v${short(height)}h${short(-width)}z`;

/** @param {Matrix} matrix */
const isIdentity = (matrix) => matrix.every((value, i) => value === (i === 0 || i === 3 ? 1 : 0));

/** @param {ShapeMark} shape @param {string} clip  its name, or nothing */
function shapeText(shape, clip) {
  const { d, matrix, fill, stroke, width, dash, cap, join, fillOpacity, strokeOpacity } = shape;
  const lined = stroke !== "none";
  const path = written({
    d,
    transform: isIdentity(matrix) ? null : `matrix(${matrix.map(short).join(" ")})`,
    fill,
    "fill-opacity": fill !== "none" && fillOpacity < 1 ? fillOpacity : null,
    stroke: lined ? stroke : null,
    "stroke-width": lined ? width : null,
    "stroke-opacity": lined && strokeOpacity < 1 ? strokeOpacity : null,
    "stroke-dasharray": lined && dash.length ? dash.map(short).join(" ") : null,
    "stroke-linecap": lined && cap !== "butt" ? cap : null,
    "stroke-linejoin": lined && join !== "miter" ? join : null,
  });
  return clip ? `<g clip-path="url(#${clip})"><path${path}/></g>` : `<path${path}/>`;
}

/** @param {TextMark} mark */
function textText({ text, x, y, font, fill, opacity }) {
  const attributes = written({
    x,
    y,
    fill,
    opacity: opacity < 1 ? opacity : null,
    "font-family": font.family,
    "font-size": font.size,
    "font-weight": font.weight === "400" ? null : font.weight,
    "font-style": font.style === "normal" ? null : font.style,
  });
  return `<text xml:space="preserve"${attributes}>${escaped(text)}</text>`;
}

/**
 * A file of its own: nothing in it points elsewhere.
 * @param {Picture} picture @param {{title: string, fonts: string}} around  fonts: rules @font-face with the data of the letters
 */
export function svgOf({ width, height, background, marks }, { title, fonts }) {
  const clips = [
    ...new Set(marks.map((mark) => (mark.kind === "shape" && mark.clip ? boxPath(mark.clip) : ""))),
  ].filter(Boolean);
  const clipOf = (/** @type {ShapeMark} */ { clip }) => (clip ? `clip-${clips.indexOf(boxPath(clip))}` : "");
  return [
    `<svg xmlns="http://www.w3.org/2000/svg" width="${short(width)}" height="${short(height)}" viewBox="0 0 ${short(width)} ${short(height)}" role="img">`,
    `<title>${escaped(title)}</title>`,
    fonts && `<style>${fonts}</style>`,
    clips.length &&
      `<defs>${clips.map((d, i) => `<clipPath id="clip-${i}"><path d="${d}"/></clipPath>`).join("")}</defs>`,
    `<path d="${boxPath({ x: 0, y: 0, width, height })}" fill="${escaped(background)}"/>`,
    ...marks.map((mark) => (mark.kind === "text" ? textText(mark) : shapeText(mark, clipOf(mark)))),
    "</svg>",
  ]
    .filter(Boolean)
    .join("\n");
}

/** Families of letters that a picture needs, of those that a page brings along. @param {Picture} picture @param {readonly string[]} known */
export function familiesOf({ marks }, known) {
  const used = marks.flatMap((mark) => (mark.kind === "text" ? [mark.font.family] : []));
  return known.filter((family) => used.some((list) => list.includes(family)));
}

/** @param {CanvasRenderingContext2D} ink @param {ShapeMark} shape */
function paintShape(ink, { d, matrix, fill, stroke, width, dash, cap, join, fillOpacity, strokeOpacity, clip }) {
  if (clip) {
    ink.beginPath();
    ink.rect(clip.x, clip.y, clip.width, clip.height);
    ink.clip();
  }
  ink.transform(...matrix);
  const path = new Path2D(d);
  if (fill !== "none") {
    ink.globalAlpha = fillOpacity;
    ink.fillStyle = fill;
    ink.fill(path);
  }
  if (stroke === "none" || !width) return;
  ink.globalAlpha = strokeOpacity;
  ink.strokeStyle = stroke;
  ink.lineWidth = width;
  ink.lineCap = /** @type {CanvasLineCap} */ (cap);
  ink.lineJoin = /** @type {CanvasLineJoin} */ (join);
  ink.setLineDash([...dash]);
  ink.stroke(path);
}

/** @param {CanvasRenderingContext2D} ink @param {TextMark} mark */
function paintText(ink, { text, x, y, font, fill, opacity }) {
  ink.globalAlpha = opacity;
  ink.fillStyle = fill;
  ink.font = `${font.style} ${font.weight} ${font.size}px ${font.family}`;
  ink.fillText(text, x, y);
}

/** @param {CanvasRenderingContext2D} ink  of a canvas that is `scale` times as large @param {Picture} picture @param {number} scale */
export function paint(ink, { width, height, background, marks }, scale) {
  ink.setTransform(scale, 0, 0, scale, 0, 0);
  ink.globalAlpha = 1;
  ink.fillStyle = background;
  ink.fillRect(0, 0, width, height);
  for (const mark of marks) {
    ink.save();
    if (mark.kind === "text") paintText(ink, mark);
    else paintShape(ink, mark);
    ink.restore();
  }
}

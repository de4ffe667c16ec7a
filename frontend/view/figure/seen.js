/** What is seen of elements of the page as marks of a picture: shapes of SVG, letters, and boxes behind them. */

/** @typedef {import("../../model/picture/picture.js").Mark} Mark */
/** @typedef {import("../../model/picture/picture.js").Matrix} Matrix */
/** @typedef {import("../../model/picture/picture.js").Box} Box */
/** @typedef {{x: number, y: number}} Origin  of the picture, in the window */

/** Buttons, what is heard alone, and what stands for a pointer. */
const NOT_PICTURED =
  "button.tool, .figure-tools, .plot-tools, .plot-menu, .handle, .unseen, .katex-mathml, .ghost, .patience, .span, .key[aria-pressed='false'], defs, clipPath, mask, title, [hidden]";
/** @type {Matrix} */
const IDENTITY = [1, 0, 0, 1, 0, 0];

/** Colours as every program reads them, and how opaque they are. */
function createColours() {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = 1;
  const ink = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d", { willReadFrequently: true }));
  /** @type {Map<string, {hex: string, alpha: number}>} */
  const known = new Map();
  return (/** @type {string} */ colour) => {
    const found = known.get(colour);
    if (found) return found;
    ink.clearRect(0, 0, 1, 1);
    ink.fillStyle = colour;
    ink.fillRect(0, 0, 1, 1);
    const [r, g, b, a] = ink.getImageData(0, 0, 1, 1).data;
    const hex = a ? `#${[r, g, b].map((part) => part.toString(16).padStart(2, "0")).join("")}` : "none";
    const made = { hex, alpha: a / 255 };
    known.set(colour, made);
    return made;
  };
}

/** @param {Element} shape */
function pathOf(shape) {
  const number = (/** @type {string} */ name) => Number(shape.getAttribute(name) ?? 0);
  switch (shape.localName) {
    case "path":
      return shape.getAttribute("d") ?? "";
    case "rect":
      return `M${number("x")} ${number("y")}h${number("width")}v${number("height")}h${-number("width")}z`;
    case "line":
      return `M${number("x1")} ${number("y1")}L${number("x2")} ${number("y2")}`;
    case "circle": {
      const r = number("r");
      return `M${number("cx") - r} ${number("cy")}a${r} ${r} 0 1 0 ${2 * r} 0a${r} ${r} 0 1 0 ${-2 * r} 0z`;
    }
    default:
      return "";
  }
}

/** The box that a shape is cut by, where the nearest group that cuts does it by a box. @param {SVGGraphicsElement} shape @param {Origin} origin @returns {Box | null} */
function clipOf(shape, origin) {
  const group = shape.closest("[clip-path]");
  const name = group?.getAttribute("clip-path")?.match(/#([^'")]+)/)?.[1];
  const box = name ? document.getElementById(name)?.querySelector("rect") : null;
  const matrix = group instanceof SVGGraphicsElement ? group.getScreenCTM() : null;
  if (!box || !matrix) return null;
  const [x, y, width, height] = ["x", "y", "width", "height"].map((part) => Number(box.getAttribute(part) ?? 0));
  return {
    x: matrix.a * x + matrix.e - origin.x,
    y: matrix.d * y + matrix.f - origin.y,
    width: matrix.a * width,
    height: matrix.d * height,
  };
}

/** @param {CSSStyleDeclaration} style @returns {import("../../model/picture/picture.js").Font} */
const fontOf = (style) => ({
  weight: style.fontWeight,
  style: style.fontStyle,
  size: parseFloat(style.fontSize),
  family: style.fontFamily,
});

/** Reads what is painted: elements in the order of the document, each with what is behind its letters. */
export function createSeen() {
  const colour = createColours();
  const measure = /** @type {CanvasRenderingContext2D} */ (document.createElement("canvas").getContext("2d"));
  /** From the top of a line of letters to its baseline, by font. @type {Map<string, number>} */
  const ascents = new Map();

  /** @param {import("../../model/picture/picture.js").Font} font */
  function ascentOf({ style, weight, size, family }) {
    const name = `${style} ${weight} ${size}px ${family}`;
    let ascent = ascents.get(name);
    if (ascent === undefined) {
      measure.font = name;
      ascents.set(name, (ascent = measure.measureText("x").fontBoundingBoxAscent));
    }
    return ascent;
  }

  /** @param {SVGGraphicsElement} shape @param {CSSStyleDeclaration} style @param {number} opacity @param {Origin} origin @returns {Mark[]} */
  function shapeMarks(shape, style, opacity, origin) {
    const matrix = shape.getScreenCTM();
    const d = pathOf(shape);
    const [fill, stroke] = [style.fill, style.stroke].map((paint) =>
      paint === "none" ? { hex: "none", alpha: 0 } : colour(paint),
    );
    if (!matrix || !d || (fill.hex === "none" && stroke.hex === "none")) return [];
    const { a, b, c, d: e, e: x, f: y } = matrix;
    return [
      {
        kind: "shape",
        d,
        matrix: [a, b, c, e, x - origin.x, y - origin.y],
        fill: fill.hex,
        stroke: stroke.hex,
        width: parseFloat(style.strokeWidth),
        dash: style.strokeDasharray === "none" ? [] : style.strokeDasharray.split(/[,\s]+/).map(parseFloat),
        cap: style.strokeLinecap,
        join: style.strokeLinejoin,
        fillOpacity: opacity * fill.alpha * Number(style.fillOpacity),
        strokeOpacity: opacity * stroke.alpha * Number(style.strokeOpacity),
        clip: clipOf(shape, origin),
      },
    ];
  }

  /** Letters of SVG. @param {SVGTextContentElement} element @param {string} text @param {CSSStyleDeclaration} style @param {number} opacity @param {Origin} origin @returns {Mark[]} */
  function svgLetters(element, text, style, opacity, origin) {
    const matrix = element.getScreenCTM();
    if (!matrix || !element.getNumberOfChars()) return [];
    const start = element.getStartPositionOfChar(0).matrixTransform(matrix);
    const { hex, alpha } = colour(style.fill);
    return [
      {
        kind: "text",
        text,
        x: start.x - origin.x,
        y: start.y - origin.y,
        font: fontOf(style),
        fill: hex,
        opacity: opacity * alpha,
      },
    ];
  }

  /** @param {Text} node @param {CSSStyleDeclaration} style @param {number} opacity @param {Origin} origin @returns {Mark[]} */
  function letters(node, style, opacity, origin) {
    const range = document.createRange();
    range.selectNodeContents(node);
    const [line] = range.getClientRects();
    const font = fontOf(style);
    const { hex, alpha } = colour(style.color);
    if (!line?.width || hex === "none") return [];
    const text = node.data.replace(/[ \t\r\n]+/g, " ");
    return [
      {
        kind: "text",
        text,
        x: line.x - origin.x,
        y: line.y - origin.y + ascentOf(font),
        font,
        fill: hex,
        opacity: opacity * alpha,
      },
    ];
  }

  /** What is painted behind and around an element's content. @param {Element} element @param {CSSStyleDeclaration} style @param {number} opacity @param {Origin} origin @returns {Mark[]} */
  function boxMarks(element, style, opacity, origin) {
    const box = element.getBoundingClientRect();
    const [x, y] = [box.x - origin.x, box.y - origin.y];
    const filled = (/** @type {string} */ d, /** @type {string} */ paint) => {
      const { hex, alpha } = colour(paint);
      const mark = { ...shapeOf(d), fill: hex, fillOpacity: opacity * alpha };
      return hex === "none" ? [] : [mark];
    };
    const radius =
      parseFloat(style.borderTopLeftRadius) * (style.borderTopLeftRadius.endsWith("%") ? box.width / 100 : 1);
    const behind =
      box.width && box.height ? filled(rounded(x, y, box.width, box.height, radius), style.backgroundColor) : [];
    const widths = [style.borderTopWidth, style.borderRightWidth, style.borderBottomWidth, style.borderLeftWidth].map(
      parseFloat,
    );
    const [top, right, bottom, left] = widths;
    if (top && widths.every((width) => width === top)) {
      const { hex, alpha } = colour(style.borderTopColor);
      const line = rounded(x + top / 2, y + top / 2, box.width - top, box.height - top, radius - top / 2);
      const ring = { ...shapeOf(line), stroke: hex, width: top, strokeOpacity: opacity * alpha };
      return hex === "none" ? behind : [...behind, ring];
    }
    return [
      ...behind,
      ...(top ? filled(rounded(x, y, box.width, top, 0), style.borderTopColor) : []),
      ...(right ? filled(rounded(x + box.width - right, y, right, box.height, 0), style.borderRightColor) : []),
      ...(bottom ? filled(rounded(x, y + box.height - bottom, box.width, bottom, 0), style.borderBottomColor) : []),
      ...(left ? filled(rounded(x, y, left, box.height, 0), style.borderLeftColor) : []),
    ];
  }

  /** @param {Element} element @param {number} opacity of what it is in @param {Origin} origin @param {Mark[]} marks */
  function read(element, opacity, origin, marks) {
    if (element.matches(NOT_PICTURED)) return;
    const style = getComputedStyle(element);
    if (style.display === "none" || style.visibility === "hidden" || style.opacity === "0") return;
    const seen = opacity * Number(style.opacity);
    if (element instanceof SVGGeometryElement) marks.push(...shapeMarks(element, style, seen, origin));
    else if (element instanceof HTMLElement) marks.push(...boxMarks(element, style, seen, origin));
    for (const child of element.childNodes) {
      if (child instanceof Element) read(child, seen, origin, marks);
      else if (!(child instanceof Text) || !child.data.trim()) continue;
      else if (element instanceof SVGTextContentElement)
        marks.push(...svgLetters(element, child.data, style, seen, origin));
      else if (element instanceof HTMLElement) marks.push(...letters(child, style, seen, origin));
    }
  }

  /** The picture of elements as they stand on the page. @param {readonly Element[]} elements @param {string} background @returns {import("../../model/picture/picture.js").Picture} */
  return (elements, background) => {
    const boxes = elements
      .map((element) => element.getBoundingClientRect())
      .filter(({ width, height }) => width && height);
    const origin = { x: Math.min(...boxes.map(({ left }) => left)), y: Math.min(...boxes.map(({ top }) => top)) };
    const width = Math.max(...boxes.map(({ right }) => right)) - origin.x;
    const height = Math.max(...boxes.map(({ bottom }) => bottom)) - origin.y;
    /** @type {Mark[]} */
    const marks = [];
    for (const element of elements) if (element.getBoundingClientRect().width) read(element, 1, origin, marks);
    return { width, height, background: colour(background).hex, marks };
  };
}

/** A shape that is neither filled nor lined. @param {string} d @returns {import("../../model/picture/picture.js").ShapeMark} */
const shapeOf = (d) => ({
  kind: "shape",
  d,
  matrix: IDENTITY,
  fill: "none",
  stroke: "none",
  width: 0,
  dash: [],
  cap: "butt",
  join: "miter",
  fillOpacity: 1,
  strokeOpacity: 1,
  clip: null,
});

/** @param {number} x @param {number} y @param {number} width @param {number} height @param {number} radius */
function rounded(x, y, width, height, radius) {
  const r = Math.min(radius || 0, width / 2, height / 2);
  if (r < 0.5) return `M${x} ${y}h${width}v${height}h${-width}z`;
  const arc = (/** @type {number} */ dx, /** @type {number} */ dy) => `a${r} ${r} 0 0 1 ${dx} ${dy}`;
  return `M${x + r} ${y}h${width - 2 * r}${arc(r, r)}v${height - 2 * r}${arc(-r, r)}h${2 * r - width}${arc(-r, -r)}v${2 * r - height}${arc(r, -r)}z`;
}

/** Questions to begin with: those of the lecture first, then the classics of the calculus of variations. */

import { EMPTY } from "./question.js";

/** @typedef {import("./question.js").Question} Question */

/** @type {Record<string, Partial<Question>>} */
const GIVEN = {
  identity: {
    kind: "value",
    expression: "x",
    direction: "v",
    parameters: "t0",
    at: "t0",
    samples: { x: "sin(t)" },
    along: { x: "t^2" },
    values: { t0: "1" },
  },
  square: { expression: "x^2", samples: { x: "sin(t)" }, along: { x: "cos(2*t)" } },
  sine: { expression: "sin(x)", samples: { x: "t" }, along: { x: "1 + t" } },
  chain: {
    expression: "x^2*sin(y)",
    functions: "x, y",
    samples: { x: "1 + t", y: "t^2" },
    along: { x: "cos(t)", y: "t" },
    t: "0.7",
  },
  pendulum: { expression: "[l*sin(phi), y + l*cos(phi)]", functions: "y, phi", parameters: "l" },
  height: {
    expression: "y + l*cos(phi)",
    functions: "y, phi",
    parameters: "l",
    samples: { y: "0.2*sin(3*t)", phi: "cos(t)" },
    along: { y: "0.3", phi: "t" },
    values: { l: "1" },
  },
  rates: { expression: "x^2*dot(x)", samples: { x: "sin(t)" }, along: { x: "t^2" }, t: "0.7" },
  length: {
    kind: "integral",
    expression: "sqrt(1 + dot(x)^2)",
    samples: { x: "t + sin(pi*t)/3" },
    along: { x: "t*(1 - t)" },
  },
  action: {
    kind: "integral",
    expression: "m*dot(x)^2/2 - k*x^2/2",
    parameters: "m, k, T",
    to: "T",
    samples: { x: "cos(t)" },
    along: { x: "t*(2 - t)" },
    values: { m: "1", k: "4", T: "2" },
  },
  "free-end": {
    kind: "integral",
    expression: "dot(x)^2 + x^2",
    ends: "fixed-free",
    samples: { x: "1 - t/2" },
    along: { x: "sin(t)" },
  },
  brachistochrone: {
    kind: "integral",
    expression: "sqrt((1 + dot(x)^2)/(2*g*x))",
    parameters: "g",
    samples: { x: "0.1 + t" },
    along: { x: "t*(1 - t)" },
    values: { g: "9.81" },
  },
  "two-masses": {
    kind: "integral",
    expression: "m*dot(x)^2/2 + m*dot(y)^2/2 - k*(x - y)^2/2",
    functions: "x, y",
    parameters: "m, k",
    samples: { x: "cos(t)", y: "sin(2*t)" },
    along: { x: "t*(1 - t)", y: "-t*(1 - t)" },
    values: { m: "1", k: "3" },
  },
  latex: {
    kind: "integral",
    syntax: "latex",
    expression: "\\frac{1}{2} m \\ell^2 \\dot\\varphi^2 + m g \\ell\\cos\\varphi",
    functions: "phi",
    parameters: "m, l, g",
    samples: { phi: "sin(3*t)" },
    along: { phi: "t*(1 - t)" },
    values: { m: "1", l: "1", g: "9.81" },
  },
};

export const EXAMPLES = Object.keys(GIVEN);
/** @param {string} id @returns {Question} */
export const example = (id) => ({ ...EMPTY, ...GIVEN[id] });
/** The example that a question is, or "". @param {Question} question */
export const exampleOf = (question) =>
  EXAMPLES.find((id) => JSON.stringify(example(id)) === JSON.stringify(question)) ?? "";

/** Questions to begin with: those of the lecture, then twelve classical problems of the calculus of variations. */

import { EMPTY } from "./question.js";

/** @typedef {import("./question.js").Question} Question */

/** @type {Record<string, Partial<Question>>} */
const LECTURE = {
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

/** @type {Record<string, Partial<Question>>} */
const CLASSICS = {
  length: {
    kind: "integral",
    expression: "sqrt(1 + dot(x)^2)",
    samples: { x: "t + sin(pi*t)/3" },
    along: { x: "t*(1 - t)" },
  },
  brachistochrone: {
    kind: "integral",
    expression: "sqrt((1 + dot(x)^2)/(2*g*x))",
    parameters: "g",
    samples: { x: "0.1 + t" },
    along: { x: "t*(1 - t)" },
    values: { g: "9.81" },
  },
  catenary: {
    kind: "integral",
    expression: "(x + lambda)*sqrt(1 + dot(x)^2)",
    parameters: "lambda",
    samples: { x: "cosh(t)" },
    along: { x: "t*(1 - t)" },
    values: { lambda: "1" },
  },
  "soap-film": {
    kind: "integral",
    expression: "2*pi*x*sqrt(1 + dot(x)^2)",
    samples: { x: "1 + t^2" },
    along: { x: "t*(1 - t)" },
  },
  sphere: {
    kind: "integral",
    expression: "R*sqrt(dot(theta)^2 + sin(theta)^2)",
    functions: "theta",
    parameters: "R",
    samples: { theta: "1 + t/2" },
    along: { theta: "t*(1 - t)" },
    values: { R: "1" },
  },
  cylinder: {
    kind: "integral",
    expression: "sqrt(R^2 + dot(z)^2)",
    functions: "z",
    parameters: "R",
    samples: { z: "t^2" },
    along: { z: "t*(1 - t)" },
    values: { R: "1" },
  },
  cone: {
    kind: "integral",
    expression: "sqrt(dot(r)^2 + r^2*sin(alpha)^2)",
    functions: "r",
    parameters: "alpha",
    samples: { r: "1 + t/2" },
    along: { r: "t*(1 - t)" },
    values: { alpha: "0.5" },
  },
  fermat: {
    kind: "integral",
    expression: "sqrt(1 + dot(x)^2)/(k*x)",
    parameters: "k",
    samples: { x: "1 + t/2" },
    along: { x: "t*(1 - t)" },
    values: { k: "1" },
  },
  relativity: {
    kind: "integral",
    expression: "-m*c^2*sqrt(1 - dot(x)^2/c^2) + F*x",
    parameters: "m, c, F, T",
    to: "T",
    samples: { x: "t^2/4" },
    along: { x: "t*(1 - t)" },
    values: { m: "1", c: "1", F: "1", T: "1" },
  },
  newton: {
    kind: "integral",
    expression: "t/(1 + dot(x)^2)",
    from: "1",
    to: "2",
    samples: { x: "t" },
    along: { x: "(t - 1)*(2 - t)" },
  },
  dido: {
    kind: "integral",
    expression: "x + lambda*sqrt(1 + dot(x)^2)",
    parameters: "lambda",
    samples: { x: "t*(1 - t)" },
    along: { x: "sin(pi*t)" },
    values: { lambda: "-1" },
  },
  beam: {
    kind: "integral",
    expression: "EI*ddot(w)^2/2 - q*w",
    functions: "w",
    parameters: "EI, q, L",
    to: "L",
    ends: "fixed-free",
    samples: { w: "t^2" },
    along: { w: "t^2" },
    values: { EI: "1", q: "1", L: "1" },
  },
};

/** The examples of the menu, by group. */
export const GROUPS = { lecture: Object.keys(LECTURE), classics: Object.keys(CLASSICS) };
const GIVEN = { ...LECTURE, ...CLASSICS };
export const EXAMPLES = Object.keys(GIVEN);
/** @param {string} id @returns {Question} */
export const example = (id) => ({ ...EMPTY, ...GIVEN[id] });
/** The example that a question is, or "". @param {Question} question */
export const exampleOf = (question) =>
  EXAMPLES.find((id) => JSON.stringify(example(id)) === JSON.stringify(question)) ?? "";

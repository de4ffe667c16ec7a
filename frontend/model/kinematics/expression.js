/**
 * Plain text of the server's expressions, turned into functions of numbers. The server writes only `+ - * / ^`,
 * parentheses, functions, dot(x), ddot(x), delta(x) and decimal numbers; the last three are names like any other.
 */

/** @typedef {Record<string, number>} Values  by name: "phi", "dot(phi)", "delta(phi)", "t" */
/** @typedef {(values: Values) => number} Evaluate */

const TOKEN = /\s*(?:((?:dot|ddot|delta)\(\w+\))|(\d+(?:\.\d*)?(?:[eE][+-]?\d+)?|\.\d+)|([A-Za-z_]\w*)|([-+*/^(),]))/y;

/** @type {Record<string, (...x: number[]) => number>} */
const FUNCTIONS = {
  sin: Math.sin,
  cos: Math.cos,
  tan: Math.tan,
  asin: Math.asin,
  acos: Math.acos,
  atan: Math.atan,
  atan2: Math.atan2,
  sinh: Math.sinh,
  cosh: Math.cosh,
  tanh: Math.tanh,
  asinh: Math.asinh,
  acosh: Math.acosh,
  atanh: Math.atanh,
  exp: Math.exp,
  log: Math.log,
  sqrt: Math.sqrt,
  abs: Math.abs,
  sign: Math.sign,
  max: Math.max,
  min: Math.min,
  step: (x) => (1 + Math.sign(x)) / 2,
  cot: (x) => 1 / Math.tan(x),
  sec: (x) => 1 / Math.cos(x),
  csc: (x) => 1 / Math.sin(x),
};

/** How tightly an operator binds, and what it does. @type {Record<string, [number, (a: number, b: number) => number]>} */
const OPERATORS = {
  "+": [1, (a, b) => a + b],
  "-": [1, (a, b) => a - b],
  "*": [2, (a, b) => a * b],
  "/": [2, (a, b) => a / b],
  "^": [4, (a, b) => a ** b],
};
const SIGN = 3;

/** @param {string} text */
function tokensOf(text) {
  const tokens = [];
  TOKEN.lastIndex = 0;
  for (let at = 0; at < text.trimEnd().length; at = TOKEN.lastIndex) {
    TOKEN.lastIndex = at;
    const found = TOKEN.exec(text);
    if (!found) throw new SyntaxError(`${text} at ${at}`);
    tokens.push(found[0].trim());
  }
  return tokens;
}

/** Reads by precedence: an operand, and what binds more tightly than what stands before it. */
class Reading {
  #next = 0;

  /** @param {string} text */
  constructor(text) {
    this.text = text;
    this.tokens = tokensOf(text);
  }

  /** @returns {Evaluate} */
  whole() {
    const found = this.#sum(0);
    if (this.#next < this.tokens.length) throw new SyntaxError(`${this.text}: “${this.#token}” is too much`);
    return found;
  }

  get #token() {
    return this.tokens[this.#next];
  }

  #take() {
    return this.tokens[this.#next++];
  }

  /** @param {number} binding @returns {Evaluate} */
  #sum(binding) {
    let left = this.#operand();
    for (;;) {
      const [own, apply] = OPERATORS[this.#token] ?? [0, null];
      if (!apply || own <= binding) return left;
      this.#take();
      const [before, after] = [left, this.#sum(own === 4 ? own - 1 : own)];
      left = (values) => apply(before(values), after(values));
    }
  }

  /** @returns {Evaluate} */
  #operand() {
    const token = this.#take();
    if (token === undefined) throw new SyntaxError(`${this.text}: unfinished`);
    if (token === "+") return this.#sum(SIGN);
    if (token === "-") return negative(this.#sum(SIGN));
    if (token === "(") return this.#list()[0];
    if (/^[\d.]/.test(token)) return constant(Number(token));
    return this.#token === "(" ? this.#call(token) : named(token);
  }

  /** @param {string} name @returns {Evaluate} */
  #call(name) {
    this.#take();
    const of = FUNCTIONS[name];
    const given = this.#list();
    if (!of) throw new SyntaxError(`${this.text}: ${name} is not known`);
    return (values) => of(...given.map((each) => each(values)));
  }

  /** To the closing bracket. @returns {Evaluate[]} */
  #list() {
    const found = [this.#sum(0)];
    while (this.#token === ",") {
      this.#take();
      found.push(this.#sum(0));
    }
    if (this.#take() !== ")") throw new SyntaxError(`${this.text}: “)” expected`);
    return found;
  }
}

/** @param {number} value @returns {Evaluate} */
const constant = (value) => () => value;
/** @param {Evaluate} of @returns {Evaluate} */
const negative = (of) => (values) => -of(values);
/** @param {string} name @returns {Evaluate} */
const named = (name) => (name === "pi" ? constant(Math.PI) : (values) => values[name] ?? NaN);

/**
 * The function that a text stands for. Throws SyntaxError where it is not of the plain language.
 * @param {string} text @returns {Evaluate}
 */
export const evaluator = (text) => new Reading(text).whole();

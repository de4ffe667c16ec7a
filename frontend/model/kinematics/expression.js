/**
 * Plain text of the server's expressions, turned into functions of numbers. The server writes only `+ - * / ^`,
 * parentheses, functions, dot(x), ddot(x), delta(x) and decimal numbers; the last three are names like any other.
 */

/** @typedef {Record<string, number>} Values  by name: "phi", "dot(phi)", "delta(phi)", "t" */
/** @typedef {(values: Values) => number} Evaluate */

const TOKEN = /\s*(?:((?:dot|ddot|delta)\(\w+\))|(\d+(?:\.\d*)?(?:[eE][+-]?\d+)?|\.\d+)|([A-Za-z_]\w*)|([-+*/^(),]))/y;

/** @type {Record<string, (...x: number[]) => number>} */
const FUNCTIONS = {
  sin: Math.sin, cos: Math.cos, tan: Math.tan, asin: Math.asin, acos: Math.acos, atan: Math.atan, atan2: Math.atan2,
  sinh: Math.sinh, cosh: Math.cosh, tanh: Math.tanh, asinh: Math.asinh, acosh: Math.acosh, atanh: Math.atanh,
  exp: Math.exp, log: Math.log, sqrt: Math.sqrt, abs: Math.abs, sign: Math.sign,
  cot: (x) => 1 / Math.tan(x), sec: (x) => 1 / Math.cos(x), csc: (x) => 1 / Math.sin(x),
};

/** How tightly an operator binds, and what it does. @type {Record<string, [number, (a: number, b: number) => number]>} */
const OPERATORS = {
  "+": [1, (a, b) => a + b], "-": [1, (a, b) => a - b], "*": [2, (a, b) => a * b], "/": [2, (a, b) => a / b], "^": [4, (a, b) => a ** b],
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

/**
 * The function that a text stands for. Throws SyntaxError where it is not of the plain language.
 * @param {string} text @returns {Evaluate}
 */
export function evaluator(text) {
  const tokens = tokensOf(text);
  let next = 0;
  const take = () => tokens[next++];
  const expect = (/** @type {string} */ token) => {
    if (take() !== token) throw new SyntaxError(`${text}: “${token}” expected`);
  };

  /** @returns {Evaluate[]} */
  function list() {
    const found = [sum(0)];
    while (tokens[next] === ",") {
      next += 1;
      found.push(sum(0));
    }
    expect(")");
    return found;
  }

  /** @returns {Evaluate} */
  function operand() {
    const token = take();
    if (token === undefined) throw new SyntaxError(`${text}: unfinished`);
    if (token === "-" || token === "+") {
      const of = sum(SIGN);
      return token === "-" ? (values) => -of(values) : of;
    }
    if (token === "(") return list()[0];
    if (/^[\d.]/.test(token)) {
      const value = Number(token);
      return () => value;
    }
    return tokens[next] === "(" ? call(token) : named(token);
  }

  /** @param {string} name @returns {Evaluate} */
  function call(name) {
    next += 1;
    const of = FUNCTIONS[name];
    const given = list();
    if (!of) throw new SyntaxError(`${text}: ${name} is not known`);
    return (values) => of(...given.map((each) => each(values)));
  }

  /** @param {number} binding @returns {Evaluate} */
  function sum(binding) {
    let left = operand();
    for (;;) {
      const [own, apply] = OPERATORS[tokens[next]] ?? [0, null];
      if (!apply || own <= binding) return left;
      next += 1;
      const [before, after] = [left, sum(own === 4 ? own - 1 : own)];
      left = (values) => apply(before(values), after(values));
    }
  }

  const whole = sum(0);
  if (next < tokens.length) throw new SyntaxError(`${text}: “${tokens[next]}” is too much`);
  return whole;
}

/** @param {string} name @returns {Evaluate} */
const named = (name) => (name === "pi" ? () => Math.PI : (values) => values[name] ?? NaN);

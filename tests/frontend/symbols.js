/** Which symbols of the formulas of a scene are marked in its drawing. */

import { figureOf, withDrawing } from "../../frontend/model/drawing/figure.js";
import { stageOf } from "../../frontend/model/drawing/stage.js";
import { areOfFormulas } from "../../frontend/model/prose.js";
import { markerOf, withSymbols } from "../../frontend/model/symbols.js";
import { endOf, snapshotAt } from "../../frontend/model/trajectory.js";

const PANE = { width: 560, height: 330 };
const LOOKS = 20;
const SKIPPED = /\\(?:begin|end|text|operatorname)\{[^}]*\}(?:\[l\])?|\\\\(?:\[[^\]]*\])?|\\left|\\right|\\,|\\math(?:rm|cal)\{[^}]*\}/g;
const LETTER = /^(?:\\(?:ell|alpha|beta|gamma|delta|varepsilon|epsilon|zeta|eta|theta|vartheta|iota|kappa|lambda|mu|nu|xi|pi|rho|sigma|tau|phi|varphi|chi|psi|omega|Gamma|Delta|Theta|Lambda|Xi|Pi|Sigma|Phi|Psi|Omega)(?![a-zA-Z])|\\mathbf\{[^}]*\}|[A-Za-z])/;
/** Numbers and operators. */
const NEUTRAL = /^(?:\\pi|\\delta|\\mathbf\{0\})$/;
const FUNCTION = /^\\[a-zA-Z]+/;

/** The classes that shapes and letters of a drawing have at some moment. */
function classesOf(scene, trajectory) {
  const stage = stageOf(withDrawing(scene, trajectory), trajectory, PANE);
  const found = new Set(["time"]); // the clock below it
  for (let i = 0; i <= LOOKS; i += 1) {
    const { shapes, labels } = figureOf(stage, snapshotAt(trajectory, (endOf(trajectory) * i) / LOOKS));
    for (const { className } of [...shapes.filter(({ d }) => d), ...labels]) className.split(" ").forEach((name) => found.add(name));
  }
  return found;
}

/** Letters of a formula, each with the classes about it, and with those next to it. @returns {[string, string[], string[]][]} */
function symbolsOf(latex) {
  const text = latex.replaceAll("\\htmlClass", "\u0001").replace(SKIPPED, " ");
  const [found, open] = [[], []];
  for (let i = 0; i < text.length; ) {
    const rest = text.slice(i);
    const begins = /^\u0001\{([^}]*)\}\{/.exec(rest);
    const letter = LETTER.exec(rest);
    if (begins) open.push(begins[1].split(" "));
    else if (text[i] === "{") open.push([]);
    else if (text[i] === "}") open.pop();
    else if (letter) found.push([letter[0], open.flat(), open.findLast((classes) => classes.length) ?? []]);
    i += (begins ?? letter ?? FUNCTION.exec(rest) ?? [" "])[0].length;
  }
  return found;
}

/** Classes in formulas that the page does not take from the server: LaTeX with them is shown as an error. */
const refusedIn = (latex) => [...latex.matchAll(/\\htmlClass\{([^}]*)\}/g)].map(([, classes]) => classes).filter((classes) => !areOfFormulas(classes));

/** What names the thing that a letter stands for; the term about it names where the term comes from. */
const OWN = /^(?:[pq]-\d+|vector-[rv]|of-.+)$/;
/** Symbols of the whole system name what belongs to them. */
const meant = (name) => (name.startsWith("of-") ? name.slice(3).replace("_", "-") : name);
const QUANTITY = /^(?:body|load|constraint)-/;
/** A whole term, and not a quantity of that name. */
const TERM = /^t-/;

/**
 * Symbols in the formulas of all steps that have a mark in the drawing, and those that have none: each once for a step.
 * @returns {{marked: [string, string][], bare: [string, string][], refused: string[]}} step and symbol; refused: classes
 */
export function coverage(scene, trajectory, { chapters, result }) {
  const mark = markerOf(scene, result);
  const drawn = classesOf(scene, trajectory);
  const found = { marked: new Set(), bare: new Set() };
  for (const step of chapters.flatMap(({ steps }) => steps))
    for (const [letter, classes, next] of symbolsOf(withSymbols(step, mark).marked ?? "")) {
      const own = classes.filter((name) => OWN.test(name));
      if (NEUTRAL.test(letter)) continue;
      const near = letter.startsWith("\\mathbf") ? classes : next.some((name) => TERM.test(name)) ? [] : next;
      const bold = near.filter((name) => QUANTITY.test(name));
      const is = [...own.filter((name) => !name.startsWith("vector")).map(meant), ...bold].some((name) => drawn.has(name));
      found[is ? "marked" : "bare"].add(`${step.id}\t${letter}${own.length ? ` ${own.at(-1)}` : ""}`);
    }
  const pairs = (symbols) => [...symbols].map((one) => one.split("\t"));
  const all = (step) => [step, ...(step.substeps ?? []).flatMap(all)];
  const shown = chapters.flatMap(({ steps }) => steps.flatMap((step) => all(withSymbols(step, mark))));
  return { marked: pairs(found.marked), bare: pairs(found.bare), refused: [...new Set(shown.flatMap(({ marked }) => refusedIn(marked ?? "")))] };
}

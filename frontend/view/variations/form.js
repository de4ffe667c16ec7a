/** The question: an expression or a functional, its functions, directions and parameters, and the ends. */

import { html, nothing } from "lit-html";
import { live } from "lit-html/directives/live.js";
import { icon } from "../icons.js";
import { example, exampleOf, GROUPS } from "../../model/variations/examples.js";
import { bothEnds, endsOf, HOLDS, KINDS } from "../../model/variations/question.js";
import { field, problemsAt, segments, typed } from "./field.js";

/** @typedef {import("./page.js").VariationsView} VariationsView */

const SYNTAXES = /** @type {const} */ (["plain", "latex"]);

/** @param {VariationsView} view */
export function form(view) {
  const { asking, lab, t } = view;
  const { question } = asking;
  const put =
    (/** @type {keyof import("../../model/variations/question.js").Question} */ key) => (/** @type {string} */ text) =>
      lab.edit({ [key]: text });
  const integral = question.kind === "integral";
  return html`
    <form class="question" aria-label=${t("variations.question")} @submit=${(/** @type {Event} */ e) => e.preventDefault()}>
      ${examples(view)}
      ${segments(
        t("variations.kind"),
        KINDS,
        question.kind,
        (kind) => lab.edit({ kind }),
        (kind) => t(`variations.kind-${kind}`),
      )}
      ${field(view, "/expression", html`${t(integral ? "variations.integrand" : "variations.expression")}`, question.expression, put("expression"), { className: "expression wide" })}
      ${segments(
        t("variations.syntax"),
        SYNTAXES,
        question.syntax,
        (syntax) => lab.edit({ syntax }),
        (syntax) => t(`variations.syntax-${syntax}`),
      )}
      <div class="fields">
        ${field(view, "/functions", t("variations.functions"), question.functions, put("functions"), { help: t("variations.functions-help") })}
        ${field(view, "/direction", t("variations.direction"), question.direction, put("direction"), { help: t("variations.direction-help"), placeholder: t("variations.direction-usual") })}
        ${field(view, "/parameters", t("variations.parameters"), question.parameters, put("parameters"), { help: t("variations.parameters-help") })}
      </div>
      ${integral ? interval(view) : question.kind === "value" ? field(view, "/functional/at", t("variations.at"), question.at, put("at"), { className: "narrow" }) : nothing}
      ${elsewhere(view)}
    </form>`;
}

/** @param {VariationsView} view */
function examples({ asking, lab, t }) {
  const chosen = exampleOf(asking.question);
  return html`
    <label class="choice examples"><span class="unseen">${t("variations.examples")}</span>
      <select .value=${live(chosen)} @change=${(/** @type {Event} */ e) => typed(e) && lab.begin(example(typed(e)))}>
        <option value="" ?selected=${!chosen} disabled>${t("variations.own")}</option>
        ${Object.entries(GROUPS).map(
          ([group, ids]) => html`<optgroup label=${t(`variations.group.${group}`)}>
          ${ids.map((id) => html`<option value=${id} ?selected=${id === chosen}>${t(`variations.example.${id}`)}</option>`)}
        </optgroup>`,
        )}
      </select>${icon("chevron")}</label>`;
}

/** Both ends: where they are, and whether the functions are prescribed there. @param {VariationsView} view */
function interval(view) {
  const { asking, lab, t } = view;
  const { question } = asking;
  const ends = bothEnds(question.ends);
  // With a second rate in the integrand, a function can be prescribed at an end without its rate.
  const second = asking.answer?.result.boundary_terms?.some(({ order }) => order > 0);
  const change = (/** @type {number} */ index, /** @type {import("../../model/variations/question.js").End} */ end) =>
    lab.edit({ ends: index ? endsOf(ends[0], end) : endsOf(end, ends[1]) });
  return html`<div class="ends">${
    /** @type {const} */ (["from", "to"]).map(
      (key, index) => html`
    <div class="end">
      ${field(view, `/functional/${key}`, t(`variations.${key}`), question[key], (text) => lab.edit({ [key]: text }), { className: "narrow" })}
      ${segments(
        t(`variations.end-${key}`),
        HOLDS.filter((hold) => hold !== "hinged" || second || ends.includes(hold)),
        ends[index],
        (end) => change(index, end),
        (end) => t(`variations.end-${end}`),
      )}
    </div>`,
    )
  }</div>`;
}

const SHOWN = [
  "/expression",
  "/functions",
  "/direction",
  "/parameters",
  "/functional/at",
  "/functional/from",
  "/functional/to",
  "/numeric",
];

/** What is wrong elsewhere than in a field. @param {VariationsView} view */
function elsewhere(view) {
  const { asking, lab, t } = view;
  if (asking.verdict === "unreachable")
    return html`<p class="wrong" role="alert">${t("failure.unreachable")}
    <button class="quiet small" type="button" @click=${lab.again}>${t("retry")}</button></p>`;
  const shown = new Set(SHOWN.flatMap((pointer) => problemsAt(view, pointer)));
  const rest = asking.problems.filter((problem) => !shown.has(problem));
  return rest.length
    ? html`<div class="complaints" role="alert">${rest.map(({ message }) => html`<p class="wrong">${message}</p>`)}</div>`
    : nothing;
}

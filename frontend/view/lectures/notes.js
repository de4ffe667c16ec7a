/** The notes of a lecture on paper: its stops with their notes and polls, the right answers marked. */

import { html, nothing } from "lit-html";
import { prose } from "../formula.js";

/** @param {import("../../model/lectures/lecture.js").Lecture} lecture @param {import("../../model/catalog.js").Translate} t */
export function paper({ title, stops }, t) {
  return html`
    <article class="notes-paper" aria-hidden="true">
      <h1>${title}</h1>
      <ol>${stops.map(
        ({ title: called, notes, hide, poll }) => html`
        <li><h2>${prose(called)}</h2>
          ${hide ? html`<p class="hint">${t("lectures.hidden")}</p>` : nothing}
          ${(notes ?? "").split(/\n+/).map((line) => (line.trim() ? html`<p>${prose(line)}</p>` : nothing))}
          ${poll ? html`<p><b>${prose(poll.question)}</b></p><ol type="A">${poll.choices.map((choice, i) => html`<li>${prose(choice)}${poll.right === i + 1 ? " ✓" : ""}</li>`)}</ol>` : nothing}
        </li>`,
      )}</ol>
    </article>`;
}

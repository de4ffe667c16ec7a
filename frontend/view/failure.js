/** What went wrong, as sentences, with a way on. */

import { html, nothing } from "lit-html";

/** @typedef {import("../model/types.js").Failure} Failure */

/**
 * @param {Failure} failure @param {string} heading @param {() => void} retry
 * @param {import("./page.js").View["t"]} t @param {unknown} [way]  besides another try
 * @param {(pointer: string) => unknown} [placeOf]  what a problem's pointer is called on this page; nothing, if that is plain
 */
export function failure(failure, heading, retry, t, way = nothing, placeOf = inScene) {
  const unreachable = failure.status === 0;
  // What the server refused it will refuse again; only what may pass is worth another try.
  const passing = unreachable || failure.status >= 500;
  const told = unreachable
    ? [t("failure.unreachable"), t("failure.unreachable-remedy")]
    : inGeneral(failure, t("failure.unexpected", { status: failure.status }));
  return html`
    <div class="failure" role="alert">
      <h2>${heading}</h2>
      ${told.map((sentence) => html`<p>${sentence}</p>`)}
      ${failure.problems.length ? html`<ul>${failure.problems.map(({ pointer, message }) => html`<li>${placeOf(pointer)} ${message}</li>`)}</ul>` : nothing}
      ${way}
      ${passing ? html`<button class="main" @click=${retry}>${t("retry")}</button>` : nothing}
    </div>
  `;
}

/** What is said besides the problems: nothing, where the service has but put their messages one behind the other. @param {Failure} failure @param {string} unexpected */
function inGeneral({ detail, title, problems }, unexpected) {
  const isJoined =
    problems.length > 0 &&
    problems
      .map(({ message }) => message)
      .join(" ")
      .startsWith(detail);
  return isJoined ? [] : [detail || title || unexpected];
}

/** Where in the scene a problem is: /scene/loads/0/force as /loads/0/force. @param {string} pointer */
export function inScene(pointer) {
  const [, place] = /^\/scene(\/.+)$/.exec(pointer) ?? [];
  return place ? html`<code>${place}</code>` : nothing;
}

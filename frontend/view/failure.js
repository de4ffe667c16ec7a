/** What went wrong, as sentences, with a way on. */

import { html, nothing } from "lit-html";

/**
 * @param {import("../model/types.js").Failure} failure @param {string} heading @param {() => void} retry
 * @param {import("./page.js").View["t"]} t @param {unknown} [way]  besides another try
 */
export function failure(failure, heading, retry, t, way = nothing) {
  const unreachable = failure.status === 0;
  // What the server refused it will refuse again; only what may pass is worth another try.
  const passing = unreachable || failure.status >= 500;
  const first = unreachable
    ? t("failure.unreachable")
    : failure.detail || failure.title || t("failure.unexpected", { status: failure.status });
  const rest = unreachable ? [t("failure.unreachable-remedy")] : failure.problems.map((problem) => problem.message);
  return html`
    <div class="failure" role="alert">
      <h2>${heading}</h2>
      <p>${first}</p>
      ${rest.filter((sentence) => sentence !== first).map((sentence) => html`<p>${sentence}</p>`)}
      ${way}
      ${passing ? html`<button class="main" @click=${retry}>${t("retry")}</button>` : nothing}
    </div>
  `;
}

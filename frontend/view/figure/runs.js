/** Runs beside the present one: drawn as outlines, dashed in the plots, named in a legend. */

import { html } from "lit-html";
import { inline } from "../formula.js";
import { icon } from "../icons.js";
import { fixed } from "../../model/numbers.js";
import { DASHES, differences, keyOf, readRuns, withoutRun, withRun } from "../../model/figure/runs.js";
import { caveatsOf, endOf, snapshotAt, trustedUntil } from "../../model/trajectory.js";
import { outline } from "../../model/virtual/figure.js";
import { keeper } from "../../model/drawing/stage.js";

/** @typedef {import("../../model/figure/runs.js").Run} Run */

/**
 * What is to be said of a motion beside the present one, in short; in full to who points at it.
 * @param {import("../../model/types.js").Trajectory} trajectory @param {import("../../model/types.js").Place} place @param {import("../page.js").View["t"]} t
 */
function doubt(trajectory, { lang }, t) {
  const caveats = caveatsOf(trajectory, t);
  return caveats.length
    ? html` <span title=${caveats.join(" ")}>(${t("status.until", { time: fixed(trajectory.coarse ? 0 : trustedUntil(trajectory), 1, lang) })})</span>`
    : "";
}

/** @param {import("./open.js").Bench} bench @param {ReturnType<typeof import("./layer.js").layerIn>} layer */
export function createRuns({ parts: { drawing }, state, session, clock }, { draw }) {
  let asked = "";
  /** @type {WeakMap<object, import("../../model/drawing/stage.js").Stage>} */
  const stages = new WeakMap();
  let drawn = false;

  /** Computes the runs that the address names and that are not there. */
  async function gather() {
    const { place, scene, runs } = state();
    const wanted = [place.runs, place.duration, scene?.id].join(" ");
    if (wanted === asked || !scene) return;
    const again = asked.split(" ").slice(1).join() !== wanted.split(" ").slice(1).join();
    asked = wanted;
    const found = await Promise.all(
      readRuns(place.runs).map(async (run) => {
        const kept = again ? null : runs.find(({ key }) => key === keyOf(run));
        return kept ?? { ...run, key: keyOf(run), trajectory: await session.run(run.changes, run.method) };
      }),
    ).catch(() => null);
    if (asked === wanted && found) session.compare(found);
  }

  /** The stage of the page with the motion of a run on it. @param {Run} run @param {import("../../model/drawing/stage.js").Stage} stage */
  function stageOf(run, stage) {
    const made = stages.get(run);
    if (made?.project === stage.project) return made;
    const own = { ...stage, trajectory: run.trajectory, once: keeper() };
    stages.set(run, own);
    return own;
  }

  return {
    gather,
    keep() {
      const { changes, place } = state();
      session.move({ runs: withRun(place.runs, { changes, method: place.method }) });
    },
    move() {
      const { stage } = drawing;
      const { runs } = state();
      if (!stage || (!runs.length && !drawn)) return;
      drawn = runs.length > 0;
      const going = runs.flatMap((run, i) => (clock.time <= endOf(run.trajectory) ? [{ run, i }] : []));
      draw(
        {
          shapes: going.flatMap(({ run, i }) =>
            outline(stageOf(run, stage), snapshotAt(run.trajectory, clock.time), `run-${i}`),
          ),
          labels: [],
        },
        stage.size,
      );
    },
    /** @param {import("../page.js").View} view */
    legend({ state, session, t, methodTitle }) {
      const { runs, scene, place } = state;
      if (!runs.length || !scene) return html``;
      const all = [...runs, { changes: state.changes, method: place.method }];
      const names = differences(all, scene);
      const methods = new Set(all.map(({ method }) => method)).size > 1;
      const name = (/** @type {number} */ i) =>
        html`${names[i].map((each) => inline(each))}${methods ? html`<span>${all[i].method ? methodTitle(all[i].method) : t("numerics.auto")}</span>` : ""}`;
      return html`
        <ul class="runs" aria-label=${t("runs")}>
          <li><span class="swatch"></span>${t("runs.now")} ${name(runs.length)}</li>
          ${runs.map(
            (run, i) => html`<li><span class="swatch ${DASHES[i]}"></span>${name(i)}${doubt(run.trajectory, place, t)}
            <button class="quiet small" aria-label=${t("runs.drop")} title=${t("runs.drop")} @click=${() => session.move({ runs: withoutRun(place.runs, run.key) })}>${icon("close")}</button></li>`,
          )}
        </ul>`;
    },
  };
}

/** The figure's instruments: what a reader can do with it beyond watching. Fetched when a hand comes near. */

import { html } from "lit-html";
import { kinematicsOf } from "../../model/kinematics/kinematics.js";
import { snapshotAt } from "../../model/trajectory.js";
import { createEnergies } from "./energies.js";
import { createHand } from "./hand.js";
import { createIntegrals } from "./integrals.js";
import { layerIn } from "./layer.js";
import { createLook } from "./look.js";
import { createOrbit } from "./orbit.js";
import { createPaths } from "./paths.js";
import { createPhase } from "./phase.js";
import { createReading } from "./reading.js";
import { createRuns } from "./runs.js";
import { createTake } from "./take.js";
import { createVectors } from "./vectors.js";
import { createVirtual } from "./virtual.js";
import { steppers, tools } from "./tools.js";
import { createWhy } from "./why.js";

/** @typedef {import("../page.js").View} View */
/** @typedef {import("../../model/state.js").State} State */

/**
 * @typedef {object} Around  what the instruments need of the page
 * @property {HTMLElement} root
 * @property {HTMLElement} frame  of the drawing
 * @property {import("../motion.js").Parts} parts
 * @property {() => State} state
 * @property {import("../../model/clock.js").Clock} clock
 * @property {import("../page.js").View["session"]} session
 * @property {typeof fetch} send
 * @property {(t: number) => void} seek
 */

/** @typedef {Around & {kinematics: () => import("../../model/kinematics/kinematics.js").Kinematics | null,
 *   now: () => import("../../model/types.js").Snapshot | null}} Bench  with what they share */

/** Kinematics of what is on the page, made anew only when it changes. @param {() => State} state */
function keeper(state) {
  /** @type {{on: unknown[], made: ReturnType<typeof kinematicsOf> | null}} */
  let kept = { on: [], made: null };
  return () => {
    const { scene, derivation, changes } = state();
    const on = [scene, derivation?.result, changes.parameters];
    if (on.some((part, i) => part !== kept.on[i])) {
      kept = {
        on,
        made: scene && derivation?.result ? kinematicsOf(scene, derivation.result, changes.parameters) : null,
      };
    }
    return kept.made;
  };
}

/** @param {Around} around */
export function open(around) {
  const { state, clock, session } = around;
  const now = () => {
    const { trajectory } = state();
    return trajectory?.t.length ? snapshotAt(trajectory, clock.time) : null;
  };
  const bench = { ...around, kinematics: keeper(state), now };
  const virtual = createVirtual(bench);
  const hand = createHand(bench, virtual);
  const runs = createRuns(bench, layerIn(around.frame, "beside"));
  const phase = createPhase(bench, around.seek);
  const energies = createEnergies(bench);
  const paths = createPaths(bench, layerIn(around.frame, "paths"));
  const vectors = createVectors(bench, layerIn(around.frame, "vectors"));
  const look = createLook(bench);
  const reading = createReading(bench);
  const move = () => [virtual, vectors, hand, runs, phase, energies, reading].forEach((part) => part.move());
  const orbit = createOrbit(bench, () => {
    paths.show();
    move();
  });
  void session.need("figure");
  return {
    panel: virtual.panel,
    steppers,
    plotTools: look.menu,
    take: createTake(bench),
    why: createWhy(state),
    integrals: createIntegrals(bench),
    /** @param {View} view */
    tools(view) {
      hand.handles(view);
      orbit.show(view.t);
      return html`${tools(view, runs)}${runs.legend(view)}`;
    },
    /** What the page holds has changed. */
    show() {
      void runs.gather();
      phase.show();
      energies.show();
      paths.show();
      vectors.move();
    },
    /** Follows the clock. */
    move,
  };
}

/** @typedef {ReturnType<typeof open>} Instruments */

/** The figure's instruments: what a reader can do with it beyond watching. Fetched when a hand comes near. */

import { kinematicsOf } from "../../model/kinematics/kinematics.js";
import { ratesAt } from "../../model/kinematics/rates.js";
import { snapshotAt } from "../../model/trajectory.js";
import { createHand } from "./hand.js";
import { createVirtual } from "./virtual.js";
import { tools } from "./tools.js";

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
 */

/** @typedef {Around & {kinematics: () => import("../../model/kinematics/kinematics.js").Kinematics | null,
 *   now: () => import("../../model/types.js").Snapshot | null}} Bench  with what they share */

function dress() {
  const sheet = document.createElement("link");
  sheet.rel = "stylesheet";
  sheet.href = "/styles/instruments.css";
  document.head.append(sheet);
}

/** Kinematics of what is on the page, made anew only when it changes. @param {() => State} state */
function keeper(state) {
  /** @type {{on: unknown[], made: ReturnType<typeof kinematicsOf> | null}} */
  let kept = { on: [], made: null };
  return () => {
    const { scene, derivation, changes } = state();
    const on = [scene, derivation?.result, changes.parameters];
    if (on.some((part, i) => part !== kept.on[i])) {
      kept = { on, made: scene && derivation?.result ? kinematicsOf(scene, derivation.result, changes.parameters) : null };
    }
    return kept.made;
  };
}

/** @param {Around} around */
export function open(around) {
  dress();
  const { state, clock, session } = around;
  const now = () => {
    const { trajectory } = state();
    return trajectory?.t.length ? { ...snapshotAt(trajectory, clock.time), rates: ratesAt(trajectory, clock.time) } : null;
  };
  const bench = { ...around, kinematics: keeper(state), now };
  const virtual = createVirtual(bench);
  const hand = createHand(bench, virtual);
  void session.need("figure");
  return {
    panel: virtual.panel,
    /** @param {View} view */
    tools(view) {
      hand.handles(view);
      return tools(view);
    },
    /** Follows the clock. */
    move() {
      virtual.move();
      hand.move();
    },
  };
}

/** @typedef {ReturnType<typeof open>} Instruments */

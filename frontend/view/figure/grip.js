/** What a hand holds of the drawing: a place, and the initial values that the motion does not have yet. */

import { placeOf } from "../../model/drawing/stage.js";
import { brought, movable, startedAt } from "../../model/kinematics/hand.js";
import { configured } from "../../model/kinematics/kinematics.js";

/** @typedef {import("../../model/types.js").Pixel} Pixel */
/** @typedef {import("../../model/kinematics/expression.js").Values} Values */
/** @typedef {ReturnType<typeof import("./virtual.js").createVirtual>} Virtual */

/** @param {import("./open.js").Bench} bench @param {Virtual} virtual */
export function createGrip({ parts: { drawing }, state, session, clock, kinematics, now }, virtual) {
  /** @type {{place: string, q: Values, resume: boolean} | null} */
  let held = null;
  /** Where the hand left off, until the motion begins there. @type {{q: Values, resume: boolean} | null} */
  let awaited = null;

  /** Everything there is to hold on to, or null. */
  function around() {
    const all = { kinematics: kinematics(), now: now(), stage: drawing.stage, scene: state().scene };
    return all.kinematics && all.now && all.stage && all.scene
      ? /** @type {{[K in keyof typeof all]: NonNullable<typeof all[K]>}} */ (all)
      : null;
  }

  /** Where a place stands, also while the motion has not followed to it. @param {string} place @returns {Pixel} */
  function where(place) {
    const all = around();
    if (!all) return [0, 0];
    return awaited
      ? all.stage.project(all.kinematics.places(awaited.q, all.now.t)[place])
      : placeOf(all.stage, all.now, place);
  }

  /** @param {string} place */
  function take(place) {
    const all = around();
    if (!all) return;
    const varied = state().place.vary;
    const q = varied ? virtual.varied() : awaited?.q;
    held = { place, q: q ?? all.now.coordinates, resume: clock.playing && !varied };
    clock.play(false);
    if (varied) return;
    clock.seek(0);
    session.move({ at: 0 });
  }

  /** @param {Pixel} hand */
  function lead(hand) {
    const all = around();
    if (!held || !all) return;
    const q = brought(all, held.place, held.q, hand);
    held.q = q;
    if (state().place.vary) return virtual.vary(q);
    drawing.hold(configured(all.kinematics, all.now, q));
    awaited = { q, resume: false };
    session.change(startedAt(state().changes, all.scene, all.kinematics, q));
  }

  function release() {
    if (held && awaited) awaited.resume = held.resume;
    else if (held?.resume) clock.play(true);
    held = null;
  }

  return {
    places() {
      const all = around();
      return all ? movable(all.kinematics, all.now, all.stage) : [];
    },
    where,
    take,
    lead,
    release,
    holds: () => held !== null,
    /** Takes a place a little further. @param {string} place @param {Pixel} by */
    nudge(place, [dx, dy]) {
      take(place);
      const [x, y] = held && state().place.vary ? virtual.where(place) : where(place);
      lead([x + dx, y + dy]);
      release();
    },
    /** Lets go where the motion begins at which the hand left off has come, or will not come. */
    arrived() {
      const { trajectory, failures, simulating, changes } = state();
      if (!awaited || held || simulating) return;
      const starts = Object.entries(changes.initial).every(
        ([name, { value }]) => !(Math.abs((trajectory?.coordinates[name]?.[0] ?? NaN) - value) > 1e-6),
      );
      if (!starts && !failures.simulation) return;
      const { resume } = awaited;
      awaited = null;
      drawing.hold(null);
      drawing.draw(clock.time);
      if (resume) clock.play(true);
    },
  };
}

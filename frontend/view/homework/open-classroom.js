/** The table of a class, fetched when it is first opened. */

/** @param {{api: import("../../model/homework/state.js").Api, state: () => import("../../model/homework/state.js").State, changed: () => void}} _around */
export const open = (_around) => () => null;

/** Places in the browser's history: what one would take back is an entry of its own, and a drag is one. */

/** @typedef {import("./types.js").Place} Place */
/** @typedef {Pick<History, "pushState" | "replaceState" | "state" | "back" | "forward">} Past */

/** Parts of a place that change together; whatever else changes is written into the entry that is there. @type {readonly (readonly (keyof Place)[])[]} */
const KINDS = [
  ["scene", "n"],
  ["formulation", "more"],
  ["set"],
  ["step", "part"],
  ["method", "duration"],
  ["view", "edit"],
];
/** Milliseconds: changes of one kind that follow each other sooner are one, as of a slider or a key that is held. */
const PORTION = 800;

/** Parts that the page fills in by itself where the address leaves them open. */
const FILLED = ["scene", "step"];

/** What has changed, "" if nothing that one would take back. @param {Place} before @param {Place} after */
function kindOf(before, after) {
  const [key = ""] = KINDS.find((keys) => keys.some((each) => before[each] !== after[each])) ?? [];
  return FILLED.includes(key) && !before[/** @type {keyof Place} */ (key)] ? "" : key;
}

/**
 * @param {Past} past @param {() => number} now  in milliseconds
 * @param {{embedded?: boolean}} [page]  a page in another one leaves no entries: "back" is about the page around it
 */
export function createVisits(past, now, { embedded = false } = {}) {
  /** @type {Place | null} */
  let at = null;
  let last = { kind: "", time: -Infinity };
  let written = "";
  const number = () => Number(past.state?.visit ?? 0);

  return {
    /** Writes a place down. @param {Place} place @param {string} address */
    keep(place, address) {
      const kind = at ? kindOf(at, place) : "";
      if (at && !kind && address === written) return;
      const time = now();
      const follows = kind === last.kind && time - last.time < PORTION;
      if (kind && !follows && !embedded) past.pushState({ visit: number() + 1 }, "", address);
      else past.replaceState({ visit: number() }, "", address);
      [at, written] = [place, address];
      if (kind) last = { kind, time };
    },
    /** The place of an entry that has been gone back to, or forward; the next change is a new one. @param {Place} place */
    returned(place) {
      [at, written] = [place, ""];
      last = { kind: "", time: -Infinity };
    },
    /** Takes back what was done last on this page; never leaves it. */
    undo() {
      if (number() > 0) past.back();
    },
    redo: () => past.forward(),
  };
}

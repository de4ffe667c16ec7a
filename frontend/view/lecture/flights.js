/** Terms move: from line to line each flies from where it stood to what became of it; what cancels fades away. */

/** @typedef {import("../../model/types.js").Step} Step */
/** @typedef {{rect: DOMRect, copy: HTMLElement}} Seen  where a term stood, and how it looked */

const DURATION = 550;
/** Pictures to wait for until the formulas have their sizes. */
const PATIENCE = 30;
/** So many at most: more are a swarm. */
const MOST = 24;

const still = matchMedia("(prefers-reduced-motion: reduce)");
/** @param {string} id "lagrangian/0.2.1" @returns {[string, string]} its step, and its class in the formula of that step */
const placeOf = (id) => {
  const at = id.lastIndexOf("/");
  return [id.slice(0, at), `t-${id.slice(at + 1).replaceAll(".", "-")}`];
};

/** @param {HTMLElement} root @param {string} id @returns {HTMLElement | null} */
function termIn(root, id) {
  const [step, name] = placeOf(id);
  return root.querySelector(`.slide [data-terms="${CSS.escape(step)}"] .${CSS.escape(name)}`);
}

/** A copy that looks the same anywhere. @param {HTMLElement} term @returns {HTMLElement} */
function copied(term) {
  const { fontSize, color } = getComputedStyle(term);
  const copy = document.createElement("span");
  copy.className = "flight katex";
  copy.style.cssText = `font-size:${fontSize};color:${color}`;
  copy.append(term.cloneNode(true));
  return copy;
}

/** @param {HTMLElement} root  the page, with a slide or without */
export function createFlights(root) {
  /** The terms of the slide before. @type {Map<string, Seen>} */
  let before = new Map();
  let last = "";
  /** @type {Animation[]} */
  let flying = [];

  function land() {
    for (const animation of flying.splice(0)) animation.cancel();
    document.querySelectorAll(".flight").forEach((flight) => flight.remove());
  }
  addEventListener("keydown", land, { capture: true });

  /** What is seen now, before another slide takes its place. @param {readonly Step[]} steps  all that it may come from */
  function look(steps) {
    land();
    before = new Map();
    if (still.matches) return;
    for (const { id } of steps.flatMap(({ terms }) => terms)) {
      const term = termIn(root, id);
      const rect = term?.getBoundingClientRect();
      if (term && rect?.width) before.set(id, { rect, copy: copied(term) });
    }
  }

  /** @param {Seen} seen @param {DOMRect | null} to */
  function fly({ rect, copy }, to) {
    const flight = /** @type {HTMLElement} */ (copy.cloneNode(true));
    flight.setAttribute("aria-hidden", "true");
    flight.style.left = `${rect.left}px`;
    flight.style.top = `${rect.top}px`;
    document.body.append(flight);
    const end = to
      ? `translate(${to.left - rect.left}px, ${to.top - rect.top}px) scale(${Math.min(3, to.height / rect.height)})`
      : "scale(0.4)";
    const frames = [
      { transform: "none", opacity: 1 },
      { opacity: to ? 0.9 : 0.4, offset: 0.8 },
      { transform: end, opacity: 0 },
    ];
    const animation = flight.animate(frames, { duration: DURATION, easing: "ease-in-out" });
    animation.onfinish = () => flight.remove();
    flying.push(animation);
  }

  /** @param {readonly Step[]} steps  those that are new */
  function take(steps) {
    const flights = steps
      .flatMap(({ terms }) => terms)
      .flatMap(({ id, from }) => {
        const to = before.has(id) ? null : termIn(root, id);
        return to ? from.map(({ term }) => ({ to, seen: before.get(term) })) : [];
      });
    for (const { to, seen } of flights.filter(({ seen }) => seen).slice(0, MOST)) {
      if (seen) fly(seen, to.getBoundingClientRect());
      flying.push(to.animate([{ opacity: 0 }, { opacity: 0, offset: 0.6 }, { opacity: 1 }], { duration: DURATION }));
    }
    for (const id of steps.flatMap(({ cancelled }) => cancelled)) {
      const seen = before.get(id);
      if (seen) fly(seen, null);
    }
  }

  return {
    look,
    /** Called when anything has changed. @param {string} stop  which slide it is @param {readonly Step[]} steps */
    update(stop, steps) {
      if (stop === last) return;
      const first = !last;
      last = stop;
      if (first || !before.size) return;
      let left = PATIENCE;
      const wait = () => {
        if (last !== stop) return;
        if (root.querySelector(".slide[data-filled]")) take(steps);
        else if (left-- > 0) requestAnimationFrame(wait);
      };
      requestAnimationFrame(wait);
    },
  };
}

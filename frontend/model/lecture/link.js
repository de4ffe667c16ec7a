/** What a lecture and the presenter's window tell each other. The lecture is where things stand; the presenter asks. */

/** @typedef {import("../types.js").Place} Place */
/**
 * @typedef {object} Here  where the lecture stands
 * @property {"here"} kind
 * @property {Place} place
 * @property {import("../types.js").Overlay} overlay
 * @property {Record<string, string>} title  of the scene, by language
 * @property {import("./numbering.js").Numbered[]} bodies  that are called by numbers on the slide
 * @property {import("../types.js").Chapter[]} [chapters]  when they are new, or were asked for
 */
/** @typedef {{kind: "hello"} | {kind: "go", by: number} | {kind: "within", by: number} | {kind: "goTo", step: string, part?: number} | {kind: "overlay", name: "black"} | {kind: "play"}} Wish */
/** @typedef {{postMessage: (message: Here | Wish) => void, onmessage: ((event: MessageEvent<Here | Wish>) => void) | null, close: () => void}} Channel */

/** @param {string} id */
export const nameOf = (id) => `deltaq.lecture.${id}`;

/** @param {unknown} id  of an address: other windows may say anything */
export const isId = (id) => typeof id === "string" && /^[a-z0-9]{6,20}$/.test(id);

/**
 * The side of the lecture.
 * @param {Channel} channel
 * @param {{here: () => Omit<Here, "kind" | "chapters"> & {chapters: import("../types.js").Chapter[]}, wish: (wish: Wish) => void}} lecture
 */
export function createSender(channel, lecture) {
  /** @type {import("../types.js").Chapter[] | null} */
  let told = null;
  let last = "";

  function tell() {
    const { chapters, ...here } = lecture.here();
    const said = JSON.stringify(here);
    if (said === last && chapters === told) return;
    channel.postMessage({ kind: "here", ...here, ...(chapters === told ? {} : { chapters }) });
    last = said;
    told = chapters;
  }

  channel.onmessage = ({ data }) => {
    if (data.kind === "hello") {
      told = null;
      tell();
    } else if (data.kind !== "here") lecture.wish(data);
  };
  return { tell, close: () => channel.close() };
}

/**
 * The presenter's side.
 * @param {Channel} channel @param {(here: Here) => void} hear
 */
export function createReceiver(channel, hear) {
  channel.onmessage = ({ data }) => {
    if (data.kind === "here") hear(data);
  };
  channel.postMessage({ kind: "hello" });
  return {
    /** @param {Wish} wish */
    wish: (wish) => channel.postMessage(wish),
  };
}

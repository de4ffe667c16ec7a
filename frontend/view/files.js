/** Files offered to be kept. */

/** Milliseconds after which a browser has surely begun to keep it. */
const KEPT = 10_000;

/** @param {string} name @param {string | Blob} content @param {string} [type] */
export function offer(name, content, type) {
  const address = URL.createObjectURL(new Blob([content], { type }));
  Object.assign(document.createElement("a"), { href: address, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(address), KEPT);
}

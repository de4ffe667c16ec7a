/** What is offered to be taken away: files, and texts for the clipboard. */

/** Milliseconds after which a browser has surely begun to keep it. */
const KEPT = 10_000;

/** @param {string} name @param {string | Blob} content @param {string} [type] */
export function offer(name, content, type) {
  const address = URL.createObjectURL(new Blob([content], { type }));
  Object.assign(document.createElement("a"), { href: address, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(address), KEPT);
}

/** False where the browser has no clipboard for the page, as over plain HTTP, or refuses it. @param {string} text @returns {Promise<boolean>} */
export const toClipboard = async (text) =>
  (await navigator.clipboard?.writeText(text).then(
    () => true,
    () => false,
  )) ?? false;

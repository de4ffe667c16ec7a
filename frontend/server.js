/** The server that sent the page, as the drivers ask it. */

import { createApi, ofSource } from "./model/api.js";

const told = /** @type {HTMLMetaElement | null} */ (document.querySelector('meta[name="source"]'));

export const send = fetch.bind(globalThis);
export const api = createApi(ofSource(told?.content ?? "", send));

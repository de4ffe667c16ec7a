/** A page in the hall of an own lecture, which gives each of its frames a name. */

import { isId } from "../model/lecture/link.js";

/** Such a page fetches at once what others fetch when it is wanted: by then there may be no network. */
export const isGuest = () => window.parent !== window && isId(window.name);

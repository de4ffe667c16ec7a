/** What is shown becomes a stop of the lecture that this browser keeps: fetched when somebody adds a place. */

import { appended } from "../../model/lectures/draft.js";
import { placeOf } from "../../model/lectures/place.js";
import { keeper } from "../keeper.js";

/** How many stops there are then; 0 if it could not be added. @param {string} title */
export function append(title) {
  const place = placeOf(location.href, location.origin);
  return place ? appended(keeper(), { place, title }, "") : 0;
}

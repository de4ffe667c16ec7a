/** The presenter's window of a hall, as soon as it can be had. */

import { render } from "lit-html";
import { createLater } from "../../model/later.js";
import { sheet } from "../bring.js";
import { missed } from "../missed.js";

/** @param {{root: HTMLElement, id: string, reader: Parameters<typeof import("./open-desk.js").openDesk>[0]["reader"], t: import("../../model/catalog.js").Translate}} around */
export async function openWindow(around) {
  const { root, t } = around;
  const desk = createLater(async () => {
    const [part] = await Promise.all([import("./open-desk.js"), sheet("hall")]);
    return part;
  }, show);
  function show() {
    render(missed([{ says: "missed.hall", later: desk, wanted: true }], t), root);
    if (!desk.part) return;
    render(null, root);
    desk.part.openDesk(around);
  }
  await desk.want();
}

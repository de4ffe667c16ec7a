/** Which attractor each start comes to, and how fine the boundary is. */

import { duration, expression, number, value } from "../options.js";

/** @param {string} name @param {string} field */
const count = (name, field) => number({ name, usual: 0, field, asked: (given) => (given ? { [field]: given } : {}) });

/** A coordinate, or dot of it: its rate. @param {string} name @param {string} field @returns {import("../options.js").Option} */
const axis = (name, field) => ({ ...expression(name), asked: (quantity) => (quantity ? { [field]: quantity } : {}) });

/** @type {import("../options.js").Experiment} */
export default {
  example: { scene: "magnetic-pendulum" },
  options: [
    axis("basin_x", "horizontal"),
    value("x_from"),
    value("x_to"),
    axis("basin_y", "vertical"),
    value("y_from"),
    value("y_to"),
    { ...count("basin-grid", "count"), key: "starts" },
    count("pairs", "pairs"),
    duration(),
  ],
};

/** Charts as Plotly takes them, as far as the page looks into them. */

/** @typedef {import("../types.js").Contract} Contract */
/**
 * @typedef {Contract["Trace"]} Trace
 * @typedef {Omit<Trace, "x" | "y"> & {x: number[], y: number[], z: (number | null)[][], meta: Contract["TraceMeaning"]}} MapTrace  over a grid of x and y
 * @typedef {Contract["Layout"] & {shapes?: object[]}} Layout  with what the page puts over the curves
 * @typedef {Omit<Contract["Chart"], "layout"> & {layout: Layout}} Chart
 */
export {};

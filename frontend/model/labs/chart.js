/** Charts as Plotly takes them, as far as the page looks into them. */

/**
 * @typedef {{width?: number, color?: unknown}} Line
 * @typedef {{color?: unknown, size?: number | number[], line?: Line}} Marker
 * @typedef {{role?: string, x?: string, y?: string}} Meta  what δq says of a trace: what it shows, and who stands on the axes
 * @typedef {{name?: string, showlegend?: boolean, x: number[], y: number[], z?: (number | null)[][], line?: Line, marker?: Marker,
 *   colorbar?: {title?: {text?: string}}, meta?: Meta}} Trace
 * @typedef {Trace & Required<Pick<Trace, "z" | "meta">>} MapTrace  over a grid of x and y
 * @typedef {{margin?: Record<string, number>, font?: object, legend?: object, showlegend?: boolean, shapes?: object[]}
 *   & {[axis in `${"x" | "y"}axis${string}`]?: object}} Layout
 * @typedef {Omit<import("../types.js").Contract["Chart"], "data" | "layout"> & {data: Trace[], layout: Layout}} Chart
 */
export {};

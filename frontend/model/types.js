/**
 * The shapes of what the API sends, made of its description (contract.d.ts), and of what the parts of the
 * page hand to each other.
 *
 * @typedef {import("./contract.js").components["schemas"]} Contract
 * @typedef {{name: string, latex: string, unit: string, value: number, rate: number,
 *   min?: number | null, max?: number | null}} Coordinate
 * @typedef {{name: string, latex: string, unit: string, value: number,
 *   min?: number | null, max?: number | null}} Parameter
 * @typedef {{name: string, position: string[]}} Point
 * @typedef {{name: string, kind: string, mass?: string, position: string[]}} Body
 * @typedef {{kind: string, name: string, at?: string, latex?: string, acceleration?: string[],
 *   from?: string, to?: string, moment?: string}} Load
 * @typedef {{coordinate: string, value: string}} Guide
 * @typedef {{name: string, value: string, at?: string}} SceneEvent
 * @typedef {{kind: string, at?: string, from?: string, to?: string, load?: string, coordinate?: string,
 *   direction?: string, radius?: number | string, width?: number, height?: number, offset?: number, label?: string}} Element
 * @typedef {{vertical?: "up" | "down", view?: number[] | null, elements?: Element[]}} Drawing
 * @typedef {Record<string, string>} Texts  text by language
 * @typedef {Contract["SceneEntry"]} SceneEntry
 * @typedef {{id: string, title: Texts, summary: Texts, dimension: number, coordinates: Coordinate[],
 *   parameters: Parameter[], points: Point[], bodies: Body[], loads: Load[], guides?: Guide[], events?: SceneEvent[], labels?: Record<string, Texts>,
 *   drawing?: Drawing | null}} Scene
 * @typedef {Contract["FamilyEntry"]} Family
 * @typedef {Contract["Step"]} Step
 * @typedef {Contract["Chapter"]} Chapter
 * @typedef {{id: string, chapters: Chapter[],
 *   result?: {equations?: {coordinate: string, plain: string, latex: string}[], points?: Record<string, {plain: string[]}>,
 *     positions?: Record<string, {plain: string[]}>, virtual_work?: {terms: {plain: string, sources: string[]}[]}}}} Derivation
 * @typedef {{id: string, title?: string, adaptive?: boolean, order?: number}} Method
 * @typedef {{kinetic: number[], potential: number[], balance: number[]}} Energy
 * @typedef {{status: string, reason?: string | null, remedy?: string | null, event?: {name: string, t: number} | null, t: number[],
 *   coordinates: Record<string, number[]>, rates: Record<string, number[]>,
 *   positions: Record<string, number[][]>, loads?: Record<string, number[][]>, energy?: Energy,
 *   error?: {estimate?: (number | null)[] | null, horizon?: number | null},
 *   cost?: {steps?: number, rejected?: number, rhs_evaluations?: number, wall_time?: number},
 *   trusted_until?: number, method: string, coarse?: boolean}} Trajectory  coarse: its samples do not show all of the motion
 * @typedef {{value: number, rate: number}} Initial
 * @typedef {{initial: Record<string, Initial>, parameters: Record<string, number>}} Changes
 * @typedef {{t: number, coordinates: Record<string, number>, rates: Record<string, number>,
 *   positions: Record<string, number[]>, loads: Record<string, number[]>,
 *   energy: {kinetic: number, potential: number, balance: number} | null}} Snapshot
 * @typedef {[number, number]} Pixel
 * @typedef {{key: string, d: string, className: string, at?: Pixel, opacity?: number}} Shape
 * @typedef {{key: string, latex: string, at: Pixel, className: string, start?: boolean, opacity?: number}} Label  start: the label begins at its place instead of being centred
 * @typedef {{shapes: Shape[], labels: Label[]}} Figure
 * @typedef {Contract["ProblemEntry"]} Problem
 * @typedef {{title: string, detail: string, problems: {message: string, pointer?: string}[], status: number}} Failure
 * @typedef {Record<string, string | Record<string, unknown>>} Catalog
 * @typedef {"derivation" | "plots" | "values"} Panel
 * @typedef {"" | "form" | "json" | "toml"} Editing  which side of the editor is open
 * @typedef {"" | "overview" | "help" | "black" | "jump" | "share"} Overlay  what lies above the page
 * @typedef {"" | "lecture"} Showing  all steps so far beside the figure, or one step at a time in a lecture
 * @typedef {"" | "substeps"} Pace  whether a lecture goes on by steps or by substeps
 * @typedef {"" | "plots" | "nothing"} Beside  what stands beside a step in a lecture, besides the drawing or without it
 * @typedef {"" | "figure" | "derivation"} Shown  what a frame of another page shows; "" for both
 * @typedef {{scene: string, step: string, lang: string, theme: string, method: string, n: number, formulation: string,
 *   duration: number, speed: number, panel: Panel, edit: Editing, view: Showing, part: number, pace: Pace, beside: Beside,
 *   vary: string, set: string, at: number, with: string, runs: string, show: Shown, why: string}} Place  what the address says
 */
export {};

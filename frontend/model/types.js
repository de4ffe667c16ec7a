/**
 * The shapes of what the API sends, made of its description (contract.d.ts), and of what the parts of the
 * page hand to each other.
 */

/** @typedef {import("./contract.js").components["schemas"]} Contract */
/** @typedef {import("./contract.js").paths} Paths */

/**
 * What is sent to an address below /api/v1 by POST.
 * @template {string} P
 * @typedef {`/api/v1${P}` extends infer A extends keyof Paths
 *   ? Paths[A] extends {post: {requestBody: {content: {"application/json": infer Body}}}} ? Body : never : never} Sent
 */
/**
 * What an address below /api/v1 answers to POST.
 * @template {string} P
 * @typedef {`/api/v1${P}` extends infer A extends keyof Paths
 *   ? Paths[A] extends {post: {responses: {200: {content: {"application/json": infer Body}}}}} ? Body : never : never} Answered
 */
/**
 * The same to GET.
 * @template {string} P
 * @typedef {`/api/v1${P}` extends infer A extends keyof Paths
 *   ? Paths[A] extends {get: {responses: {200: {content: {"application/json": infer Body}}}}} ? Body : never : never} Got
 */
/**
 * What may be left out of a document, but is there in what the page shows.
 * @template T @template {keyof T} Members
 * @typedef {Omit<T, Members> & {[M in Members]-?: NonNullable<T[M]>}} Having
 */
/**
 * Columns of numbers: the page never asks for the other form, base64.
 * @template T
 * @typedef {{[M in keyof T]: Exclude<T[M], string>}} InNumbers
 */

/**
 * What is left out of a document rather than null.
 * @template T
 * @typedef {{[M in keyof T]: Exclude<T[M], null>}} WithoutNull
 */

/**
 * @typedef {Having<Contract["SceneCoordinate"], "latex" | "unit" | "value" | "rate">} Coordinate
 * @typedef {Having<Contract["SceneParameter"], "latex" | "unit" | "value">} Parameter
 * @typedef {Contract["ScenePoint"]} Point
 * @typedef {Having<Contract["SceneBody"], "name">} Body
 * @typedef {WithoutNull<Having<Contract["SceneLoad"], "name">> & {latex?: string}} Load
 * @typedef {WithoutNull<Contract["DrawnElement"]> & {marks?: string}} Element  marks: the classes of the symbols that it shows
 * @typedef {Omit<Contract["SceneDrawing"], "elements"> & {elements?: Element[] | null}} Drawing
 * @typedef {Record<string, string>} Texts  text by language
 * @typedef {Exclude<Contract["DerivationRequest"]["lang"], null | undefined>} Lang
 * @typedef {NonNullable<Contract["DerivationRequest"]["formulation"]>} Formulation
 * @typedef {Contract["SceneEntry"]} SceneEntry
 * @typedef {{title: Texts, summary: Texts, coordinates: Coordinate[], parameters: Parameter[], points: Point[], bodies: Body[],
 *   loads: Load[], drawing?: Drawing | null}} Whole
 * @typedef {Omit<Having<Contract["SceneDocument"], "id" | "dimension">, keyof Whole> & Whole} Scene  as the API writes it: with all that its document may leave to be understood
 * @typedef {Contract["FamilyEntry"]} Family
 * @typedef {Contract["Step"]} Step
 * @typedef {Contract["Chapter"]} Chapter
 * @typedef {Pick<Contract["DerivationAnswer"], "id" | "chapters"> & Partial<Pick<Contract["DerivationAnswer"], "result" | "left_out">>} Derivation  of a scene, with its results, or a general proof
 * @typedef {Contract["MethodEntry"]} Method
 * @typedef {NonNullable<Contract["SimulationRequest"]["include"]>} Parts  of a motion
 * @typedef {InNumbers<Omit<Contract["Energy"], "drift" | "works">> & Pick<Contract["Energy"], "works">} Energy
 * @typedef {Omit<Contract["SimulationAnswer"], "t" | "coordinates" | "rates" | "positions" | "loads" | "multipliers" | "friction" | "contacts" | "energy"> & {t: number[],
 *   coordinates: Record<string, number[]>, rates: Record<string, number[]>, positions: Record<string, number[][]>,
 *   loads?: Record<string, number[][]> | null, multipliers?: Record<string, number[]> | null, friction?: Record<string, {force: number[], largest: number[]}> | null, contacts?: Record<string, {force: number[], unit: string}> | null, energy?: Energy | null, coarse?: boolean}} Trajectory  with what the page always asks to be included; coarse: its samples do not show all of the motion
 * @typedef {{value: number, rate: number}} Initial
 * @typedef {{initial: Record<string, Initial>, parameters: Record<string, number>}} Changes
 * @typedef {{t: number, coordinates: Record<string, number>, rates: Record<string, number>,
 *   positions: Record<string, number[]>, loads: Record<string, number[]>,
 *   energy: {kinetic: number, potential: number, balance: number} | null}} Snapshot
 * @typedef {[number, number]} Pixel
 * @typedef {[number, number, number, number]} Box  left, top, right, bottom in pixels
 * @typedef {readonly [Pixel, Pixel]} Strip  a straight line
 * @typedef {{key: string, d: string, className: string, at?: Pixel, opacity?: number, boxes?: Box[], strips?: Strip[]}} Shape  boxes, strips: what letters keep off, and what they cross only where there is no other place
 * @typedef {{key: string, latex: string, at: Pixel, className: string, others?: Pixel[], opacity?: number, moves?: number}} Label  others: where it can stand as well, the better ones first; moves: how often it has changed its place
 * @typedef {{shapes: Shape[], labels: Label[]}} Figure
 * @typedef {Contract["ProblemEntry"]} Problem
 * @typedef {Omit<Contract["ProblemDocument"], "type">} Failure
 * @typedef {Got<"/catalogs/{lang}">} Catalog
 * @typedef {Contract["VariationAnswer"]} Variation
 * @typedef {"derivation" | "plots" | "values"} Panel
 * @typedef {"" | "form" | "json" | "toml"} Editing  which side of the editor is open
 * @typedef {"" | "overview" | "help" | "black" | "jump" | "share"} Overlay  what lies above the page
 * @typedef {"" | "lecture"} Showing  all steps so far beside the figure, or one step at a time in a lecture
 * @typedef {"" | "substeps"} Pace  whether a lecture goes on by steps or by substeps
 * @typedef {"" | "plots" | "nothing"} Beside  what stands beside a step in a lecture, besides the drawing or without it
 * @typedef {"" | "figure" | "derivation"} Shown  what a frame of another page shows; "" for both
 * @typedef {"" | "canonical"} More  a chapter that is told when it is asked for
 * @typedef {{scene: string, step: string, lang: Lang, theme: string, method: string, n: number, formulation: Formulation,
 *   duration: number, speed: number, panel: Panel, edit: Editing, view: Showing, part: number, pace: Pace, beside: Beside,
 *   vary: string, set: string, at: number, with: string, runs: string, plot: string, show: Shown, why: string, more: More, release: string}} Place  what is shown
 * @typedef {Omit<Place, "lang"> & {lang: Lang | ""}} Address  what an address says of it: perhaps no language
 */
export {};

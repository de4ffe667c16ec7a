/** Every state of the page has an address: reading it and writing it. */

/** @typedef {import("./types.js").Place} Place */
/** @typedef {import("./types.js").Address} Address */

/** @type {Address} */
export const HOME = {
  scene: "",
  step: "",
  lang: "",
  theme: "auto",
  method: "",
  n: 0,
  formulation: "dalembert-lagrange",
  duration: 10,
  speed: 1,
  panel: "derivation",
  edit: "",
  view: "",
  part: 0,
  pace: "",
  beside: "",
  vary: "",
  set: "",
  at: 0,
  with: "",
  runs: "",
  plot: "",
  show: "",
  why: "",
  more: "",
  release: "",
};

/** @type {readonly import("./types.js").Lang[]} */
export const LANGUAGES = ["de", "en"];
const THEMES = ["auto", "light", "dark", "projector"];
/** @type {readonly import("./types.js").Formulation[]} */
export const FORMULATIONS = ["dalembert-lagrange", "hamilton"];
/** @type {readonly import("./types.js").More[]} */
const MORE = ["canonical"];
/** @type {readonly import("./types.js").Panel[]} */
const PANELS = ["derivation", "plots", "values"];
/** @type {readonly import("./types.js").Editing[]} */
const EDITING = ["form", "json", "toml"];
/** @type {readonly import("./types.js").Showing[]} */
const VIEWS = ["lecture"];
/** @type {readonly import("./types.js").Pace[]} */
const PACES = ["substeps"];
/** @type {readonly import("./types.js").Beside[]} */
const BESIDES = ["plots", "nothing"];
/** @type {readonly import("./types.js").Shown[]} */
const SHOWN = ["figure", "derivation"];
/** How many seconds of the motion pass in one of the viewer's. */
export const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 4];
const LONGEST = 100;
/** Letters of changed values: those of a dozen numbers in all their digits. */
const LONGEST_SET = 400;
const MOST = 99;

/**
 * @param {string} query e.g. "?scene=pendulum&step=position:bob"
 * @returns {Address}
 */
export function readPlace(query) {
  const given = new URLSearchParams(query);
  const seconds = Number(given.get("duration"));
  return {
    scene: slug(given.get("scene")),
    step: slug(given.get("step")),
    lang: oneOf(LANGUAGES, given.get("lang"), HOME.lang),
    theme: oneOf(THEMES, given.get("theme"), HOME.theme),
    method: slug(given.get("method")),
    n: whole(given.get("n")),
    formulation: oneOf(FORMULATIONS, given.get("formulation"), HOME.formulation),
    duration: seconds > 0 && seconds <= LONGEST ? seconds : HOME.duration,
    speed: SPEEDS.find((speed) => speed === Number(given.get("speed"))) ?? HOME.speed,
    panel: oneOf(PANELS, given.get("panel"), HOME.panel),
    edit: given.get("edit") === "" ? "form" : oneOf(EDITING, given.get("edit"), HOME.edit),
    view: oneOf(VIEWS, given.get("view"), HOME.view),
    part: whole(given.get("part")),
    pace: oneOf(PACES, given.get("pace"), HOME.pace),
    beside: oneOf(BESIDES, given.get("beside"), HOME.beside),
    vary: slug(given.get("vary")),
    set: slug(given.get("set"), LONGEST_SET),
    at: Math.max(0, Math.min(LONGEST, Number(given.get("at")) || 0)),
    with: slug(given.get("with")),
    runs: slug(given.get("runs")),
    plot: slug(given.get("plot")),
    show: oneOf(SHOWN, given.get("show"), HOME.show),
    why: slug(given.get("why")),
    more: oneOf(MORE, given.get("more"), HOME.more),
    release: slug(given.get("release")),
  };
}

/**
 * The query of a place; what is as usual is left out, so that addresses stay short.
 * @param {Address} place
 */
export function writePlace(place) {
  const query = Object.entries(place)
    .filter(([key, value]) => value !== "" && value !== HOME[/** @type {keyof Place} */ (key)])
    .map(([key, value]) => `${key}=${encodeURIComponent(value).replaceAll("%3A", ":")}`);
  return query.length ? `?${query.join("&")}` : "";
}

/** What there is besides the start page, in the order of the navigation. */
export const PAGES = ["scene", "variations", "proof", "labs", "homework", "lecture", "docs", "help"];

/** Pages that show whichever scene one comes from. */
const ABOUT_A_SCENE = ["scene", "labs", "homework"];

/** A page in the same language and appearance, about the same scene. @param {string} name @param {Pick<Address, "lang" | "theme"> & Partial<Address>} reader */
export function pageAddress(name, { lang, theme, scene = "" }) {
  return `/${name}${writePlace({ ...HOME, lang, theme, scene: ABOUT_A_SCENE.includes(name) ? scene : "" })}`;
}

/** @param {string | null} value */
const whole = (value) => Math.max(0, Math.min(MOST, Math.trunc(Number(value)) || 0));

/** @template {string} T @param {readonly T[]} allowed @param {string | null} value @param {T} otherwise @returns {T} */
export function oneOf(allowed, value, otherwise) {
  return allowed.find((one) => one === value) ?? otherwise;
}

/** @param {string | null} value @param {number} [longest] */
function slug(value, longest = 100) {
  return value && value.length <= longest && /^[\w:.,@+-]+$/.test(value) ? value : "";
}

/**
 * The language to start with: asked for, else the first known one the browser prefers.
 * @param {Address["lang"]} asked @param {readonly string[]} preferred @returns {import("./types.js").Lang}
 */
export function startLanguage(asked, preferred) {
  const wanted = preferred.map((tag) => tag.slice(0, 2).toLowerCase());
  const known = wanted.map((tag) => LANGUAGES.find((one) => one === tag)).find(Boolean);
  return asked || known || "en";
}

/**
 * Where a page begins of whose address only the looks are asked: language and appearance.
 * @param {Address} asked @param {readonly string[]} preferred @returns {Place}
 */
export const startPlace = (asked, preferred) => ({
  ...HOME,
  theme: asked.theme,
  lang: startLanguage(asked.lang, preferred),
});

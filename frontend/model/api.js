/** The API as functions; every failure comes back as an `ApiError` whose `failure` can be shown as sentences. */

import { unpacked } from "./columns.js";
import { tableOf } from "./own.js";

/** @typedef {import("./types.js").Failure} Failure */
/** @typedef {import("./types.js").Lang} Lang */
/** @template {string} P @typedef {import("./types.js").Sent<P>} Sent */
/** @template {string} P @typedef {import("./types.js").Answered<P>} Answered */
/** @template {string} P @typedef {import("./types.js").Got<P>} Got */

export class ApiError extends Error {
  /** @param {Failure} failure */
  constructor(failure) {
    super(failure.detail || failure.title);
    this.failure = failure;
  }
}

/** @type {Failure} */
const UNREACHABLE = { title: "", detail: "", problems: [], status: 0 };

/**
 * A problem+json body as a failure; anything else (a proxy's page, nothing at all) becomes one without words.
 * @param {number} status @param {unknown} body
 * @returns {Failure}
 */
export function failureOf(status, body) {
  const given = tableOf(body) ?? {};
  const problems = Array.isArray(given.problems) ? given.problems : [];
  return {
    status,
    title: typeof given.title === "string" ? given.title : "",
    detail: typeof given.detail === "string" ? given.detail : "",
    problems: problems.filter(isProblem),
  };
}

/** @param {unknown} one @returns {one is import("./types.js").Problem} */
const isProblem = (one) => typeof tableOf(one)?.message === "string";

const PAUSE = 1000;
const LONGEST = 8000;

/**
 * Asks for what is read of the API as it is in one version of δq, which the server says may then be kept for good. A
 * newer server answers all the same.
 * @param {string} source  the digest of the version, "" if it is not known @param {typeof fetch} send @returns {typeof fetch}
 */
export function ofSource(source, send) {
  if (!source) return send;
  return (address, options) =>
    send(options?.method ? address : `${address}${String(address).includes("?") ? "&" : "?"}source=${source}`, options);
}

/** @param {number} ms */
const pause = (ms) => new Promise((done) => setTimeout(done, ms));

/**
 * The same call, asked again until it answers: without its texts a page has nothing to say, not even what is wrong.
 * What the server refuses it will refuse again.
 * @template {unknown[]} A @template R
 * @param {(...given: A) => Promise<R>} call @param {typeof pause} wait @returns {(...given: A) => Promise<R>}
 */
function insistent(call, wait) {
  let answered = false;
  return async (...given) => {
    for (let ms = PAUSE; ; ms = Math.min(2 * ms, LONGEST)) {
      try {
        const answer = await call(...given);
        answered = true;
        return answer;
      } catch (error) {
        const status = error instanceof ApiError ? error.failure.status : 400;
        if (answered || (status >= 400 && status < 500)) throw error;
        await wait(ms);
      }
    }
  };
}

/**
 * @param {typeof fetch} send
 * @param {typeof pause} [wait]
 * @param {string} [base]
 */
export function createApi(send, wait = pause, base = "/api/v1") {
  /** What is answered is taken to be as the API describes it. @template A @param {string} path @param {RequestInit} [options] @returns {Promise<A>} */
  async function call(path, options) {
    const response = await send(base + path, options).catch((error) => {
      if (error?.name === "AbortError") throw error;
      throw new ApiError(UNREACHABLE);
    });
    const body = await response.json().catch(() => null);
    if (!response.ok || body === null) throw new ApiError(failureOf(response.status, body));
    return /** @type {A} */ (body);
  }

  /** @template A @param {string} path @param {string} type @param {string} body @param {AbortSignal} [signal] @returns {Promise<A>} */
  const put = (path, type, body, signal) =>
    call(path, { method: "POST", headers: { "content-type": type }, body, signal });

  /** @template {string} P @param {P} path @param {Sent<P>} body @param {AbortSignal} [signal] @returns {Promise<Answered<P>>} */
  const post = (path, body, signal) => put(path, "application/json", JSON.stringify(body), signal);

  return {
    post,
    /** @param {{summaries?: boolean}} [options] @returns {Promise<Got<"/scenes">>} */
    scenes: ({ summaries = false } = {}) => call(`/scenes?summaries=${summaries}`),
    /** @param {string} id @param {Lang} lang of what may go wrong @param {number} [n] members of a chain, 0 for the usual @returns {Promise<import("./types.js").Scene>} */
    scene: (id, lang, n = 0) => call(`/scenes/${encodeURIComponent(id)}?lang=${lang}${n ? `&n=${n}` : ""}`),
    /** OpenAPI @returns {Promise<import("./reference.js").Description>} */
    description: () => call("/openapi.json"),
    /** @returns {Promise<Got<"/methods">>} */
    methods: () => call("/methods"),
    /** @returns {Promise<Got<"/experiments">>} */
    experiments: () => call("/experiments"),
    /** @type {(lang: Lang, ...sections: string[]) => Promise<import("./types.js").Catalog>} `sections` besides those of every page */
    catalog: insistent((lang, ...sections) => call(`/catalogs/${lang}?sections=${["page", ...sections]}`), wait),
    /** @param {Sent<"/derivations">} body @param {AbortSignal} [signal] */
    derive: (body, signal) => post("/derivations", body, signal),
    /** @param {import("./own.js").SceneDocument} scene @param {Lang} lang @param {AbortSignal} [signal] @returns {Promise<Answered<"/scenes/validate">>} */
    validate: (scene, lang, signal) =>
      put(`/scenes/validate?lang=${lang}`, "application/json", JSON.stringify(scene), signal),
    /** @param {string} text @param {Lang} lang @returns {Promise<Answered<"/scenes/toml">>} */
    readToml: (text, lang) => put(`/scenes/toml?lang=${lang}`, "application/toml", text),
    /** @param {Sent<"/tasks/poll">} body @param {AbortSignal} [signal] */
    poll: (body, signal) => post("/tasks/poll", body, signal),
    /** @param {Sent<"/expressions/batch">} body @param {AbortSignal} [signal] */
    typeset: (body, signal) => post("/expressions/batch", body, signal),
    /** @param {Sent<"/variations">} body @param {AbortSignal} [signal] @returns {Promise<import("./types.js").Variation>} */
    vary: (body, signal) => put("/variations", "application/json", JSON.stringify(body), signal),
    /** @param {string} id @param {Lang} lang @returns {Promise<Got<"/proofs/{identifier}">>} */
    proof: (id, lang) => call(`/proofs/${id}?lang=${lang}`),
    /** @param {Sent<"/simulations">} body @param {AbortSignal} [signal] @returns {Promise<import("./types.js").Trajectory>} */
    simulate: async (body, signal) => unpacked(await post("/simulations", { ...body, columns: "planes" }, signal)),
  };
}

/** @typedef {ReturnType<typeof createApi>} Api */

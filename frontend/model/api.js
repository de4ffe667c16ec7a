/** The API as functions; every failure comes back as an `ApiError` whose `failure` can be shown as sentences. */

/** @typedef {import("./types.js").Failure} Failure */

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
  const given = /** @type {Record<string, unknown>} */ (body && typeof body === "object" ? body : {});
  const problems = Array.isArray(given.problems) ? given.problems : [];
  return {
    status,
    title: typeof given.title === "string" ? given.title : "",
    detail: typeof given.detail === "string" ? given.detail : "",
    problems: problems.filter((problem) => typeof problem?.message === "string"),
  };
}

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
 * @template {any[]} A @template R
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
  /** @param {string} path @param {RequestInit} [options] */
  async function call(path, options) {
    const response = await send(base + path, options).catch((error) => {
      if (error?.name === "AbortError") throw error;
      throw new ApiError(UNREACHABLE);
    });
    const body = await response.json().catch(() => null);
    if (!response.ok || body === null) throw new ApiError(failureOf(response.status, body));
    return body;
  }

  /** @param {string} path @param {object} body @param {AbortSignal} [signal] */
  const post = (path, body, signal) =>
    call(path, { method: "POST", headers: { "content-type": "application/json" }, body: JSON.stringify(body), signal });

  return {
    post,
    /** @param {{summaries?: boolean}} [options] @returns {Promise<{scenes: import("./types.js").SceneEntry[]}>} */
    scenes: ({ summaries = false } = {}) => call(`/scenes?summaries=${summaries}`),
    /** @param {string} id @param {string} lang of what may go wrong @param {number} [n] members of a chain, 0 for the usual @returns {Promise<import("./types.js").Scene>} */
    scene: (id, lang, n = 0) => call(`/scenes/${encodeURIComponent(id)}?lang=${lang}${n ? `&n=${n}` : ""}`),
    /** OpenAPI @returns {Promise<Record<string, any>>} */
    description: () => call("/openapi.json"),
    /** @returns {Promise<{methods: import("./types.js").Method[]}>} */
    methods: () => call("/methods"),
    /** @param {string} lang @param {string[]} sections  besides those of every page @returns {Promise<import("./types.js").Catalog>} */
    catalog: insistent((lang, ...sections) => call(`/catalogs/${lang}?sections=${["page", ...sections]}`), wait),
    /** @param {object} body @param {AbortSignal} [signal] @returns {Promise<import("./types.js").Derivation>} */
    derive: (body, signal) => post("/derivations", body, signal),
    /** @param {object} scene @param {string} lang @param {AbortSignal} [signal] @returns {Promise<{valid: boolean, problems: import("./types.js").Problem[]}>} */
    validate: (scene, lang, signal) => post(`/scenes/validate?lang=${lang}`, scene, signal),
    /** @param {string} text @param {string} lang @returns {Promise<{scene: import("./own.js").SceneDocument}>} */
    readToml: (text, lang) =>
      call(`/scenes/toml?lang=${lang}`, {
        method: "POST",
        headers: { "content-type": "application/toml" },
        body: text,
      }),
    /** @param {object} body @param {AbortSignal} [signal] @returns {Promise<{expressions: {latex: string}[]}>} */
    typeset: (body, signal) => post("/expressions/batch", body, signal),
    /** @param {object} body @param {AbortSignal} [signal] @returns {Promise<any>} */
    vary: (body, signal) => post("/variations", body, signal),
    /** @param {string} id @param {string} lang @returns {Promise<import("./types.js").Derivation>} */
    proof: (id, lang) => call(`/proofs/${id}?lang=${lang}`),
    /** @param {object} body @param {AbortSignal} [signal] @returns {Promise<import("./types.js").Trajectory>} */
    simulate: (body, signal) => post("/simulations", body, signal),
  };
}

/** @typedef {ReturnType<typeof createApi>} Api */

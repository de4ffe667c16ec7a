/** The page's texts: in one language at a time, the rarer ones fetched when they are first needed. */

/**
 * @param {{get: () => {place: import("./types.js").Place, catalog: import("./types.js").Catalog},
 *   set: (patch: {place?: import("./types.js").Place, catalog?: import("./types.js").Catalog}) => void}} store
 * @param {Pick<import("./api.js").Api, "catalog">} api
 * @param {(task: () => Promise<void>) => Promise<void>} attempt
 * @param {string[]} always  sections wanted from the beginning, besides those of every page
 */
export function createSpeech({ get, set }, api, attempt, always = []) {
  const wanted = new Set(always);
  let asked = 0;
  let spoken = 0;

  /** @param {import("./types.js").Lang} lang */
  async function speak(lang) {
    set({ place: { ...get().place, lang } });
    const turn = (asked += 1);
    await attempt(async () => {
      const catalog = await api.catalog(lang, ...wanted);
      // An answer that was overtaken holds fewer sections.
      if (get().place.lang !== lang || turn < spoken) return;
      spoken = turn;
      set({ catalog });
    });
  }

  /** @param {string} section */
  function need(section) {
    if (wanted.has(section)) return;
    wanted.add(section);
    if (get().catalog.page) void speak(get().place.lang);
  }

  return {
    speak,
    need,
    /** The texts of what a place shows. @param {Partial<import("./types.js").Place>} place */
    needFor({ edit, view }) {
      if (edit) need("editor");
      if (view) need("lecture");
    },
  };
}

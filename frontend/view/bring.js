/** What a page fetches only when it is wanted: style sheets and scripts. */

/** Comes when the element has what it names; it is taken away again where that cannot be had. @param {HTMLLinkElement | HTMLScriptElement} element @returns {Promise<void>} */
function brought(element) {
  return new Promise((done, refuse) => {
    element.onload = () => done();
    element.onerror = () => {
      element.remove();
      refuse(new Error(`not to be had: ${"src" in element ? element.src : element.href}`));
    };
    document.head.append(element);
  });
}

/** A sheet that the import map names; what is shown before would move when it comes. @param {string} name */
export const sheet = (name) =>
  brought(
    Object.assign(document.createElement("link"), {
      rel: "stylesheet",
      href: import.meta.resolve(`styles/${name}.css`),
    }),
  );

/** @param {string} address */
export const script = (address) => brought(Object.assign(document.createElement("script"), { src: address }));

/** What is on its way, together with the sheet that dresses it. @template T @param {Promise<T>} coming @param {string} name */
export const styled = async (coming, name) => (await Promise.all([coming, sheet(name)]))[0];

/** What a page fetches only when it is wanted: style sheets and scripts. */

/** Comes true when the element has what it names, false if that cannot be had. @param {HTMLLinkElement | HTMLScriptElement} element @returns {Promise<boolean>} */
function brought(element) {
  return new Promise((done) => {
    element.onload = () => done(true);
    element.onerror = () => done(false);
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

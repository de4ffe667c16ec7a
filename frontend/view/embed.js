/** In a frame of another page: what is shown, how high it is, and the way to the whole. */

/**
 * Tells the page around each height as {type: "deltaq.height", height, scene, step}, where a proof has no scene, so that it can fit the frame.
 * @param {HTMLElement} root @param {() => import("../model/types.js").Place} place @param {() => string} whole  address of the same place as a page
 */
export function embed(root, place, whole) {
  const { show } = place();
  if (show) document.documentElement.dataset.show = show;
  const home = document.createElement("p");
  const link = document.createElement("a");
  home.className = "home";
  link.target = "_blank";
  link.rel = "noopener";
  link.textContent = "δq";
  home.append(link);
  root.after(home);

  function tell() {
    link.href = whole();
    if (window.parent === window) return;
    const { scene, step } = place();
    window.parent.postMessage(
      { type: "deltaq.height", height: Math.ceil(document.body.getBoundingClientRect().height), scene, step },
      "*",
    );
  }
  new ResizeObserver(tell).observe(document.body);
  return tell;
}

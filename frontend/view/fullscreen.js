/** The whole screen, where the browser allows it. */

/** Into it. */
export const enterFullscreen = () => void document.documentElement.requestFullscreen?.().catch(() => {});

/** Into it, or out again. */
export function toggleFullscreen() {
  if (document.fullscreenElement) void document.exitFullscreen();
  else enterFullscreen();
}

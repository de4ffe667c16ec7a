/** Rungs of the fidelity ladder in words. */

/** @param {{parts: {kind: string, parameters: Record<string, string>}[]}} rung @param {(key: string, parameters?: Record<string, string>) => string} t */
export function titleOf({ parts }, t) {
  return parts.map(({ kind, parameters }) => t(`ladder.kinds.${kind}.title`, parameters)).join(", ") || t("ladder.kinds.full.title");
}

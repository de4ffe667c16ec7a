/** Letters that a file brings along, so that it looks the same wherever it is opened. */

/** @typedef {{family: string, slant: string, weight: string, address: string}} Face  address: of a file in the form WOFF2 */

/** Bytes that are written as text at once: all of them would be too many arguments. */
const PIECE = 8192;

/** @param {Uint8Array} bytes */
function base64(bytes) {
  const pieces = [];
  for (let at = 0; at < bytes.length; at += PIECE) pieces.push(String.fromCharCode(...bytes.subarray(at, at + PIECE)));
  return btoa(pieces.join(""));
}

/** @param {typeof fetch} send @param {Face} face @returns {Promise<string>} empty where the letters cannot be had: others are taken for them */
async function ruleOf(send, { family, slant, weight, address }) {
  const response = await send(address).catch(() => null);
  if (!response?.ok) return "";
  const data = base64(new Uint8Array(await response.arrayBuffer()));
  const described = `font-family:"${family}";font-style:${slant || "normal"};font-weight:${weight || "normal"}`;
  return `@font-face{${described};src:url(data:font/woff2;base64,${data}) format("woff2")}`;
}

/** Rules @font-face with the data of the letters. @param {typeof fetch} send @param {readonly Face[]} faces */
export const lettersOf = async (send, faces) =>
  (await Promise.all(faces.map((face) => ruleOf(send, face)))).filter(Boolean).join("\n");

/**
 * The length of a film in the form WebM, which recorders leave out: without it programs neither tell it nor jump in it.
 * Source: RFC 8794 (EBML), RFC 9559 (Matroska), sections 5.1.2 and 7.1.
 */

const [SEGMENT, INFO, DURATION, SCALE] = [0x18538067, 0x1549a966, 0x4489, 0x2ad7b1];
/** Nanoseconds of a tick, where none are written. */
const MILLISECOND = 1e6;

/** @typedef {{id: number, at: number, begin: number, size: number, length: number}} Element  at: where its size is written, in so many bytes */

/** A number of as many bytes as its leading bit says. @param {Uint8Array} bytes @param {number} at @param {boolean} whole  with that bit */
function number(bytes, at, whole) {
  const length = Math.clz32(bytes[at] ?? 0) - 23;
  let value = whole ? bytes[at] : bytes[at] & (0xff >> length);
  for (let i = 1; i < length; i += 1) value = value * 256 + bytes[at + i];
  return { value, length };
}

/** @param {Uint8Array} bytes @param {number} from @param {number} to @returns {Generator<Element>} */
function* elements(bytes, from, to) {
  for (let at = from; at < to;) {
    const id = number(bytes, at, true);
    const size = number(bytes, at + id.length, false);
    if (id.length > 4 || size.length > 8) return;
    const begin = at + id.length + size.length;
    yield { id: id.value, at: at + id.length, begin, size: size.value, length: size.length };
    at = begin + size.value;
  }
}

/** @param {Iterable<Element>} list @param {number} id */
const find = (list, id) => [...list].find((element) => element.id === id);

/** The number of an element, or nothing. @param {Uint8Array} bytes @param {Element | undefined} element */
const unsigned = (bytes, element) =>
  element && bytes.subarray(element.begin, element.begin + element.size).reduce((value, byte) => value * 256 + byte, 0);

/**
 * The same film with its length written; as it is where there is one, or no place for it.
 * @param {Uint8Array} bytes @param {number} seconds @returns {Uint8Array<ArrayBuffer>}
 */
export function withLength(bytes, seconds) {
  const same = new Uint8Array(bytes);
  const segment = find(elements(bytes, 0, Math.min(bytes.length, 4096)), SEGMENT);
  const info = segment && find(elements(bytes, segment.begin, Math.min(bytes.length, segment.begin + 4096)), INFO);
  if (!segment || !info) return same;
  const end = info.begin + info.size;
  const inside = [...elements(bytes, info.begin, end)];
  // Where all sizes before it are known, what is put in would make them wrong.
  const isOpen = segment.size >= 2 ** (7 * segment.length) - 1;
  if (!isOpen || find(inside, DURATION)) return same;
  const ticks = (seconds * 1e9) / (unsigned(bytes, find(inside, SCALE)) || MILLISECOND);
  const written = new Uint8Array(11);
  written.set([DURATION >> 8, DURATION & 0xff, 0x88]);
  new DataView(written.buffer).setFloat64(3, ticks);
  const size = new Uint8Array(8);
  new DataView(size.buffer).setBigUint64(0, BigInt(info.size + written.length) | (1n << 56n));
  const pieces = [bytes.subarray(0, info.at), size, bytes.subarray(info.begin, end), written, bytes.subarray(end)];
  const made = new Uint8Array(pieces.reduce((sum, piece) => sum + piece.length, 0));
  let at = 0;
  for (const piece of pieces) {
    made.set(piece, at);
    at += piece.length;
  }
  return made;
}

/** Files as one archive and back (APPNOTE.TXT, the part that every program writes: stored or deflated, no encryption). */

import { deflated, inflated } from "../own.js";

/** @typedef {{name: string, bytes: Uint8Array}} Packed */

const [LOCAL, ENTRY, END] = [0x04034b50, 0x02014b50, 0x06054b50];
const [LOCAL_SIZE, ENTRY_SIZE, END_SIZE] = [30, 46, 22];
const DEFLATED = 8;
const UTF8 = 0x0800;
const LONGEST_COMMENT = 65_535;
/** More files are no class. */
const MOST_FILES = 4000;

const TABLE = Uint32Array.from({ length: 256 }, (_, n) => {
  let c = n;
  for (let bit = 0; bit < 8; bit += 1) c = c & 1 ? 0xedb88320 ^ (c >>> 1) : c >>> 1;
  return c;
});

/** The checksum of an archive (CRC-32). @param {Uint8Array} bytes */
export function checksum(bytes) {
  let c = 0xffffffff;
  for (const byte of bytes) c = TABLE[(c ^ byte) & 255] ^ (c >>> 8);
  return (c ^ 0xffffffff) >>> 0;
}

/** Numbers of two or four bytes, the lowest byte first. @param {[number, number][]} fields  value and size */
function header(fields) {
  const size = fields.reduce((sum, [, bytes]) => sum + bytes, 0);
  const view = new DataView(new ArrayBuffer(size));
  let at = 0;
  for (const [value, bytes] of fields) {
    if (bytes === 2) view.setUint16(at, value, true);
    else view.setUint32(at, value, true);
    at += bytes;
  }
  return new Uint8Array(view.buffer);
}

/** @param {Uint8Array[]} parts */
function joined(parts) {
  const all = new Uint8Array(parts.reduce((sum, { length }) => sum + length, 0));
  let at = 0;
  for (const part of parts) {
    all.set(part, at);
    at += part.length;
  }
  return all;
}

/** One archive of all files. @param {Packed[]} files */
export async function zipped(files) {
  const parts = /** @type {Uint8Array[]} */ ([]);
  const entries = /** @type {Uint8Array[]} */ ([]);
  let offset = 0;
  for (const { name, bytes } of files) {
    const title = new TextEncoder().encode(name).subarray(0, LONGEST_COMMENT);
    const body = await deflated(bytes, Infinity);
    /** @type {[number, number][]} version, flags, method, time and date (none), checksum, sizes, lengths of name and extra */
    const told = [
      [20, 2],
      [UTF8, 2],
      [DEFLATED, 2],
      [0, 2],
      [33, 2],
      [checksum(bytes), 4],
      [body.length, 4],
      [bytes.length, 4],
      [title.length, 2],
      [0, 2],
    ];
    parts.push(header([[LOCAL, 4], ...told]), title, body);
    // After those: length of a comment, number of a disk, attributes inside and outside, and where the file begins.
    const place = /** @type {[number, number][]} */ ([
      [0, 2],
      [0, 2],
      [0, 2],
      [0, 4],
      [offset, 4],
    ]);
    entries.push(header([[ENTRY, 4], [20, 2], ...told, ...place]), title);
    offset += LOCAL_SIZE + title.length + body.length;
  }
  const list = joined(entries);
  /** @type {[number, number][]} */
  const end = [
    [END, 4],
    [0, 2],
    [0, 2],
    [files.length, 2],
    [files.length, 2],
    [list.length, 4],
    [offset, 4],
    [0, 2],
  ];
  return joined([...parts, list, header(end)]);
}

/** Whether these are the bytes of an archive. @param {Uint8Array} bytes */
export const isZip = (bytes) => bytes[0] === 80 && bytes[1] === 75 && [3, 5].includes(bytes[2]);

/** What an archive lists; a RangeError if it cannot be read. @param {Uint8Array} bytes */
function listed(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  let end = bytes.length - END_SIZE;
  const least = Math.max(0, end - LONGEST_COMMENT);
  while (end >= least && view.getUint32(end, true) !== END) end -= 1;
  if (end < least) throw new RangeError("no list of files");
  const count = view.getUint16(end + 10, true);
  if (count > MOST_FILES) throw new RangeError("too many files");
  let at = view.getUint32(end + 16, true);
  return Array.from({ length: count }, () => {
    if (view.getUint32(at, true) !== ENTRY) throw new RangeError("no file");
    const [method, size, name, extra, comment] = [10, 20, 28, 30, 32].map((place) =>
      place === 20 ? view.getUint32(at + place, true) : view.getUint16(at + place, true),
    );
    const [begin, start] = [at + ENTRY_SIZE, view.getUint32(at + 42, true)];
    at = begin + name + extra + comment;
    return { name: new TextDecoder().decode(bytes.subarray(begin, begin + name)), method, size, start };
  });
}

/**
 * The files of an archive, none longer than `limit`: of a longer one, or one that is broken, nothing but its name comes.
 * A RangeError where the archive itself cannot be read.
 * @param {Uint8Array} bytes @param {number} limit @returns {Promise<{name: string, bytes: Uint8Array | null}[]>}
 */
export async function unzipped(bytes, limit) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const files = listed(bytes).filter(({ name }) => !name.endsWith("/") && !name.startsWith("__MACOSX/"));
  return Promise.all(
    files.map(async ({ name, method, size, start }) => {
      try {
        const begin = start + LOCAL_SIZE + view.getUint16(start + 26, true) + view.getUint16(start + 28, true);
        const body = bytes.subarray(begin, begin + size);
        if (method !== 0 && method !== DEFLATED) return { name, bytes: null };
        if (method === 0) return { name, bytes: body.length > limit ? null : body };
        return { name, bytes: await inflated(body, limit) };
      } catch {
        return { name, bytes: null };
      }
    }),
  );
}

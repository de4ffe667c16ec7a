/** What a student hands in, and what a teacher drops: files with a name and the code of the sheet, and many of them as one. */

import { partsIn, valueOf } from "./answering.js";
import { isEmpty } from "./answer.js";
import { isZip, unzipped, zipped } from "./zip.js";

/** @typedef {import("./sheet.js").Entry} Entry */
/** @typedef {import("./progress.js").Progress} Progress */
/** @typedef {{task: number, syntax: import("./answer.js").Syntax, value: string}} Answer */
/** @typedef {{name: string, id: string}} Who */
/** @typedef {Pick<File, "name" | "size" | "slice">} Dropped */

const FORMAT = "deltaq-handin-1";
/** Bytes of a file that are looked at: more than anything that is handed in has. */
const MOST = 70_000;
const LARGEST_ZIP = 100_000_000;
/** Bytes of what is sent: a request may be a megabyte of base64. */
const BUDGET = 700_000;
/** No hand-in that is shorter is given up, however much was dropped. */
const LEAST = 8_000;
/** How a hand-in begins, perhaps after a byte order mark; of anything else its beginning is enough to say so. */
const BEGINNING = /^[\ufeff\s]*\{/;
const SHOWN = 64;
const WHO = "~who";

/** What is there to be handed in: the answer to each task, else the last line of the working that answers it. @param {Entry[]} entries @param {Progress} progress @returns {Answer[]} */
export function answersOf(entries, progress) {
  return entries.flatMap((entry) => {
    const task = Number(entry.id);
    const draft = progress.draft(entry.key);
    if (!isEmpty(partsIn(entry, draft))) return [{ task, syntax: draft.syntax, value: valueOf(entry, draft) }];
    const line = progress
      .lines(`${entry.group}/~working`)
      .filter((one) => one.task === entry.task.id && one.value.trim())
      .at(-1);
    return line ? [{ task, syntax: line.syntax, value: line.value }] : [];
  });
}

/** The text of the file. @param {string} sheet  its code @param {Who} who @param {Answer[]} answers @param {Date} now */
export const handIn = (sheet, { name, id }, answers, now) =>
  JSON.stringify({ format: FORMAT, sheet, student: name, id, time: now.toISOString(), answers }, null, 1);

/** Words as they may stand in the name of a file. @param {string[]} words */
export const fileName = (...words) =>
  words
    .map((word) =>
      word
        .replace(/[^\p{L}\p{N}]+/gu, "-")
        .replace(/^-+|-+$/g, "")
        .slice(0, 40),
    )
    .filter(Boolean)
    .join("-")
    .toLowerCase();

/** @param {Progress} progress */
export const createWho = (progress) => ({
  /** @returns {Who} */
  get: () => progress.who(WHO),
  /** @param {Who} who */
  set: (who) => progress.write(WHO, who),
});

/**
 * All that was dropped as one archive, those in archives with them. What is too long to be a hand-in is sent as so many
 * spaces, so that the server names it as it names all others.
 * @param {readonly Dropped[]} files @returns {Promise<{bytes: Uint8Array, count: number, broken: string[]}>} `broken` are archives
 */
export async function gathered(files) {
  const broken = /** @type {string[]} */ ([]);
  const found = /** @type {{name: string, bytes: Uint8Array | null}[]} */ ([]);
  for (const file of files) {
    const bytes = await beginning(file);
    if (!isZip(bytes)) found.push({ name: file.name, bytes: bytes.length > MOST ? null : bytes });
    else
      await opened(file).then(
        (inside) => found.push(...inside),
        () => broken.push(file.name),
      );
  }
  return { bytes: await packed(found), count: found.length, broken };
}

/** Whoever drops megabytes of what looks like hand-ins keeps no other from being marked: the longest are given up. @param {{name: string, bytes: Uint8Array | null}[]} files */
async function packed(files) {
  for (let limit = MOST; ; limit /= 2) {
    const archive = await zipped(files.map(({ name, bytes }) => ({ name, bytes: sendable(bytes, limit) })));
    if (archive.length <= BUDGET || limit < LEAST) return archive;
  }
}

/** @param {Uint8Array | null} bytes @param {number} limit */
function sendable(bytes, limit) {
  if (!bytes || bytes.length > limit) return new Uint8Array(MOST).fill(32);
  return BEGINNING.test(new TextDecoder("utf-8", { ignoreBOM: true }).decode(bytes.subarray(0, SHOWN)))
    ? bytes
    : bytes.subarray(0, SHOWN);
}

/** @param {Dropped} file */
const beginning = async (file) => new Uint8Array(await file.slice(0, MOST + 1).arrayBuffer());

/** @param {Dropped} file */
async function opened(file) {
  if (file.size > LARGEST_ZIP) throw new RangeError("too large");
  return unzipped(new Uint8Array(await file.slice(0, file.size).arrayBuffer()), MOST);
}

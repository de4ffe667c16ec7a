/**
 * The page's own modules mark tables: a line of JSON in, {address, table (base64), assignment, scene, language}, and a
 * line out, the bytes in base64 that the page would save (the results, the points for Moodle and for Canvas), or the failure
 * that it would show. An archive goes the way of files that are dropped.
 */

import { createInterface } from "node:readline";
import { createClassroom } from "../../frontend/model/homework/classroom.js";
import { isZip } from "../../frontend/model/homework/zip.js";

for await (const line of createInterface({ input: process.stdin })) {
  const { address, table, assignment, scene, language } = JSON.parse(line);
  const state = { asked: { place: { lang: language } }, assignment, entry: scene ? { reference: { scene } } : null };
  const send = (path, options) => fetch(new URL(path, address), options);
  const session = createClassroom({ send, state: () => state, questions: async () => null });
  const bytes = Uint8Array.from(Buffer.from(table, "base64"));
  const file = new File([bytes], isZip(bytes) ? "class.zip" : "class.csv");
  await session.take([file], { named: "", broken: "" });
  const { csv, platforms, failure } = session.get();
  const packed = async (text) => Buffer.from(await new Blob([text]).arrayBuffer()).toString("base64");
  const saved = csv === null ? null : await Promise.all([csv, platforms.moodle, platforms.canvas].map(packed));
  process.stdout.write(`${JSON.stringify({ saved, failure })}\n`);
}

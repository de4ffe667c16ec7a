/**
 * The page's own modules mark tables: a line of JSON in, {address, table (base64), assignment, scene, language}, and a
 * line out, the bytes in base64 that the page would save, or the failure that it would show.
 */

import { createInterface } from "node:readline";
import { createClassroom } from "../../frontend/model/homework/classroom.js";

for await (const line of createInterface({ input: process.stdin })) {
  const { address, table, assignment, scene, language } = JSON.parse(line);
  const state = { asked: { place: { lang: language } }, assignment, entry: scene ? { reference: { scene } } : null };
  const send = (path, options) => fetch(new URL(path, address), options);
  const session = createClassroom({ send, state: () => state, questions: async () => null });
  await session.grade("class.csv", Uint8Array.from(Buffer.from(table, "base64")));
  const { csv, failure } = session.get();
  const saved = csv === null ? null : Buffer.from(await new Blob([csv]).arrayBuffer()).toString("base64");
  process.stdout.write(`${JSON.stringify({ saved, failure })}\n`);
}

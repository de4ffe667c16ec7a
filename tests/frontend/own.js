/** What the page understands of documents and of names, as it is asked on the standard input. */

import { completed, latexOfName } from "../../frontend/model/own.js";

let asked = "";
for await (const piece of process.stdin) asked += piece;
const { documents, names } = JSON.parse(asked);
console.log(JSON.stringify({ documents: documents.map(completed), names: names.map(latexOfName) }));

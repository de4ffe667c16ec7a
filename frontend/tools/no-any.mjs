/**
 * A rule for eslint: types in comments say what they are. `any` switches all checks off where it reaches, and so do `*`,
 * `?`, `Object` and `Function`; what is not known is `unknown`, until somebody has looked.
 */

import ts from "typescript";

const KINDS = new Set([ts.SyntaxKind.AnyKeyword, ts.SyntaxKind.JSDocAllType, ts.SyntaxKind.JSDocUnknownType]);
const NAMES = new Set(["Object", "Function"]);

/** @param {ts.Node} node */
const isLoose = (node) =>
  KINDS.has(node.kind) || (ts.isTypeReferenceNode(node) && !node.typeArguments && NAMES.has(node.typeName.getText()));

/** All parts of a program, its comments among them, that switch checks off. @param {ts.Node} node @returns {ts.Node[]} */
const looseIn = (node) => (isLoose(node) ? [node] : node.getChildren().flatMap(looseIn));

/** @type {import("eslint").Rule.RuleModule} */
export default {
  meta: { type: "problem", messages: { loose: "“{{type}}” switches the checks off: say what it is, or unknown." } },
  create: ({ filename, sourceCode, report }) => ({
    Program() {
      const program = ts.createSourceFile(filename, sourceCode.text, ts.ScriptTarget.ESNext, true, ts.ScriptKind.JS);
      for (const node of looseIn(program)) {
        const loc = sourceCode.getLocFromIndex(node.getStart());
        report({ loc, messageId: "loose", data: { type: node.getText() } });
      }
    },
  }),
};

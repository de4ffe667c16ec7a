/**
 * What eslint looks for: its recommended rules; a name that begins with _ says itself that it is not used; and types that
 * are none.
 */

import js from "@eslint/js";
import globals from "globals";
import noAny from "./tools/no-any.mjs";

export default [
  { ignores: ["bundle/", "bundle.new/", "node_modules/", "vendor/"] },
  js.configs.recommended,
  { rules: { "no-unused-vars": ["error", { argsIgnorePattern: "^_", varsIgnorePattern: "^_" }] } },
  { linterOptions: { reportUnusedDisableDirectives: "error" } },
  {
    files: ["*.js", "model/**/*.js", "view/**/*.js"],
    languageOptions: { globals: { ...globals.browser, katex: "readonly", Plotly: "readonly" } },
    plugins: { page: { rules: { "no-any": noAny } } },
    rules: { "page/no-any": "error" },
  },
  { files: ["tools/**/*.mjs", "*.mjs"], languageOptions: { globals: globals.node } },
];

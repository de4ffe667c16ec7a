/** What eslint looks for: its recommended rules; a name that begins with _ says itself that it is not used. */

import js from "@eslint/js";
import globals from "globals";

export default [
  { ignores: ["bundle/", "bundle.new/", "node_modules/", "vendor/"] },
  js.configs.recommended,
  { rules: { "no-unused-vars": ["error", { argsIgnorePattern: "^_", varsIgnorePattern: "^_" }] } },
  { linterOptions: { reportUnusedDisableDirectives: "error" } },
  {
    files: ["*.js", "model/**/*.js", "view/**/*.js"],
    languageOptions: { globals: { ...globals.browser, katex: "readonly", Plotly: "readonly" } },
  },
  { files: ["tools/**/*.mjs", "*.mjs"], languageOptions: { globals: globals.node } },
];

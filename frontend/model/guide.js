/** What the help tells whom, in order; `to` is the page where an entry can be tried. */

/** @typedef {{id: string, to?: string}} Entry */
/** @typedef {{id: string, entries: Entry[]}} Part */

/** @type {Part[]} */
export const GUIDE = [
  {
    id: "lecturers",
    entries: [
      { id: "prepare", to: "scene" },
      { id: "give", to: "scene" },
      { id: "presenter" },
      { id: "lecture", to: "lecture" },
      { id: "think" },
      { id: "figure", to: "scene" },
      { id: "laboratory", to: "labs" },
      { id: "road", to: "proof" },
      { id: "handout" },
      { id: "homework", to: "homework" },
      { id: "embed" },
    ],
  },
  {
    id: "students",
    entries: [
      { id: "read", to: "scene" },
      { id: "move" },
      { id: "vary", to: "variations" },
      { id: "write", to: "homework" },
      { id: "wrong" },
      { id: "lines" },
      { id: "practise", to: "homework" },
      { id: "own" },
    ],
  },
  {
    id: "programs",
    entries: [
      { id: "first" },
      { id: "reference", to: "docs" },
      { id: "plain" },
      { id: "accuracy" },
      { id: "errors", to: "problems" },
      { id: "shell" },
      { id: "client" },
    ],
  },
];

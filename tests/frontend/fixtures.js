/** A scene and a trajectory small enough to be checked by hand. */

export const scene = {
  id: "swing",
  title: { de: "Schaukel", en: "Swing" },
  summary: { de: "", en: "" },
  dimension: 2,
  coordinates: [
    { name: "y", latex: "q_1", unit: "m", value: 0.1, rate: 0, min: -0.5, max: 0.5 },
    { name: "phi", latex: "q_2", unit: "rad", value: 1, rate: 0, min: null, max: null },
  ],
  parameters: [
    { name: "m", latex: "", unit: "kg", value: 1, min: 0.1, max: 5 },
    { name: "g", latex: "", unit: "m/s^2", value: 9.81, min: null, max: null },
  ],
  points: [{ name: "pivot", position: ["0", "y"] }],
  bodies: [{ name: "bob", kind: "particle", mass: "m", position: ["sin(phi)", "y+cos(phi)"] }],
  loads: [
    { kind: "gravity", name: "weight", acceleration: ["0", "g"] },
    { kind: "force", name: "F", at: "bob" },
  ],
  guides: [],
  drawing: {
    vertical: "down",
    view: [-2, 2, -2, 2],
    elements: [
      { kind: "bob", at: "bob" },
      { kind: "rod", from: "pivot", to: "bob" },
      { kind: "angle", at: "pivot", coordinate: "phi" },
      { kind: "force", load: "F" },
      { kind: "ground", at: "pivot" },
    ],
  },
};

const times = [0, 1, 2, 3, 4];

export const trajectory = {
  status: "ok",
  t: times,
  coordinates: { y: times.map(() => 0), phi: times.map((t) => t / 4) },
  rates: { y: times.map(() => 0), phi: times.map(() => 0.25) },
  positions: { pivot: times.map(() => [0, 0]), bob: times.map((t) => [Math.sin(t / 4), Math.cos(t / 4)]) },
  loads: { F: times.map(() => [2, 0]) },
  energy: { kinetic: [0, 1, 2, 3, 4], potential: [4, 3, 2, 1, 0], balance: [4, 4, 4, 4, 4] },
  error: { estimate: [0, 1e-9, 2e-9, 3e-9, 4e-9] },
  cost: { steps: 10 },
  method: "rk4",
};

/** @param {number} size */
export const square = (size) => ({ width: size, height: size });

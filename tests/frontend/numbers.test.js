import { strict as assert } from "node:assert";
import { test } from "node:test";
import {
  decimalsOf,
  duration,
  fixed,
  niceFloor,
  roughly,
  significant,
  unitText,
  withDecimalMark,
  withUnit,
} from "../../frontend/model/numbers.js";

const CASES = [
  ["a time to wait is ten seconds at least", roughly(0), "10 s"],
  ["a time to wait in tens of seconds", roughly(41.2), "50 s"],
  ["a time to wait in minutes", roughly(61), "2 min"],
  ["decimal comma in German", fixed(1.25, 2, "de"), "1,25"],
  ["decimal point in English", fixed(1.25, 2, "en"), "1.25"],
  ["true minus sign", fixed(-0.5, 1, "en"), "−0.5"],
  ["no negative zero", fixed(-0.0004, 2, "en"), "0.00"],
  ["no grouping of thousands", fixed(12345.6, 1, "de"), "12345,6"],
  ["not a number", fixed(NaN, 2, "en"), "–"],
  ["tiny numbers with a power of ten", significant(8.64e-8, 2, "de"), "8,6·10⁻⁸"],
  ["rounding that carries into the exponent", significant(9.96e-8, 2, "en"), "1.0·10⁻⁷"],
  ["ordinary numbers without one", significant(148.2, 3, "en"), "148"],
  ["below one", significant(0.0123, 2, "en"), "0.012"],
  ["large numbers with a power of ten", significant(2.5e6, 2, "en"), "2.5·10⁶"],
  ["nothing", significant(0, 3, "en"), "0"],
  ["microseconds", duration(42e-6, "en"), "42 µs"],
  ["milliseconds", duration(0.0021, "de"), "2,1 ms"],
  ["seconds", duration(1.5, "en"), "1.50 s"],
  ["decimal comma in a formula", withDecimalMark("x = -0.25 t + 3", "de"), "x = -0{,}25 t + 3"],
  ["none in a formula in English", withDecimalMark("0.25", "en"), "0.25"],
  ["a length of LaTeX stays", withDecimalMark("0.5 \\\\[0.3em] 1.5", "de"), "0{,}5 \\\\[0.3em] 1{,}5"],
  ["a letter behind a number is no length", withDecimalMark("0.5e_x + 1.25m", "de"), "0{,}5e_x + 1{,}25m"],
  ["raised exponents in units", unitText("m/s^2"), "m/s²"],
  ["a number without a unit has none", unitText("1"), ""],
  ["a field without a unit is called by its label", withUnit("μ", "1"), "μ"],
  ["one with a unit by both", withUnit("g", "m/s^2"), "g (m/s²)"],
  ["a rate of one has one", unitText("1/s"), "1/s"],
  ["negative exponents in units", unitText("kg*s^-1"), "kg·s⁻¹"],
  ["decimals of a step", decimalsOf(0.05), 2],
  ["decimals of a whole step", decimalsOf(1), 0],
  ["decimals of a tenth", decimalsOf(0.1), 1],
  ["nice number below", niceFloor(0.049), 0.02],
  ["a nice number stays", niceFloor(0.05), 0.05],
];

for (const [name, actual, expected] of CASES) {
  test(`numbers: ${name}`, () => assert.equal(actual, expected));
}

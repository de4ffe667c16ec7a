import { strict as assert } from "node:assert";
import { test } from "node:test";
import { createClock } from "../../frontend/model/clock.js";

function running(end = 1) {
  const clock = createClock();
  clock.setEnd(end);
  clock.play(true);
  return clock;
}

test("time passes only while playing, at the chosen speed", () => {
  const clock = createClock();
  clock.setEnd(10);
  clock.advance(0.05);
  assert.equal(clock.time, 0);
  clock.play(true);
  clock.setSpeed(2);
  clock.advance(0.05);
  assert.equal(clock.time, 0.1);
});

test("it rests at the end, then begins again", () => {
  const clock = running(1);
  clock.seek(0.99);
  clock.advance(0.05);
  assert.equal(clock.time, 1);
  for (let i = 0; i < 20; i += 1) clock.advance(0.05);
  assert.ok(clock.time < 0.5);
});

test("a long pause of the browser is not made up for", () => {
  const clock = running(100);
  clock.advance(30);
  assert.equal(clock.time, 0.1);
});

test("seeking stays between start and end", () => {
  const clock = running(2);
  clock.seek(-1);
  assert.equal(clock.time, 0);
  clock.seek(5);
  assert.equal(clock.time, 2);
});

test("a shorter motion does not leave the time beyond its end", () => {
  const clock = running(10);
  clock.seek(8);
  clock.setEnd(5);
  assert.equal(clock.time, 0);
});

test("without a motion nothing plays", () => {
  const clock = createClock();
  clock.play(true);
  assert.equal(clock.playing, false);
});

test("listeners hear every moment until they leave", () => {
  const clock = running(10);
  /** @type {number[]} */
  const heard = [];
  const leave = clock.subscribe((t) => heard.push(t));
  clock.seek(3);
  leave();
  clock.seek(4);
  assert.deepEqual(heard, [3]);
});

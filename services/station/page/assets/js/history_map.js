// The map of what an entry changed: a square for each place of the target, the larger the farther predictions are moved
// there, hollow where little is known; a ring where the entry was given. Forward is up, left is left.

import { say } from "/assets/js/words.js";

const SVG = "http://www.w3.org/2000/svg";
const SOME_M = 0.005;
const LITTLE = 0.5;
const LARGEST = 0.92; // share of a cell
const SMALLEST = 0.08;

export function mapOf({ field, place }) {
  const { axes, lower, upper, moved, known } = field;
  const [rows, columns] = [moved.length, moved[0].length];
  const most = Math.max(SOME_M, ...moved.flat());
  const map = shape("svg", { viewBox: `0 0 ${columns} ${rows}`, "aria-hidden": "true" });
  moved.forEach((row, i) =>
    row.forEach((by, j) => {
      const side = Math.max(SMALLEST, LARGEST * Math.sqrt(by / most));
      const [x, y] = [columns - j - 0.5, rows - i - 0.5];
      const look = known[i][j] < LITTLE ? "hollow" : "full";
      map.append(shape("rect", { x: x - side / 2, y: y - side / 2, width: side, height: side, class: look }));
    }),
  );
  const [up, left] = axes.map((axis, k) => share(place[axis], lower[k], upper[k]));
  map.append(shape("circle", { cx: columns * (1 - left), cy: rows * (1 - up), r: 0.55, class: "given" }));
  return map;
}

export function summaryOf(effect) {
  if (!effect.field) return say("entry.nothing");
  const moved = effect.field.moved.flat();
  const some = SOME_M * 1e3;
  const most = Math.max(...moved);
  if (most <= SOME_M) return say("entry.same", { some });
  const places = moved.filter((by) => by > SOME_M).length / moved.length;
  const changed = say("entry.changed", { most: Math.round(most * 1e3), some, share: Math.round(places * 100) });
  const isHollow = effect.field.known.flat().some((known) => known < LITTLE);
  return isHollow ? `${changed} ${say("entry.hollow")}` : changed;
}

function share(value, low, high) {
  return high > low ? Math.min(Math.max((value - low) / (high - low), 0), 1) : 0.5;
}

function shape(name, attributes) {
  const element = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  return element;
}

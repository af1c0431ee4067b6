// Boxes that touch, and how far a box is along a line: what the view foresees and measures by.

import { axesOf } from "/assets/js/drawing/turning.js";

// What the scene tells of as boxes, those that can be touched, made ready.
export function solids(boxes) {
  return boxes
    .filter(({ solid }) => solid !== false)
    .map(({ name, centre, half_sizes: half, orientation }) => solidOf(name, centre, half, orientation));
}

export function solidOf(name, centre, half, orientation) {
  return { name, centre, half, axes: axesOf(orientation), radius: Math.hypot(...half) };
}

// Which thing the gripper touches in a pose, and where; null for none.
export function firstTouch({ position, orientation }, gripper, things) {
  const reach = Math.max(...gripper.map(({ centre, half_sizes: half }) => Math.hypot(...centre) + Math.hypot(...half)));
  const within = things.filter((thing) => isWithin(reach, position, thing));
  if (within.length === 0) return null;
  const axes = axesOf(orientation);
  for (const { centre, half_sizes: half } of gripper) {
    const block = { centre: moved(position, axes, centre), half, axes, radius: Math.hypot(...half) };
    const thing = within.find((other) => overlap(block, other));
    if (thing) return { name: thing.name, position: nearest(block, nearest(thing, block.centre)) };
  }
  return null;
}

// Whether a box comes as near as this to a point.
function isWithin(reach, point, { centre, half, axes }) {
  let squared = 0;
  for (let k = 0; k < 3; k += 1) {
    const [x, y, z] = axes[k];
    const along = x * (point[0] - centre[0]) + y * (point[1] - centre[1]) + z * (point[2] - centre[2]);
    const beyond = Math.abs(along) - half[k];
    if (beyond > 0) squared += beyond * beyond;
  }
  return squared <= reach * reach;
}

// Two boxes overlap where none of fifteen directions separates them (Gottschalk, Lin and Manocha, 1996).
export function overlap(one, other) {
  const apart = minus(other.centre, one.centre);
  if (dot(apart, apart) > (one.radius + other.radius) ** 2) return false;
  const turned = one.axes.map((a) => other.axes.map((b) => dot(a, b)));
  const away = one.axes.map((a) => dot(apart, a));
  const size = turned.map((row) => row.map((c) => Math.abs(c) + 1e-9));
  for (let i = 0; i < 3; i += 1) {
    if (Math.abs(away[i]) > one.half[i] + dot(other.half, size[i])) return false;
    const [column, sizes] = [turned.map((row) => row[i]), size.map((row) => row[i])];
    if (Math.abs(dot(away, column)) > other.half[i] + dot(one.half, sizes)) return false;
  }
  for (let i = 0; i < 3; i += 1) {
    const [i1, i2] = [(i + 1) % 3, (i + 2) % 3];
    for (let j = 0; j < 3; j += 1) {
      const [j1, j2] = [(j + 1) % 3, (j + 2) % 3];
      const reach =
        one.half[i1] * size[i2][j] + one.half[i2] * size[i1][j] + other.half[j1] * size[i][j2] + other.half[j2] * size[i][j1];
      if (Math.abs(away[i2] * turned[i1][j] - away[i1] * turned[i2][j]) > reach) return false;
    }
  }
  return true;
}

// How far it is from a point along a direction, of length 1, to the nearest thing, and which way that surface faces;
// null where nothing is within the range. What the point lies in does not count.
export function nearestAlong(origin, direction, things, range) {
  let found = null;
  for (const thing of things) {
    const hit = along(origin, direction, thing);
    if (hit && hit.distance <= (found?.distance ?? range)) found = hit;
  }
  return found;
}

// The slab method: where a ray comes into a box.
function along(origin, direction, { centre, half, axes, name }) {
  const from = minus(origin, centre);
  let [near, far, face] = [-Infinity, Infinity, null];
  for (let k = 0; k < 3; k += 1) {
    const [start, slope] = [dot(from, axes[k]), dot(direction, axes[k])];
    if (Math.abs(slope) < 1e-9) {
      if (Math.abs(start) > half[k]) return null;
      continue;
    }
    const sides = [(-half[k] - start) / slope, (half[k] - start) / slope].sort((a, b) => a - b);
    if (sides[0] > near) [near, face] = [sides[0], axes[k].map((c) => -Math.sign(slope) * c)];
    far = Math.min(far, sides[1]);
  }
  return near >= 0 && near <= far ? { distance: near, normal: face, name } : null;
}

// The point of a box that is nearest to another one.
function nearest({ centre, half, axes }, point) {
  const from = minus(point, centre);
  const inside = axes.map((axis, k) => Math.min(Math.max(dot(from, axis), -half[k]), half[k]));
  return moved(centre, axes, inside);
}

function moved(position, axes, [x, y, z]) {
  return position.map((c, k) => c + x * axes[0][k] + y * axes[1][k] + z * axes[2][k]);
}

function minus(a, b) {
  return [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
}

function dot(a, b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// How the motion goes on where the operator lets go now, and where the gripper would touch something on that way.

import { firstTouch } from "/assets/js/drawing/touching.js";
import { exp, product } from "/assets/js/drawing/turning.js";

const FINEST_M = 0.008; // nothing solid is thinner than this together with a finger

// The rest of a motion by the law of the correction (equations 15 to 17) without a hand: o(t) = o exp(-t / L).
// curve: points and orientations at equal shares; progress: from 0 to 1; fading: look-aheads in the whole motion, 0 for
// a correction that is gone at once. Gives positions, orientations (none where the curve has none) and shares.
export function released({ points, orientations = [] }, { progress, offset, turn, fading }) {
  const last = points.length - 1;
  const from = Math.min(Math.max(progress, 0), 1) * last;
  const places = [from, ...points.keys()].filter((place, i) => i === 0 || place > from);
  const rest = { positions: [], orientations: [], shares: [] };
  for (const place of places) {
    const kept = keptOf((place - from) / last, fading);
    rest.shares.push(place / last);
    rest.positions.push(between(points, place).map((c, k) => c + kept * offset[k]));
    if (orientations.length === 0) continue;
    const turned = exp(turn.map((angle) => kept * angle));
    rest.orientations.push(product(turned, unit(between(orientations, place))));
  }
  return rest;
}

// The first touch on the way: its share of the motion, its position and the thing's name; null where there is none.
export function foreseen({ positions, orientations, shares }, gripper, things) {
  if (orientations.length === 0 || gripper.length === 0) return null;
  for (let i = 0; i < positions.length; i += 1) {
    const before = Math.max(i - 1, 0);
    const steps = Math.max(1, Math.ceil(distance(positions[before], positions[i]) / FINEST_M));
    for (let step = i === 0 ? steps : 1; step <= steps; step += 1) {
      const at = before + (i - before) * (step / steps);
      const pose = { position: between(positions, at), orientation: unit(between(orientations, at)) };
      const touch = firstTouch(pose, gripper, things);
      if (touch) return { share: between(shares.map((share) => [share]), at)[0], ...touch };
    }
  }
  return null;
}

function keptOf(share, fading) {
  if (fading > 0) return Math.exp(-fading * share);
  return share === 0 ? 1 : 0;
}

// Between the rows of a list, linearly; the orientations of neighbours are near enough to each other for it.
function between(rows, place) {
  const before = Math.min(Math.floor(place), rows.length - 1);
  const after = Math.min(before + 1, rows.length - 1);
  const share = place - before;
  return rows[before].map((value, k) => value + share * (rows[after][k] - value));
}

function unit(quaternion) {
  const length = Math.hypot(...quaternion) || 1;
  return quaternion.map((c) => c / length);
}

function distance(a, b) {
  return Math.hypot(...a.map((c, k) => c - b[k]));
}

// What comes where the operator lets go now: the way, dashed, and where the gripper would touch something on it.

import { Group, Vector3 } from "/assets/js/drawing/three.js";
import { Dashes } from "/assets/js/drawing/dashes.js";
import { foreseen, released } from "/assets/js/drawing/foresight.js";
import { Sign } from "/assets/js/drawing/signs.js";

const EVERY_MS = 100;
const LEAST_M = 0.002;
const LEAST_RAD = 0.02;
const STANDING = { progress: 0, offset: [0, 0, 0], turn: [0, 0, 0], fading: 1 };

export class Ahead {
  // onForeseen: told the touch that is foreseen, null for none, and how long that took [ms]; onDue: asks to be moved
  // again, since what came last was not reckoned with.
  constructor(labels, gripper, { onForeseen, onDue }) {
    Object.assign(this, { labels, gripper, onForeseen, onDue, things: [], curve: null, going: null, dueAt: 0 });
    this.root = new Group();
    this.way = new Dashes("refined");
    this.sign = new Sign("foreseen", "caution");
    this.root.add(this.way.root, this.sign.root);
  }

  furnish(things) {
    this.things = things;
    this.dueAt = 0;
  }

  predict(curve) {
    this.curve = curve;
    this.dueAt = 0;
  }

  go(going) {
    this.going = going;
    this.dueAt = 0;
  }

  // Offset, turn and progress as they are now. Reckoned a few times a second, which is as often as one sees it; whether
  // it was.
  move({ progress, offset, turn }) {
    const now = performance.now();
    clearTimeout(this.later);
    if (now < this.dueAt) {
      this.later = setTimeout(this.onDue, this.dueAt - now);
      return false;
    }
    this.dueAt = now + EVERY_MS;
    if (!this.curve || this.curve.points.length < 2) {
      this.show(null, null);
      this.onForeseen(null, 0);
      return true;
    }
    const isKnown = this.going && [progress, ...offset, ...turn].every(Number.isFinite);
    const rest = released(this.curve, isKnown ? { progress, offset, turn, fading: this.going.fading } : STANDING);
    const touch = foreseen(rest, this.gripper, this.things);
    const differs = Math.hypot(...offset) > LEAST_M || Math.hypot(...turn) > LEAST_RAD;
    this.show(isKnown && this.going.corrected && differs ? rest.positions : null, touch);
    this.onForeseen(touch, performance.now() - now);
    return true;
  }

  show(way, touch) {
    if (way) this.way.show(way);
    else this.way.hide();
    this.touch = touch;
    this.sign.root.visible = touch !== null;
    if (touch) this.sign.root.position.fromArray(touch.position);
  }

  label(camera) {
    const { touch } = this;
    this.labels.put("foreseen", touch && new Vector3().fromArray(touch.position), touch ? nameOf(touch.name) : "", camera);
  }
}

// A thing's name as a person reads it.
function nameOf(name) {
  return name.replaceAll("_", " ");
}

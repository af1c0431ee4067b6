// The depth cue: the gripper projected onto the nearest surface below it and ahead of it, with the distance.

import { Group, Mesh, MeshBasicMaterial, Quaternion, RingGeometry, Vector3 } from "/assets/js/drawing/three.js";
import { Dashes } from "/assets/js/drawing/dashes.js";
import { lengthOf } from "/assets/js/drawing/labels.js";
import { colourOf } from "/assets/js/drawing/paint.js";
import { nearestAlong, solidOf } from "/assets/js/drawing/touching.js";
import { axesOf } from "/assets/js/drawing/turning.js";

const RANGES = { below: 2, ahead: 0.5 }; // [m]
const FLOOR = solidOf("floor", [0, 0, -0.05], [10, 10, 0.05], [1, 0, 0, 0]);
const OFF_M = 0.002; // above the surface, to be seen
const FACING = new Vector3(0, 0, 1);

export class Depth {
  constructor(labels) {
    this.labels = labels;
    this.root = new Group();
    this.views = Object.fromEntries(Object.keys(RANGES).map((name) => [name, new Projection(this.root)]));
    this.things = [FLOOR];
    this.object = [];
  }

  furnish(things) {
    this.things = [FLOOR, ...things];
  }

  see(pose, size) {
    const isThere = pose.isKnown && size.every((edge) => edge > 0);
    this.object = isThere ? [solidOf("object", [...pose.position], size.map((edge) => edge / 2), [...pose.orientation])] : [];
  }

  // The gripper points along its own x axis.
  move(pose) {
    const directions = pose.isKnown ? { below: [0, 0, -1], ahead: axesOf(pose.orientation)[0] } : {};
    for (const [name, view] of Object.entries(this.views)) {
      const direction = directions[name];
      const origin = [...pose.position];
      const hit = direction && nearestAlong(origin, direction, [...this.things, ...this.object], RANGES[name]);
      view.show(origin, direction, hit ?? null);
    }
  }

  label(camera) {
    for (const [name, { end, distance }] of Object.entries(this.views)) {
      this.labels.put(name, end, end ? lengthOf(distance) : "", camera);
    }
  }
}

class Projection {
  constructor(root) {
    this.end = null;
    this.line = new Dashes("ink", { dash: 0.008, gap: 0.008, radius: 0.0012 });
    this.ring = new Mesh(
      new RingGeometry(0.016, 0.02, 32),
      new MeshBasicMaterial({ color: colourOf("ink"), transparent: true, opacity: 0.9, side: 2 }),
    );
    root.add(this.line.root, this.ring);
    this.ring.visible = false;
  }

  show(origin, direction, hit) {
    this.ring.visible = hit !== null;
    this.end = null;
    if (hit === null) return this.line.hide();
    this.distance = hit.distance;
    this.end = new Vector3().fromArray(origin).addScaledVector(new Vector3().fromArray(direction), hit.distance);
    const normal = new Vector3().fromArray(hit.normal);
    this.ring.position.copy(this.end).addScaledVector(normal, OFF_M);
    this.ring.quaternion.copy(new Quaternion().setFromUnitVectors(FACING, normal));
    return this.line.show([origin, this.end.toArray()]);
  }
}

// Signs at the gripper: which way is which, how far it is corrected, what the operator feels, and what is judged.

import {
  ConeGeometry,
  CylinderGeometry,
  Group,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  SphereGeometry,
  Sprite,
  SpriteMaterial,
  CanvasTexture,
  Vector3,
  WireframeGeometry,
} from "/assets/js/drawing/three.js";
import { colourOf, plain } from "/assets/js/drawing/paint.js";
import { place } from "/assets/js/drawing/robot.js";
import { Sign } from "/assets/js/drawing/signs.js";

const AXES = ["x", "y", "z"];
const AXIS_M = 0.13;
const FORCE_SCALE = 0.03; // [m/N]
const LEAST_FORCE_N = 0.05;
const LEAST_CORRECTION_M = 0.002;
const LETTER = 0.045; // share of the view's height

export class Marks {
  constructor() {
    this.root = new Group();
    this.axes = new Group();
    AXES.forEach((axis, k) => this.axes.add(...axisOf(axis, k)));
    this.correction = new Arrow("refined", 0.004);
    this.force = new Arrow("force", 0.006);
    this.reach = new LineSegments(
      new WireframeGeometry(new SphereGeometry(1, 16, 8)),
      new LineBasicMaterial({ transparent: true, opacity: 0.45 }),
    );
    this.touch = new Sign("touched", "stop");
    this.reached = new Sign("reached", "go");
    this.root.add(this.axes, this.correction.root, this.force.root, this.reach, this.touch.root, this.reached.root);
    for (const mark of [this.axes, this.reach]) mark.visible = false;
  }

  judge({ radii, reached, collision }) {
    this.isJudged = radii.every((radius) => radius > 0);
    if (this.isJudged) this.reach.scale.fromArray(radii);
    this.reach.material.color.copy(colourOf(reached ? "go" : "quiet"));
    this.isReached = reached;
    this.touch.root.visible = collision !== null;
    if (collision !== null) this.touch.root.position.fromArray(collision);
  }

  // To the left, as the axes of the device are that the hand is on [rad].
  turn(yaw) {
    this.axes.rotation.z = yaw;
  }

  // The axes are those along which the keys push, wherever the gripper is turned: the base's, or turned as the view is.
  move(pose, offset, force) {
    this.axes.visible = pose.isKnown;
    this.reach.visible = pose.isKnown && Boolean(this.isJudged);
    this.reached.root.visible = this.reach.visible && Boolean(this.isReached);
    if (!pose.isKnown) {
      this.correction.hide();
      this.force.hide();
      return;
    }
    const grasp = new Vector3().fromArray(pose.position);
    this.axes.position.copy(grasp);
    this.reached.root.position.copy(grasp);
    if (this.reach.visible) place(this.reach, pose);
    const corrected = new Vector3().fromArray(offset);
    this.correction.show(grasp.clone().sub(corrected), corrected, LEAST_CORRECTION_M);
    this.force.show(grasp, new Vector3().fromArray(force).multiplyScalar(FORCE_SCALE), LEAST_FORCE_N * FORCE_SCALE);
  }
}

class Arrow {
  constructor(colour, radius) {
    this.radius = radius;
    this.root = new Group();
    this.shaft = new Mesh(new CylinderGeometry(radius, radius, 1, 10), plain(colour));
    this.head = new Mesh(new ConeGeometry(2.2 * radius, 5 * radius, 14), plain(colour));
    this.root.add(this.shaft, this.head);
    this.hide();
  }

  hide() {
    this.root.visible = false;
  }

  show(origin, vector, least) {
    const length = vector.length();
    this.root.visible = length > least;
    if (!this.root.visible) return;
    const shaft = Math.max(length - 5 * this.radius, 1e-4);
    this.root.position.copy(origin);
    this.root.quaternion.setFromUnitVectors(new Vector3(0, 1, 0), vector.clone().divideScalar(length));
    this.shaft.scale.y = shaft;
    this.shaft.position.y = shaft / 2;
    this.head.position.y = shaft + 2.5 * this.radius;
  }
}

function axisOf(axis, k) {
  const direction = new Vector3().setComponent(k, 1);
  const arrow = new Arrow(`axis-${axis}`, 0.003);
  arrow.show(new Vector3(), direction.clone().multiplyScalar(AXIS_M), 0);
  const letter = letterOf(axis, colourOf(`axis-${axis}`));
  letter.position.copy(direction).multiplyScalar(AXIS_M + 0.02);
  return [arrow.root, letter];
}

// Words that stay as large however far one looks from.
export function letterOf(text, colour) {
  const canvas = Object.assign(document.createElement("canvas"), { width: 64, height: 64 });
  const pen = canvas.getContext("2d");
  Object.assign(pen, { font: `bold ${text.length > 1 ? 40 : 52}px sans-serif`, textAlign: "center", textBaseline: "middle" });
  Object.assign(pen, { fillStyle: `#${colour.getHexString()}`, strokeStyle: `#${colourOf("ground").getHexString()}`, lineWidth: 8 });
  pen.strokeText(text, 32, 32);
  pen.fillText(text, 32, 32);
  const map = new CanvasTexture(canvas);
  const sprite = new Sprite(new SpriteMaterial({ map, sizeAttenuation: false, depthTest: false, depthWrite: false }));
  sprite.scale.setScalar(LETTER);
  sprite.renderOrder = 1;
  return sprite;
}

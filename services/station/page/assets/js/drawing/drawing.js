// The scene on the canvas: drawn anew when something has changed, and never faster than this computer can.

import {
  DirectionalLight,
  HemisphereLight,
  OrbitControls,
  PerspectiveCamera,
  Scene,
  Vector3,
  WebGLRenderer,
} from "/assets/js/drawing/three.js";
import { Ahead } from "/assets/js/drawing/ahead.js";
import { Cloud } from "/assets/js/drawing/cloud.js";
import { Depth } from "/assets/js/drawing/depth.js";
import { Labels } from "/assets/js/drawing/labels.js";
import { Comparison } from "/assets/js/drawing/comparison.js";
import { Limits } from "/assets/js/drawing/limits.js";
import { Marks } from "/assets/js/drawing/marks.js";
import { Motions } from "/assets/js/drawing/motions.js";
import { Cadence } from "/assets/js/drawing/cadence.js";
import { colourOf } from "/assets/js/drawing/paint.js";
import { Robot } from "/assets/js/drawing/robot.js";
import { Surroundings } from "/assets/js/drawing/surroundings.js";
import { solids } from "/assets/js/drawing/touching.js";
import { Waypoints } from "/assets/js/drawing/waypoints.js";

const FIELD_OF_VIEW = 48;
const POLL_MS = 3;
const STILL_MS = 300; // what has not changed for so long is drawn once more, as fine as the screen
const DENSEST = 2;
const STEP = Math.PI / 24; // that a key turns the view by
const [LEVEL, STEEP] = [0.05, Math.PI - 0.05]; // from straight above, to straight below

export class Drawing {
  // onDrawn: told which moment is the newest on the screen; onForeseen: see Ahead.
  constructor(canvas, { context, isSlow }, description, shapes, { onDrawn, onForeseen }) {
    Object.assign(this, { canvas, context, isSlow, onDrawn, eye: description.eye });
    this.renderer = new WebGLRenderer({ canvas, context });
    // Each answer is waited for, and the keys with it; there is no shader here but the library's own.
    this.renderer.debug.checkShaderErrors = false;
    this.cadence = new Cadence();
    this.scene = new Scene();
    this.camera = new PerspectiveCamera(FIELD_OF_VIEW, 1, 0.05, 30);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, canvas);
    Object.assign(this.controls, { minDistance: 0.1, maxDistance: 8 });
    this.controls.addEventListener("change", () => this.wish());
    this.robot = new Robot(description, shapes);
    this.surroundings = new Surroundings();
    this.cloud = new Cloud();
    this.limits = new Limits();
    this.motions = new Motions();
    this.comparison = new Comparison();
    this.marks = new Marks();
    this.labels = new Labels(canvas);
    this.depth = new Depth(this.labels);
    const onDue = () => this.foresee(this.newest);
    this.ahead = new Ahead(this.labels, description.gripper, { onForeseen, onDue });
    this.waypoints = new Waypoints();
    const signs = [this.motions, this.comparison, this.marks, this.depth, this.ahead, this.waypoints];
    this.drawn = [this.surroundings, this.robot, this.cloud, this.limits, ...signs];
    this.scene.background = colourOf("ground");
    this.scene.add(...lights(), ...this.drawn.map(({ root }) => root));
    this.moment = {};
    this.isReady = false;
    this.look();
    new ResizeObserver(() => this.fit()).observe(canvas);
  }

  // Makes ready what draws, beside all else and bit by bit; in one go it would hold up the keys until it is done.
  async prepare() {
    await this.renderer.compileAsync(this.scene, this.camera);
    for (const program of this.renderer.info.programs) {
      program.getUniforms();
      await soon();
    }
    this.isReady = true;
    this.wish();
  }

  // From where the operator looks at first.
  look() {
    const [position, target] = this.eye;
    this.camera.position.fromArray(position);
    this.controls.target.fromArray(target);
    this.controls.update();
    this.wish();
  }

  // By key: so many steps round the target and over it, and as much closer.
  turn([round, over], closer) {
    const offset = this.camera.position.clone().sub(this.controls.target).multiplyScalar(closer);
    const side = offset.clone().cross(this.camera.up).normalize();
    const tilt = Math.max(LEVEL, Math.min(STEEP, offset.angleTo(this.camera.up) - over * STEP));
    offset.applyAxisAngle(side, offset.angleTo(this.camera.up) - tilt).applyAxisAngle(this.camera.up, round * STEP);
    this.camera.position.copy(this.controls.target).add(offset);
    this.controls.update();
    this.wish();
  }

  // Which way one looks, to the left of the base's x axis [rad]; straight down it is the screen's up.
  get yaw() {
    const [, , , , upX, upY, , , backX, backY, backZ] = this.camera.matrixWorld.elements;
    return Math.atan2(backZ * upY - backY, backZ * upX - backX);
  }

  show({ boxes, size, prediction, going, way, criteria, kick, waypoints, yaw }) {
    if (boxes !== undefined) this.furnish(boxes);
    if (size !== undefined) this.surroundings.size((this.size = size));
    if (prediction !== undefined) this.motions.predict(prediction);
    if (prediction !== undefined) this.ahead.predict(prediction);
    if (going !== undefined) this.ahead.go(going);
    if (way !== undefined) this.motions.travel(way);
    if (criteria !== undefined) this.marks.judge(criteria);
    if (kick !== undefined) this.limits.show(kick);
    if (yaw !== undefined) this.marks.turn(yaw);
    if (waypoints !== undefined) this.waypoints.show(waypoints);
    if (this.last) this.move(this.last);
    if (this.newest) this.foresee(this.newest);
    this.wish();
  }

  mark(part) {
    this.motions.mark(part);
    this.wish();
  }

  furnish(boxes) {
    const things = solids(boxes);
    this.surroundings.furnish(boxes);
    this.depth.furnish(things);
    this.ahead.furnish(things);
  }

  compare(effect) {
    this.comparison.show(effect);
    this.wish();
  }

  receiveCloud(buffer, offset, shown) {
    this.cloud.show(buffer, offset);
    this.clouded = shown;
    this.wish();
  }

  hideCloud() {
    this.cloud.hide();
    this.wish();
  }

  receive(moment) {
    this.moment = moment;
    this.newest = moment.values;
    this.foresee(this.newest);
    this.wish();
  }

  // As often as it is told where the robot is, however seldom a picture is drawn.
  foresee(values) {
    const [offset, turn, progress] = [values.subarray(14, 17), values.subarray(17, 20), values[20]];
    if (this.ahead.move({ progress, offset: [...offset], turn: [...turn] })) this.wish();
  }

  wish() {
    this.wished = true;
    clearTimeout(this.still);
    if (!this.isReady || this.waits || this.isDrawing) return;
    this.waits = true;
    setTimeout(() => requestAnimationFrame(() => this.draw()), this.cadence.wait(performance.now()));
  }

  draw(fineness = this.cadence.fineness) {
    this.waits = this.wished = false;
    this.isDrawing = true;
    this.refine(fineness);
    const { clouded, moment } = this;
    const { shown, values } = moment;
    if (values) this.move(values);
    this.moment = { shown };
    this.cadence.begin(performance.now());
    this.renderer.render(this.scene, this.camera);
    this.depth.label(this.camera);
    this.ahead.label(this.camera);
    const { context } = this;
    const fence = context.fenceSync(context.SYNC_GPU_COMMANDS_COMPLETE, 0);
    context.flush();
    setTimeout(() => this.watch(fence, shown, clouded), POLL_MS);
  }

  // Asked now and then instead of waited for: nothing holds up the keys.
  watch(fence, shown, clouded) {
    const { context } = this;
    if (fence && context.clientWaitSync(fence, 0, 0) === context.TIMEOUT_EXPIRED) {
      setTimeout(() => this.watch(fence, shown, clouded), POLL_MS);
      return;
    }
    context.deleteSync(fence);
    this.isDrawing = false;
    this.onDrawn(shown, clouded);
    this.cadence.done(performance.now());
    if (this.wished) this.wish();
    else if (this.fineness < 1) this.still = setTimeout(() => this.draw(1), STILL_MS);
  }

  move(values) {
    this.last = values;
    const [grasp, object] = [poseOf(values, 0), poseOf(values, 7)];
    this.surroundings.see(object);
    this.marks.move(grasp, values.subarray(14, 17), values.subarray(21, 24));
    this.depth.see(object, this.size ?? [0, 0, 0]);
    this.depth.move(grasp);
    if (grasp.isKnown) this.robot.follow(new Vector3().fromArray(grasp.position));
    this.robot.move(values.subarray(24));
  }

  // The share of the screen's pixels along each side that is drawn.
  refine(fineness) {
    if (this.fineness === fineness) return;
    this.fineness = fineness;
    this.renderer.setPixelRatio(fineness * (this.isSlow ? 1 : Math.min(devicePixelRatio, DENSEST)));
  }

  fit() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (!width || !height) return;
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    if (!this.isReady) return;
    this.renderer.render(this.scene, this.camera); // another size has emptied the canvas: it is not left black
    this.wish();
  }
}

function poseOf(values, first) {
  const [position, orientation] = [values.subarray(first, first + 3), values.subarray(first + 3, first + 7)];
  return { position, orientation, isKnown: Number.isFinite(position[0]) };
}

// When all else that waits has had its turn.
function soon() {
  return new Promise((done) => setTimeout(done));
}

function lights() {
  const sun = new DirectionalLight(0xffffff, 1.9);
  sun.position.set(-1, -2, 4);
  return [new HemisphereLight(0xffffff, 0x3a4250, 1.7), sun];
}

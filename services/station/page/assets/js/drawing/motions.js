// The motion that is predicted, in the tube in which it probably lies, or the one that an operator has shown already and
// that is to be followed; and the way that it has led so far.

import { BufferAttribute, BufferGeometry, DoubleSide, Group, Mesh } from "/assets/js/drawing/three.js";
import { colourOf, plain } from "/assets/js/drawing/paint.js";
import { Sign } from "/assets/js/drawing/signs.js";
import { ball, ellipsoid, sweep } from "/assets/js/drawing/sweep.js";

const PREDICTED_M = 0.0035;
const REFINED_M = 0.0045;
const THINNEST_M = 0.001;
const LINE_SIDES = 6;
const MODEL = "model"; // where a prediction comes from; all else was shown
const TUBE_SIDES = 12;

export class Motions {
  constructor() {
    this.root = new Group();
    this.predicted = tube("predicted");
    this.spread = tube("predicted", 0.22);
    this.spread.material.side = DoubleSide;
    this.way = tube("refined");
    this.marks = [new Sign("first", "refined"), new Sign("last", "refined")];
    this.points = [];
    this.part = null;
    this.root.add(this.predicted, this.way, this.spread, ...this.marks.map(({ root }) => root));
  }

  predict(prediction) {
    const { points = [], spread = [], origin = MODEL } = prediction ?? {};
    this.predicted.material.color.copy(colourOf(origin === MODEL ? "predicted" : "refined"));
    this.points = points;
    this.mark(this.part);
    fill(this.predicted, sweep(points, (_, direction) => ball(PREDICTED_M, direction), LINE_SIDES));
    const half = spread.map((deviations) => deviations.map((deviation) => Math.max(deviation, THINNEST_M)));
    const reach = (i, direction) => ellipsoid(half[i], direction);
    fill(this.spread, spread.length === 0 ? sweep([]) : sweep(points, reach, TUBE_SIDES));
  }

  // Where the part that is corrected begins and ends, as shares of the motion; null for all of it.
  mark(part) {
    this.part = part;
    this.marks.forEach(({ root }, i) => {
      root.visible = part !== null && this.points.length > 1;
      if (root.visible) root.position.fromArray(this.points[Math.round(part[i] * (this.points.length - 1))]);
    });
  }

  travel(way) {
    fill(this.way, sweep(way, (_, direction) => ball(REFINED_M, direction), LINE_SIDES));
  }
}

function tube(colour, opacity) {
  const mesh = new Mesh(new BufferGeometry(), plain(colour, opacity));
  mesh.visible = false;
  mesh.frustumCulled = false;
  return mesh;
}

function fill(mesh, { positions, triangles }) {
  mesh.geometry.dispose();
  mesh.geometry = new BufferGeometry();
  mesh.geometry.setAttribute("position", new BufferAttribute(new Float32Array(positions), 3));
  mesh.geometry.setIndex(triangles);
  mesh.visible = triangles.length > 0;
}

// What an entry of the history changes: the motion with it as a line, without it dashed, where its object stood.

import { BufferAttribute, BufferGeometry, Group, Mesh, SphereGeometry } from "/assets/js/drawing/three.js";
import { plain } from "/assets/js/drawing/paint.js";
import { ball, sweep } from "/assets/js/drawing/sweep.js";

const RADIUS_M = 0.005;
const PLACE_M = 0.016;
const SIDES = 6;
const DASH = 3; // points on, as many off

export class Comparison {
  constructor() {
    this.root = new Group();
    this.withIt = new Mesh(new BufferGeometry(), plain("compared"));
    this.withoutIt = new Mesh(new BufferGeometry(), plain("compared"));
    this.place = new Mesh(new SphereGeometry(PLACE_M, 16, 10), plain("compared", 0.5));
    this.root.add(this.withIt, this.withoutIt, this.place);
    for (const line of [this.withIt, this.withoutIt]) line.frustumCulled = false;
    this.show(null);
  }

  show(effect) {
    this.root.visible = Boolean(effect);
    if (!effect) return;
    fill(this.withIt, [effect.with_it]);
    fill(this.withoutIt, dashes(effect.without_it));
    this.place.position.fromArray(effect.place);
  }
}

function dashes(points) {
  const found = [];
  for (let first = 0; first < points.length - 1; first += 2 * DASH) found.push(points.slice(first, first + DASH + 1));
  return found;
}

function fill(mesh, lines) {
  const [positions, triangles] = [[], []];
  for (const line of lines) {
    const tube = sweep(line, (_, direction) => ball(RADIUS_M, direction), SIDES);
    const before = positions.length / 3;
    positions.push(...tube.positions);
    triangles.push(...tube.triangles.map((corner) => before + corner));
  }
  mesh.geometry.dispose();
  mesh.geometry = new BufferGeometry();
  mesh.geometry.setAttribute("position", new BufferAttribute(new Float32Array(positions), 3));
  mesh.geometry.setIndex(triangles);
  mesh.visible = triangles.length > 0;
}

// The waypoints that are stored, by their numbers.

import { Group, Mesh, SphereGeometry } from "/assets/js/drawing/three.js";
import { letterOf } from "/assets/js/drawing/marks.js";
import { colourOf, plain } from "/assets/js/drawing/paint.js";

const RADIUS_M = 0.009;
const ABOVE_M = 0.035;

export class Waypoints {
  constructor() {
    this.root = new Group();
    this.ball = new SphereGeometry(RADIUS_M, 16, 12);
    this.material = plain("refined");
  }

  show(places) {
    for (const { material } of this.root.children.filter(({ isSprite }) => isSprite)) {
      material.map.dispose();
      material.dispose();
    }
    this.root.clear();
    places.forEach((place, i) => this.root.add(...this.signOf(place, String(i + 1))));
  }

  signOf([x, y, z], number) {
    const ball = new Mesh(this.ball, this.material);
    ball.position.set(x, y, z);
    const letter = letterOf(number, colourOf("refined"));
    letter.position.set(x, y, z + ABOVE_M);
    return [ball, letter];
  }
}

// What stands around the robot, and the object where it is seen.

import { BoxGeometry, GridHelper, Group, Mesh } from "/assets/js/drawing/three.js";
import { colourOf, plain, solid } from "/assets/js/drawing/paint.js";
import { place } from "/assets/js/drawing/robot.js";

const FLOOR_M = 6;
const TILE_M = 0.5;

export class Surroundings {
  constructor() {
    this.root = new Group();
    this.cube = new BoxGeometry(1, 1, 1);
    this.boxes = new Group();
    this.object = new Mesh(this.cube, plain("seen"));
    this.object.visible = false;
    const floor = new GridHelper(FLOOR_M, FLOOR_M / TILE_M, colourOf("line"), colourOf("line"));
    floor.rotation.x = Math.PI / 2;
    this.root.add(floor, this.boxes, this.object);
  }

  furnish(boxes) {
    for (const { material } of this.boxes.children) material.dispose();
    this.boxes.clear();
    for (const box of boxes) {
      const mesh = new Mesh(this.cube, solid(box.rgba));
      place(mesh, { position: box.centre, orientation: box.orientation });
      mesh.scale.fromArray(box.half_sizes.map((half) => Math.max(2 * half, 1e-4)));
      this.boxes.add(mesh);
    }
  }

  size(edges) {
    this.isThere = edges.every((edge) => edge > 0);
    if (this.isThere) this.object.scale.fromArray(edges);
  }

  see(pose) {
    this.object.visible = Boolean(this.isThere) && pose.isKnown;
    if (this.object.visible) place(this.object, pose);
  }
}

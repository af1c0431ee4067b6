// How far the object may be moved before it counts as kicked over: a box round the place where it stood.

import { BoxGeometry, EdgesGeometry, LineBasicMaterial, LineSegments } from "/assets/js/drawing/three.js";
import { colourOf } from "/assets/js/drawing/paint.js";

export class Limits {
  constructor() {
    this.root = new LineSegments(new EdgesGeometry(new BoxGeometry(2, 2, 2)), new LineBasicMaterial());
    this.root.visible = false;
  }

  // stood: where its centre was, null where that is not known; limits: how far along each axis it may come from there.
  show({ stood, limits, kicked }) {
    this.root.visible = stood !== null && limits.every((limit) => limit > 0);
    if (!this.root.visible) return;
    this.root.position.fromArray(stood);
    this.root.scale.fromArray(limits);
    this.root.material.color.copy(colourOf(kicked ? "stop" : "quiet"));
  }
}

// What the head camera sees, as points.

import { BufferAttribute, BufferGeometry, Points, PointsMaterial } from "/assets/js/drawing/three.js";

const MILLIMETRE = 0.001;
const POINT_BYTES = 9; // three coordinates of two bytes, three colours of one
const PIXELS = 2;

// Pictures come in the screen's colours, the library mixes light.
const LIGHT = Uint8Array.from({ length: 256 }, (_, value) => Math.round(255 * (value / 255) ** 2.2));

export class Cloud {
  constructor() {
    const material = new PointsMaterial({ size: PIXELS, sizeAttenuation: false, vertexColors: true });
    this.root = new Points(new BufferGeometry(), material);
    this.root.scale.setScalar(MILLIMETRE);
    this.root.frustumCulled = false;
    this.hide();
  }

  hide() {
    this.root.visible = false;
  }

  // The points' coordinates, then their colours; their number follows from the length.
  show(buffer, offset) {
    const count = Math.floor((buffer.byteLength - offset) / POINT_BYTES);
    const colours = new Uint8Array(buffer, offset + 6 * count, 3 * count);
    this.root.geometry.dispose();
    this.root.geometry = new BufferGeometry();
    this.root.geometry.setAttribute("position", new BufferAttribute(new Int16Array(buffer, offset, 3 * count), 3));
    this.root.geometry.setAttribute("color", new BufferAttribute(colours.map((value) => LIGHT[value]), 3, true));
    this.root.visible = count > 0;
  }
}

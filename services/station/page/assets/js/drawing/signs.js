// Signs that are told apart by their shapes, too: a cross where something was touched, a ring where it would be,
// brackets round the part that is corrected.

import { CanvasTexture, Group, Sprite, SpriteMaterial } from "/assets/js/drawing/three.js";
import { colourOf } from "/assets/js/drawing/paint.js";

const SIZE = 64;
const SHARE = 0.05; // of the view's height

const SHAPES = {
  touched: (pen) => {
    pen.moveTo(16, 16);
    pen.lineTo(48, 48);
    pen.moveTo(48, 16);
    pen.lineTo(16, 48);
  },
  foreseen: (pen) => {
    pen.arc(32, 32, 20, 0, 2 * Math.PI);
    pen.moveTo(32, 22);
    pen.lineTo(32, 34);
    pen.moveTo(32, 41);
    pen.lineTo(32, 42);
  },
  first: (pen) => bracket(pen, 40, 26),
  last: (pen) => bracket(pen, 24, 38),
  reached: (pen) => {
    pen.moveTo(14, 34);
    pen.lineTo(27, 47);
    pen.lineTo(50, 18);
  },
};

function bracket(pen, open, closed) {
  pen.moveTo(open, 14);
  pen.lineTo(closed, 14);
  pen.lineTo(closed, 50);
  pen.lineTo(open, 50);
}

export class Sign {
  constructor(shape, colour) {
    this.root = new Group();
    const map = new CanvasTexture(drawn(shape, colour));
    const sprite = new Sprite(new SpriteMaterial({ map, sizeAttenuation: false, depthTest: false, depthWrite: false }));
    sprite.scale.setScalar(SHARE);
    sprite.renderOrder = 2;
    this.root.add(sprite);
    this.root.visible = false;
  }
}

function drawn(shape, colour) {
  const canvas = Object.assign(document.createElement("canvas"), { width: SIZE, height: SIZE });
  const pen = canvas.getContext("2d");
  Object.assign(pen, { lineCap: "round", lineJoin: "round" });
  for (const [width, name] of [
    [16, "ground"],
    [9, colour],
  ]) {
    pen.beginPath();
    SHAPES[shape](pen);
    Object.assign(pen, { lineWidth: width, strokeStyle: `#${colourOf(name).getHexString()}` });
    pen.stroke();
  }
  return canvas;
}

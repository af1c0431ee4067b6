// The cameras' pictures onto their canvases, with the age that they have now.

import { say } from "/assets/js/words.js";

const CAMERAS = ["head", "wrist"];
const HEADER_BYTES = 12;
const STALE_S = 1;

export class Pictures {
  constructor() {
    this.drawn = [0, 0];
    this.captured = [-Infinity, -Infinity];
    this.age = null;
  }

  // A new connection counts its pictures anew; those still being decoded count for the old one.
  restart() {
    this.drawn = [0, 0];
    this.age = null;
  }

  // way: how long it was under way to here [ms]; its age when it left the station stands in it.
  async receive(buffer, way) {
    const drawn = this.drawn;
    const header = new DataView(buffer, 0, HEADER_BYTES);
    const camera = header.getUint8(0);
    const number = header.getUint32(4, true);
    const captured = performance.now() - way - header.getFloat32(8, true) * 1000;
    try {
      const bitmap = await createImageBitmap(new Blob([new Uint8Array(buffer, HEADER_BYTES)], { type: "image/jpeg" }));
      if (drawn === this.drawn && number > drawn[camera]) this.draw(camera, bitmap, captured);
      bitmap.close();
    } catch {
      // What is no picture is not drawn; the age tells that none came.
    }
    drawn[camera] = Math.max(drawn[camera], number);
  }

  draw(camera, bitmap, captured) {
    const canvas = panelOf(camera).querySelector("canvas");
    if (canvas.width !== bitmap.width || canvas.height !== bitmap.height) {
      canvas.width = bitmap.width;
      canvas.height = bitmap.height;
    }
    canvas.getContext("2d").drawImage(bitmap, 0, 0);
    this.captured[camera] = captured;
    this.age = Math.max(0, performance.now() - captured); // of the newest when it had been drawn [ms]
    canvas.dataset.ageMs = this.age.toFixed(1); // for whoever measures
  }

  showAges() {
    for (let camera = 0; camera < CAMERAS.length; camera += 1) {
      const age = (performance.now() - this.captured[camera]) / 1000;
      if (!Number.isFinite(age)) continue;
      const panel = panelOf(camera);
      panel.dataset.state = age > STALE_S ? "stale" : "live";
      panel.querySelector(".camera-age").textContent = ageInWords(age);
    }
  }
}

function ageInWords(age) {
  return age < 0.9995
    ? say("script.age", { number: Math.round(age * 1000) })
    : say("script.age_old", { number: age.toFixed(1) });
}

function panelOf(camera) {
  return document.querySelector(`[data-camera="${CAMERAS[camera]}"]`);
}

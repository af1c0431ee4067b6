// The cameras' pictures onto their canvases, with the age that they have now.

import { Video, drawsVideo } from "/assets/js/video.js";
import { say } from "/assets/js/words.js";

const FIRST_CAMERA = 2; // what a frame with its picture begins with; the others follow in their order on the page
const HEADER_BYTES = 12;
const STALE_S = 1;
const JPEG = 0;
const FROM_KEY = 2; // as the station's link says how a picture is coded
const MOST_FAILED = 3; // key pictures one after another: a decoder that should decode them does not

export class Pictures {
  constructor() {
    this.panels = [...document.querySelectorAll("[data-camera]")];
    this.restart();
    this.captured = this.panels.map(() => -Infinity);
    this.videos = this.panels.map(() => new Video());
    this.canVideo = true; // until it is known
    this.failed = 0;
    drawsVideo().then((can) => (this.canVideo = can));
  }

  // What cannot be drawn is asked for as JPEG files.
  get jpegOnly() {
    return !this.canVideo || this.failed >= MOST_FAILED;
  }

  // A new connection counts its pictures anew; those still being decoded count for the old one.
  restart() {
    this.drawn = this.panels.map(() => 0);
    this.age = null;
  }

  // way: how long it was under way to here [ms]; its age when it left the station stands in it.
  async receive(buffer, way) {
    const drawn = this.drawn;
    const header = new DataView(buffer, 0, HEADER_BYTES);
    const camera = header.getUint8(0) - FIRST_CAMERA;
    const coding = header.getUint8(1);
    const number = header.getUint32(4, true);
    const captured = performance.now() - way - header.getFloat32(8, true) * 1000;
    const content = new Uint8Array(buffer, HEADER_BYTES);
    try {
      const picture = await (coding === JPEG ? still(content) : this.videos[camera].decode(content, coding === FROM_KEY));
      if (drawn === this.drawn && number > drawn[camera]) this.draw(camera, picture, captured);
      picture.close();
      if (coding !== JPEG) this.failed = 0;
    } catch {
      // What is no picture is not drawn; the age tells that none came.
      if (coding === FROM_KEY) this.failed += 1;
    }
    drawn[camera] = Math.max(drawn[camera], number);
  }

  draw(camera, picture, captured) {
    const canvas = this.panels[camera].querySelector("canvas");
    const { displayWidth: width = picture.width, displayHeight: height = picture.height } = picture;
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    canvas.getContext("2d").drawImage(picture, 0, 0);
    this.captured[camera] = captured;
    this.age = Math.max(0, performance.now() - captured); // of the newest when it had been drawn [ms]
    canvas.dataset.ageMs = this.age.toFixed(1); // for whoever measures
  }

  showAges() {
    for (const [camera, panel] of this.panels.entries()) {
      const age = (performance.now() - this.captured[camera]) / 1000;
      if (!Number.isFinite(age)) continue;
      panel.dataset.state = age > STALE_S ? "stale" : "live";
      panel.querySelector(".camera-age").textContent = ageInWords(age);
    }
  }
}

function still(content) {
  return createImageBitmap(new Blob([content], { type: "image/jpeg" }));
}

function ageInWords(age) {
  return age < 0.9995
    ? say("script.age", { number: Math.round(age * 1000) })
    : say("script.age_old", { number: age.toFixed(1) });
}

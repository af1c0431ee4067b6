// The page's own 3-D view. What cannot draw here takes nothing else away: the page says so, and goes on without it.

import { contextOf } from "/assets/js/drawing/context.js";
import { Force } from "/assets/js/force.js";
import { remember, remembered } from "/assets/js/memory.js";
import { say } from "/assets/js/words.js";

const HEADER_BYTES = 12;
const TURNS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
const ZOOMS = { "+": 0.9, "=": 0.9, "-": 1 / 0.9 };
const SHOWN = "retouch-cloud";
export const [MOMENT, CLOUD] = [0, 1];

export class LiveView {
  // onForeseen: told where the gripper would touch something on its way, null for nowhere.
  constructor(onForeseen) {
    this.onForeseen = (touch, took) => {
      this.panel.toggleAttribute("data-foreseen", touch !== null);
      this.panel.dataset.foresightMs = took.toFixed(2); // for whoever measures
      onForeseen(touch);
    };
    this.panel = document.querySelector(".scene");
    this.force = new Force(this.panel.querySelector(".force"));
    this.parts = {};
    this.restart();
    this.cloudButton = document.querySelector(".cloud");
    this.cloudButton.addEventListener("click", ({ detail }) => {
      this.showCloud(!this.wantsCloud);
      remember(SHOWN, this.wantsCloud);
      if (detail > 0) this.cloudButton.blur();
    });
    document.querySelector(".scene-home").addEventListener("click", ({ currentTarget }) => {
      this.drawing?.look();
      currentTarget.blur();
    });
    this.load();
  }

  // A new connection counts its moments and clouds anew.
  restart() {
    this.drawn = this.clouds = 0;
    this.connection = {};
  }

  show(parts) {
    Object.assign(this.parts, parts);
    if (Object.keys(parts).length > 0) this.drawing?.show(parts);
  }

  // Where the part that is corrected begins and ends, as shares of the motion; null for all of it.
  mark(part) {
    this.part = part;
    this.drawing?.mark(part);
  }

  // What an entry of the history changes; null for nothing.
  compare(effect) {
    this.compared = effect;
    this.drawing?.compare(effect);
  }

  receive(buffer) {
    const number = new DataView(buffer).getUint32(4, true);
    const { connection } = this;
    this.moment = { shown: { number, connection }, values: new Float32Array(buffer, HEADER_BYTES) };
    this.force.show(this.moment.values);
    this.drawing?.receive(this.moment);
  }

  receiveCloud(buffer) {
    const number = new DataView(buffer).getUint32(4, true);
    if (this.wantsCloud) this.drawing?.receiveCloud(buffer, HEADER_BYTES, { number, connection: this.connection });
  }

  get wantsCloud() {
    return this.cloudButton.getAttribute("aria-pressed") === "true";
  }

  showCloud(wanted) {
    this.cloudButton.setAttribute("aria-pressed", String(wanted));
    if (!wanted) this.drawing?.hideCloud();
  }

  // Which way one looks, to the left of the robot's forward [rad].
  get yaw() {
    return this.drawing?.yaw ?? 0;
  }

  async load() {
    const canvas = document.querySelector(".view");
    const means = contextOf(canvas);
    if (!means) return this.fail("script.no_webgl");
    canvas.addEventListener("keydown", (event) => this.turn(event));
    canvas.addEventListener("webglcontextlost", () => this.fail("script.taken_away"));
    canvas.addEventListener("webglcontextrestored", () => {
      this.succeed();
      this.drawing?.wish();
    });
    try {
      const words = new URL(canvas.dataset.description, location);
      const [{ Drawing }, description, shapes] = await Promise.all([
        import("/assets/js/drawing/drawing.js"),
        fetched(words).then((answer) => answer.json()),
        fetched(new URL("shapes.bin", words)).then((answer) => answer.arrayBuffer()),
      ]);
      this.drawing = new Drawing(canvas, means, description, shapes, {
        onDrawn: (shown, cloud) => this.onDrawn(shown, cloud),
        onForeseen: (touch, took) => this.onForeseen(touch, took),
      });
      this.drawing.show(this.parts);
      this.drawing.mark(this.part ?? null);
      this.drawing.compare(this.compared ?? null);
      if (this.moment) this.drawing.receive(this.moment);
      this.showCloud(chosen() ?? !means.isSlow);
      await this.drawing.prepare();
    } catch (error) {
      console.warn("the live view is not there:", error);
      return this.fail("script.not_loaded");
    }
    return this.succeed();
  }

  turn(event) {
    const [turn, zoom] = [TURNS[event.key], ZOOMS[event.key]];
    if (!turn && !zoom) return;
    event.preventDefault();
    this.drawing?.turn(turn ?? [0, 0], zoom ?? 1);
  }

  onDrawn(shown, cloud) {
    if (shown?.connection === this.connection) this.drawn = Math.max(this.drawn, shown.number);
    if (cloud?.connection === this.connection) this.clouds = Math.max(this.clouds, cloud.number);
  }

  succeed() {
    this.panel.dataset.view = "live";
  }

  fail(why) {
    this.panel.dataset.view = "none";
    this.panel.querySelector(".scene-empty-title").textContent = say("script.no_view");
    this.panel.querySelector(".scene-empty-text").textContent = say(why);
  }
}

async function fetched(address) {
  const answer = await fetch(address);
  if (!answer.ok) throw new Error(`${address}: ${answer.status}`);
  return answer;
}

// Whether the person wants to see the point cloud; null where s/he has not said so: then it depends on the computer.
function chosen() {
  return { true: true, false: false }[remembered(SHOWN)] ?? null;
}

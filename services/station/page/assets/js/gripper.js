// The gripper, where it takes part: closed and opened by a button and its key, and as far as its slider says.

import { Slider } from "/assets/js/slider.js";
import { say } from "/assets/js/words.js";

const SHORTCUT = "KeyC";

export class Gripper {
  // press: says an action and what it is about.
  constructor(press) {
    this.panel = document.querySelector(".gripper");
    this.button = this.panel.querySelector('[data-action="grip"]');
    const track = this.panel.querySelector(".gripper-track");
    const knob = track.querySelector(".gripper-knob");
    this.slider = new Slider(knob, track, {
      least: 0,
      most: 1,
      step: 0.01,
      enabled: () => !knob.hasAttribute("disabled"),
      said: (value) => say("script.percent", { share: Math.round(100 * value) }),
      moved: (value) => knob.style.setProperty("--at", value),
      done: (value) => press("opening", value.toFixed(2)),
    });
  }

  // What the station says now.
  follow() {
    const { share } = this.panel.dataset;
    if (share !== undefined) this.slider.follow(Number(share));
  }

  // The button by its key, whatever has the focus; whether it was that one.
  shortcut(code) {
    if (code !== SHORTCUT || this.panel.hidden) return false;
    if (!this.button.disabled) this.button.click();
    return true;
  }
}

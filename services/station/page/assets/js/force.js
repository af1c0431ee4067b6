// The force that a device renders to the hand, or would, as a bar and a number.

import { say } from "/assets/js/words.js";

const FIRST = 21; // in a moment
const MOST_N = 10;

export class Force {
  constructor(bar) {
    this.bar = bar;
    this.text = bar.querySelector(".force-text");
    this.shown = "";
  }

  show(moment) {
    const newtons = Math.hypot(...moment.subarray(FIRST, FIRST + 3));
    const number = newtons.toFixed(1);
    if (number === this.shown) return;
    this.shown = number;
    this.text.textContent = say("script.newtons", { number });
    this.bar.setAttribute("aria-valuenow", number);
    this.bar.style.setProperty("--share", Math.min(1, newtons / MOST_N));
  }
}

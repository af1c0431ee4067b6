// How long what this tab says takes to the station and back: the worst of the last second.

import { say } from "/assets/js/words.js";

const KEPT = 10;

export class RoundTrip {
  constructor() {
    this.times = [];
  }

  hear([stamp, waited]) {
    if (stamp === 0) return;
    this.times = [...this.times, performance.now() - stamp - waited].slice(-KEPT);
    const worst = Math.max(...this.times, 0);
    document.querySelector('[data-value="figure-link"]').textContent = say("script.link", { number: Math.round(worst) });
  }
}

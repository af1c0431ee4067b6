// How long what this tab says takes to the station and back: the worst of the last second.

import { say } from "/assets/js/words.js";

const KEPT = 10;

export class RoundTrip {
  constructor() {
    this.times = [];
  }

  // How long what the station sends is under way, at least [ms]: half of the fastest time there and back.
  get way() {
    return this.times.length === 0 ? 0 : Math.max(0, Math.min(...this.times)) / 2;
  }

  // The same for the station, which judges by it how long what is said here was under way; null before the first.
  get told() {
    return this.times.length === 0 ? null : this.way;
  }

  hear([stamp, waited]) {
    if (stamp === 0) return;
    this.times = [...this.times, performance.now() - stamp - waited].slice(-KEPT);
    const worst = Math.max(...this.times, 0);
    document.querySelector('[data-value="figure-link"]').textContent = say("script.link", { number: Math.round(worst) });
  }
}

// What was pressed and is not acknowledged yet. A stop is kept until it is, and said first when the link is back; what
// else was pressed a second ago is not done any more, and this is told.

import { say } from "/assets/js/words.js";

const STOP = "stop";
const STOPS = new Set([STOP, "stop_other"]);
const LATE_MS = 1000;
const TOLD_MS = 6000;

export class Presses {
  constructor(tab) {
    this.number = 0;
    this.waiting = [];
    this.link = null;
    tab.stopWaits = () => this.stopWaits;
    if (tab.stopIsDue) this.press(STOP);
  }

  get stopWaits() {
    return this.waiting.some(({ action }) => action === STOP);
  }

  press(action, argument = "") {
    if (STOPS.has(action) && this.waiting.some((one) => one.action === action && one.argument === argument)) return;
    this.number += 1;
    const press = { number: this.number, action, argument, at: performance.now(), date: Date.now(), saidTo: null };
    if (STOPS.has(action)) this.waiting.unshift(press);
    else this.waiting.push(press);
    this.say();
  }

  // On each connection once: what a connection has taken it delivers, or it is lost and with it the acknowledgement.
  say() {
    this.dropLate();
    if (this.link?.isOpen) {
      for (const press of this.waiting.filter(({ saidTo }) => saidTo !== this.link.socket)) {
        press.saidTo = this.link.socket;
        this.link.sayPressed(press);
      }
    }
    this.show();
  }

  settle({ accepted, refused }) {
    const numbers = new Set([...accepted, ...refused]);
    for (const { number, action } of this.waiting) if (refused.includes(number)) tellDropped(action);
    this.waiting = this.waiting.filter(({ number }) => !numbers.has(number));
    this.show();
  }

  dropLate() {
    const late = this.waiting.filter((press) => !STOPS.has(press.action) && ageOf(press) > LATE_MS);
    late.forEach(({ action }) => tellDropped(action));
    this.waiting = this.waiting.filter((press) => !late.includes(press));
  }

  show() {
    document.body.toggleAttribute("data-stop-waits", this.stopWaits);
  }
}

// A tab's own clock stands still while its computer sleeps; the time of day does not, but it may be set.
function ageOf({ at, date }) {
  return Math.max(performance.now() - at, Date.now() - date);
}

function tellDropped(action) {
  const banner = document.querySelector(".banner-dropped");
  if (!banner) return;
  const label = document.querySelector(`[data-action="${action}"] .action-label, [data-action="${action}"]`);
  const name = (label?.textContent ?? action).trim();
  banner.querySelector(".banner-text").textContent = say("script.dropped", { name });
  banner.toggleAttribute("data-open", true);
  clearTimeout(tellDropped.timer);
  tellDropped.timer = setTimeout(() => banner.removeAttribute("data-open"), TOLD_MS);
}

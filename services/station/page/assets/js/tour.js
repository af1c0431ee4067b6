// Five steps through the page, for whoever sees it for the first time; the browser remembers that they were seen.

import { remember, remembered } from "/assets/js/memory.js";
import { say } from "/assets/js/words.js";

const SEEN = "retouch-tour";
const STEPS = [
  { name: "scene", at: ".scene" },
  { name: "guide", at: ".guide" },
  { name: "pad", at: ".pad" },
  { name: "stop", at: ".stop" },
  { name: "health", at: ".health" },
];
const TAKEN = [".stop", ".guide", ".pad"];
const MARGIN = 12;

export class Tour {
  constructor() {
    this.panel = document.querySelector(".tour");
    this.step = 0;
    this.opener = document.querySelector(".tour-open");
    this.opener.addEventListener("click", () => this.open());
    this.button("skip").addEventListener("click", () => this.close());
    this.button("back").addEventListener("click", () => this.go(this.step - 1));
    this.button("next").addEventListener("click", () => this.go(this.step + 1));
    window.addEventListener("resize", () => this.place());
    if (remembered(SEEN, "seen") === null) this.open({ focus: false });
  }

  button(name) {
    return this.panel.querySelector(`.tour-${name}`);
  }

  // By itself it opens beside what else there is to do, and takes no key from anybody.
  open({ focus = true } = {}) {
    this.panel.hidden = false;
    this.go(0, focus);
  }

  go(step, focus = true) {
    if (step >= STEPS.length) {
      this.close();
      return;
    }
    this.step = step;
    const { name } = STEPS[step];
    this.panel.querySelector(".tour-number").textContent = say("tour.step", { number: step + 1, count: STEPS.length });
    this.panel.querySelector(".tour-title").textContent = say(`tour.${name}`);
    this.panel.querySelector(".tour-text").textContent = say(`tour.${name}_text`);
    this.button("back").hidden = step === 0;
    this.button("next").textContent = say(step + 1 < STEPS.length ? "tour.next" : "tour.finish");
    this.mark(document.querySelector(STEPS[step].at));
    this.place();
    if (focus) this.panel.querySelector(".tour-title").focus();
  }

  close() {
    const hadFocus = this.panel.contains(document.activeElement);
    this.panel.hidden = true;
    this.mark(null);
    if (hadFocus) this.opener.focus();
    remember(SEEN, "seen");
  }

  mark(place) {
    document.querySelector("[data-toured]")?.removeAttribute("data-toured");
    place?.toggleAttribute("data-toured", true);
    place?.scrollIntoView({ block: "nearest" });
  }

  // Beside what it speaks of where there is room, else over it; over nothing that is pressed, least of all the stop.
  place() {
    if (this.panel.hidden) return;
    const [about, own] = [document.querySelector(STEPS[this.step].at), this.panel].map((of) =>
      of.getBoundingClientRect(),
    );
    const within = (value, most) => Math.max(MARGIN, Math.min(value, most - MARGIN));
    const spots = [
      [about.left - own.width - MARGIN, about.top],
      [about.left, about.top - own.height - MARGIN],
      [about.left, about.bottom + MARGIN],
      [about.left + (about.width - own.width) / 2, about.top + (about.height - own.height) / 2],
    ].map(([x, y]) => [within(x, innerWidth - own.width), within(y, innerHeight - own.height)]);
    const taken = TAKEN.map((part) => document.querySelector(part).getBoundingClientRect());
    const isFree = (spot, ...others) => !others.some((other) => meets(spot, own, other));
    const [x, y] =
      spots.find((spot) => isFree(spot, about, ...taken)) ??
      spots.find((spot) => isFree(spot, ...taken)) ??
      spots.find((spot) => isFree(spot, taken[0])) ??
      spots[0];
    this.panel.style.setProperty("left", `${x}px`);
    this.panel.style.setProperty("top", `${y}px`);
  }
}

function meets([x, y], { width, height }, other) {
  return x < other.right && x + width > other.left && y < other.bottom && y + height > other.top;
}

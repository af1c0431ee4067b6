// The motion as a bar: where it is, which part of it is corrected, how fast it goes, where it was or would be spoilt.

import { Slider } from "/assets/js/slider.js";
import { say } from "/assets/js/words.js";

const SHORTEST = 0.02; // of a part
const [SLOWEST, FASTEST] = [0.25, 2];
const SHORTCUTS = { KeyP: ["pause", "play"], Comma: ["step_back"], Period: ["step_on"] };

export class Timeline {
  // press: says an action and what it is about; mark: shows where the part begins and ends, null for the whole motion.
  constructor(press, mark) {
    Object.assign(this, { press, mark, foreseen: null });
    this.panel = document.querySelector(".timeline");
    this.track = this.panel.querySelector(".timeline-track");
    const marks = { least: 0, most: 1, step: 0.01, said: percent, done: () => this.pressPart() };
    const isOpen = () => !this.track.hasAttribute("disabled");
    this.first = this.slider(".timeline-first", this.track, {
      ...marks,
      enabled: isOpen,
      kept: (value) => Math.min(value, this.last.value - SHORTEST),
      moved: (value) => this.showPart(value, this.last.value),
    });
    this.last = this.slider(".timeline-last", this.track, {
      ...marks,
      value: 1,
      enabled: isOpen,
      kept: (value) => Math.max(value, this.first.value + SHORTEST),
      moved: (value) => this.showPart(this.first.value, value),
    });
    this.head = this.slider(".timeline-head", this.track, {
      ...marks,
      step: 0.02,
      moved: (value) => this.head.knob.style.setProperty("--at", value),
      done: (value) => press("seek", value.toFixed(3)),
    });
    const paceTrack = this.panel.querySelector(".pace-track");
    this.pace = this.slider(".pace-knob", paceTrack, {
      least: SLOWEST,
      most: FASTEST,
      step: 0.05,
      said: percent,
      moved: (value) => paceTrack.style.setProperty("--at", (value - SLOWEST) / (FASTEST - SLOWEST)),
      done: (value) => press("pace", value.toFixed(2)),
    });
    this.track.addEventListener("pointerdown", (event) => this.point(event));
  }

  slider(selector, track, options) {
    const knob = this.panel.querySelector(selector);
    return new Slider(knob, track, { enabled: () => !knob.hasAttribute("disabled"), ...options });
  }

  // What the station says now.
  follow() {
    const { first, last, progress, pace, spoilt } = this.panel.dataset;
    if (first === undefined) return;
    this.first.follow(Number(first));
    this.last.follow(Number(last));
    this.head.follow(Number(progress));
    this.pace.follow(Number(pace));
    this.tick("spoilt", spoilt.split(" ").filter(Boolean).map(Number));
  }

  foresee(touch) {
    this.tick("foreseen", touch ? [touch.share] : []);
  }

  // A click beside the marks goes there, where the motion may be led there.
  point(event) {
    if (event.target.closest(".timeline-mark, .timeline-head") || !this.head.enabled()) return;
    this.head.put(this.head.at(event.clientX));
    this.head.finish();
  }

  // The buttons by key, whatever has the focus; whether it was one of them.
  shortcut(code) {
    const buttons = (SHORTCUTS[code] ?? []).map((action) => this.panel.querySelector(`[data-action="${action}"]`));
    buttons.find((button) => !button.disabled)?.click();
    return buttons.length > 0;
  }

  showPart(first, last) {
    const isPart = first > 0 || last < 1;
    this.track.style.setProperty("--first", first);
    this.track.style.setProperty("--last", last);
    this.track.toggleAttribute("data-part", isPart);
    this.mark(isPart ? [first, last] : null);
  }

  pressPart() {
    const { first, last } = this;
    this.press("part", `${first.value.toFixed(3)} ${last.value.toFixed(3)}`);
    for (const mark of [first, last]) mark.keptUntil = Math.max(first.keptUntil, last.keptUntil);
  }

  tick(kind, shares) {
    const ticks = this.panel.querySelector(".timeline-ticks");
    const known = [...ticks.querySelectorAll(`.tick-${kind}`)];
    known.slice(shares.length).forEach((tick) => tick.remove());
    shares.forEach((share, i) => {
      const tick = known[i] ?? ticks.appendChild(Object.assign(document.createElement("div"), { className: `tick tick-${kind}` }));
      tick.style.setProperty("--at", share);
    });
  }
}

function percent(value) {
  return say("script.percent", { share: Math.round(100 * value) });
}

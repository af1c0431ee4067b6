// A knob on a track, moved by pointer or by keys; letters keep steering while it has the focus.

const KEYS = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1, PageDown: -5, PageUp: 5 };
const SETTLED_MS = 700; // so long a knob stays where it was put: what the station says meanwhile is older

export class Slider {
  // options: least, most, step; enabled(): whether it may be moved; kept(value): the nearest value to which a person
  // may move it; said(value): as it is read out; moved(value): told while it moves; done(value): told when it has been.
  constructor(knob, track, options) {
    const free = { kept: (value) => value };
    Object.assign(this, { knob, track, ...free, ...options, value: options.value ?? options.least, keptUntil: 0 });
    knob.addEventListener("pointerdown", (event) => this.grab(event));
    knob.addEventListener("keydown", (event) => this.key(event));
    knob.setAttribute("aria-valuemin", this.read(this.least));
    knob.setAttribute("aria-valuemax", this.read(this.most));
    this.tell();
  }

  // What the station says; not while somebody moves it.
  follow(value) {
    const able = this.enabled();
    this.knob.tabIndex = able ? 0 : -1;
    this.knob.setAttribute("aria-disabled", String(!able));
    if (value !== this.value && performance.now() >= this.keptUntil) this.put(value);
  }

  put(value) {
    this.value = Math.min(Math.max(value, this.least), this.most);
    this.tell();
    this.moved(this.value);
  }

  tell() {
    this.knob.setAttribute("aria-valuenow", this.read(this.value));
    this.knob.setAttribute("aria-valuetext", this.said(this.value));
  }

  grab(event) {
    if (!this.enabled() || event.button !== 0) return;
    event.preventDefault();
    this.knob.setPointerCapture?.(event.pointerId);
    this.keptUntil = Infinity;
    const move = ({ clientX }) => this.put(this.kept(this.at(clientX)));
    const drop = () => {
      this.knob.removeEventListener("pointermove", move);
      this.finish();
    };
    this.knob.addEventListener("pointermove", move);
    for (const end of ["pointerup", "pointercancel"]) this.knob.addEventListener(end, drop, { once: true });
  }

  key(event) {
    const steps = KEYS[event.key];
    const end = { Home: this.least, End: this.most }[event.key];
    if (!this.enabled() || (steps === undefined && end === undefined)) return;
    event.preventDefault();
    this.put(this.kept(end ?? this.value + steps * this.step));
    this.finish();
  }

  finish() {
    this.keptUntil = performance.now() + SETTLED_MS;
    this.done(this.value);
  }

  at(x) {
    const { left, width } = this.track.getBoundingClientRect();
    const value = this.least + ((x - left) / width) * (this.most - this.least);
    return Math.round(value / this.step) * this.step;
  }

  read(value) {
    return String(Math.round(100 * value));
  }
}

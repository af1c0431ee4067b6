// When the next picture may be drawn, and how fine it may be: drawing never takes more than its share of a computer
// that has something more important to do. One picture is under way at most, and what came meanwhile is not drawn.

const PERIOD_MS = 1000 / 30;
const REST = 2; // times as long as a picture took nothing is drawn after it
const SLOW_MS = 40;
const SLOW_TIMES = 4;
const FINENESS = [1, 0.75, 0.5];

export class Cadence {
  constructor() {
    this.due = 0;
    this.began = 0;
    this.slow = 0;
    this.step = 0;
  }

  // Share of the screen's pixels along each side that is worth drawing.
  get fineness() {
    return FINENESS[this.step];
  }

  // How long to wait before the next picture.
  wait(now) {
    return Math.max(0, this.due - now);
  }

  begin(now) {
    this.began = now;
  }

  done(now) {
    const took = now - this.began;
    this.due = Math.max(this.began + PERIOD_MS, now + REST * took);
    this.slow = took > SLOW_MS ? this.slow + 1 : 0;
    if (this.slow < SLOW_TIMES || this.step === FINENESS.length - 1) return;
    this.slow = 0;
    this.step += 1;
  }
}

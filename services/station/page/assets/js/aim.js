// What a press by hand is meant for: what lay under the pointer as it went down counts, wherever it is when the pointer is
// let go. And what has only just come to where something else was is not pressed before anybody can have seen it there.

const ACTIONS = "[data-action]";
const SEEN_AFTER_MS = 250; // sooner nobody answers to what he or she sees
const STAYED_PX = 12; // farther, and the pointer was led away

export class Aim {
  // press: does what a button says; never: selects what this leaves alone.
  constructor(press, never) {
    Object.assign(this, { press, never, down: null, counted: null, boxes: new Map(), left: [], come: new Map() });
    document.addEventListener("pointerdown", (event) => this.begin(event), { capture: true });
    document.addEventListener("pointerup", (event) => this.end(event), { capture: true });
    document.addEventListener("pointercancel", () => this.cancel(), { capture: true });
  }

  // Whether this click is of a press that counted when the pointer was let go.
  hasCounted({ detail, target }) {
    return detail > 0 && this.counted !== null && this.counted === target.closest(ACTIONS);
  }

  begin({ target, isPrimary, button, clientX, clientY }) {
    for (const come of this.come.keys()) if (holds(boxOf(come), clientX, clientY)) this.hold(come);
    this.counted = null;
    const meant = isPrimary && button === 0 ? target.closest?.(ACTIONS) : null;
    this.down = meant && !meant.matches(this.never) ? { meant, clientX, clientY } : null;
  }

  end({ clientX, clientY }) {
    const { down } = this;
    this.cancel();
    if (!down) return;
    const { meant } = down;
    const hasStayed = Math.hypot(clientX - down.clientX, clientY - down.clientY) <= STAYED_PX;
    if (!hasStayed && !holds(boxOf(meant), clientX, clientY)) return;
    this.counted = meant;
    if (!meant.isConnected || meant.disabled) return;
    this.press(meant);
    this.look();
  }

  cancel() {
    this.down = null;
  }

  // After anything may have moved.
  look() {
    const now = performance.now();
    const boxes = new Map([...document.querySelectorAll("button:enabled")].map((button) => [button, boxOf(button)]));
    for (const [button, box] of this.boxes) {
      if (!isSame(box, boxes.get(button))) this.left.push({ button, box, until: now + SEEN_AFTER_MS });
    }
    this.left = this.left.filter(({ until }) => until > now);
    for (const [button, box] of boxes) {
      if (isSame(box, this.boxes.get(button)) || button.matches(this.never)) continue;
      if (this.left.some((one) => one.button !== button && overlap(one.box, box))) this.hold(button);
    }
    this.boxes = boxes;
  }

  // Not to be pressed for a moment; pressed all the same, for another one.
  hold(button) {
    clearTimeout(this.come.get(button));
    button.setAttribute("data-come", "");
    this.come.set(button, setTimeout(() => this.release(button), SEEN_AFTER_MS));
  }

  release(button) {
    button.removeAttribute("data-come");
    this.come.delete(button);
  }
}

function boxOf(element) {
  return element.getBoundingClientRect();
}

// But for the pixel by which a button gives way to the pointer.
function isSame(box, other) {
  return other !== undefined && ["left", "top", "right", "bottom"].every((side) => Math.abs(box[side] - other[side]) < 2);
}

function holds({ left, top, right, bottom }, x, y) {
  return left <= x && x < right && top <= y && y < bottom;
}

function overlap(one, other) {
  return one.left < other.right && other.left < one.right && one.top < other.bottom && other.top < one.bottom;
}

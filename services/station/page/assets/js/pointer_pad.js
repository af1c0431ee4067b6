// The pad on which a mouse or a pen leads the robot: drag for left, right, up and down, the wheel for forward and back,
// and with Shift the same turns. How far was dragged counts on without end, in halves of the pad: a sample that is lost
// loses no distance.

const NOTCH = 0.05;
const LINES_A_NOTCH = 3;
const PIXELS_A_NOTCH = 100;
const TURNS = 3;
const END = 1000;

export class PointerPad {
  constructor(element, changed) {
    this.element = element;
    this.changed = changed;
    this.axes = [0, 0, 0, 0, 0, 0];
    this.pointer = null;
    element.addEventListener("pointerdown", (event) => this.grip(event));
    element.addEventListener("pointermove", (event) => this.drag(event));
    element.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
    for (const end of ["pointerup", "pointercancel", "lostpointercapture"]) {
      element.addEventListener(end, ({ pointerId }) => pointerId === this.pointer && this.letGo());
    }
    window.addEventListener("blur", () => this.letGo());
    document.addEventListener("visibilitychange", () => this.letGo());
  }

  get gripped() {
    return this.pointer !== null;
  }

  controller() {
    return { kind: "pointer", number: 0, name: "", standard: false, axes: this.axes.map(told), buttons: [this.gripped ? 1 : 0] };
  }

  // A finger looks on: what slides over a touch screen by chance moves no robot.
  grip(event) {
    this.element.toggleAttribute("data-touched", event.pointerType === "touch");
    if (this.gripped || event.button !== 0 || event.pointerType === "touch") return;
    event.preventDefault();
    this.element.setPointerCapture?.(event.pointerId);
    Object.assign(this, { pointer: event.pointerId, x: event.clientX, y: event.clientY });
    this.element.toggleAttribute("data-gripped", true);
    this.changed();
  }

  drag({ pointerId, clientX, clientY, shiftKey }) {
    if (pointerId !== this.pointer) return;
    const half = Math.max(1, Math.min(this.element.clientWidth, this.element.clientHeight) / 2);
    this.move(0, (clientX - this.x) / half, shiftKey);
    this.move(1, (clientY - this.y) / half, shiftKey);
    Object.assign(this, { x: clientX, y: clientY });
  }

  // Browsers that scroll sideways with Shift say so in deltaX.
  wheel(event) {
    if (!this.gripped) return;
    event.preventDefault();
    const turned = event.deltaY || event.deltaX;
    this.move(2, NOTCH * (event.deltaMode === 0 ? turned / PIXELS_A_NOTCH : turned / LINES_A_NOTCH), event.shiftKey);
  }

  move(axis, share, turns) {
    const index = turns ? axis + TURNS : axis;
    this.axes[index] = Math.max(-END, Math.min(END, this.axes[index] + share));
  }

  letGo() {
    if (!this.gripped) return;
    this.pointer = null;
    this.element.removeAttribute("data-gripped");
    this.changed();
  }
}

function told(axis) {
  return Math.round(axis * 10000) / 10000;
}

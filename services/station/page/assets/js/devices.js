// The pads of the devices: which one is shown, and what each is doing.

import { gamepads, noGamepadBecause } from "/assets/js/gamepads.js";
import { PointerPad } from "/assets/js/pointer_pad.js";

const STICKS = 2;

export class Devices {
  constructor(changed) {
    this.panel = document.querySelector(".devices");
    this.tabs = [...this.panel.querySelectorAll(".device-tab")];
    this.pointer = new PointerPad(this.panel.querySelector(".pointer-pad"), changed);
    this.from = [...this.pointer.axes];
    this.shown = "";
    this.panel.querySelector(".device-tabs").addEventListener("click", (event) => this.clicked(event));
    this.panel.querySelector(".device-tabs").addEventListener("keydown", (event) => this.step(event));
    this.show("keyboard");
  }

  // As in all rows of tabs: the arrows lead from one to the next.
  step({ key }) {
    const step = { ArrowLeft: -1, ArrowRight: 1 }[key];
    const at = this.tabs.indexOf(document.activeElement);
    if (!step || at < 0) return;
    const next = this.tabs[(at + step + this.tabs.length) % this.tabs.length];
    this.show(next.dataset.padFor);
    next.focus();
  }

  // A tab that was clicked does not keep the focus, so that Space is for Finish again.
  clicked({ target, detail }) {
    this.show(target.dataset.padFor);
    if (detail > 0) target.blur();
  }

  // A pad that is not shown is not there: nobody can grip it.
  controllers() {
    return this.shown === "pointer" ? [...gamepads(), this.pointer.controller()] : gamepads();
  }

  show(pad) {
    if (!pad || pad === this.shown) return;
    this.pointer.letGo();
    this.shown = this.panel.dataset.pad = pad;
    for (const tab of this.tabs) {
      tab.setAttribute("aria-selected", String(tab.dataset.padFor === pad));
      tab.tabIndex = tab.dataset.padFor === pad ? 0 : -1;
    }
  }

  // The pad of the device that is in use comes forward when it is taken into use, in a frame the first one too: there
  // nobody chooses another. A master that is not heard for a moment takes none into use.
  follow() {
    const { device } = this.panel.dataset;
    if (device === "" || device === this.device) return;
    if (this.device !== undefined || document.body.dataset.framed === "yes") this.show(device === "spacemouse" ? "gamepad" : device);
    this.device = device;
  }

  draw() {
    this.markAbsent();
    if (this.shown === "gamepad") this.drawGamepads();
    if (this.shown === "pointer") this.drawPointer();
  }

  // A device that is not there is said to be so, with the reason, before anybody looks for it.
  markAbsent() {
    const because = noGamepadBecause();
    const tab = this.tabs.find(({ dataset }) => dataset.padFor === "gamepad");
    if (tab.title === because) return;
    tab.title = because;
    tab.toggleAttribute("data-absent", because !== "");
  }

  drawGamepads() {
    const pads = gamepads();
    const box = this.panel.querySelector(".gamepads");
    this.panel.querySelector(".gamepads-none").textContent = noGamepadBecause();
    this.panel.toggleAttribute("data-gamepads", pads.length > 0);
    while (box.children.length > pads.length) box.lastChild.remove();
    while (box.children.length < pads.length) box.append(drawing());
    pads.forEach((pad, index) => drawGamepad(box.children[index], pad));
  }

  drawPointer() {
    const { axes } = this.pointer;
    const dot = this.panel.querySelector(".pointer-dot");
    dot.style.setProperty("--x", this.pointer.gripped ? axes[0] - this.from[0] : 0);
    dot.style.setProperty("--y", this.pointer.gripped ? axes[1] - this.from[1] : 0);
    if (!this.pointer.gripped) this.from = [...axes];
  }
}

function drawing() {
  const element = document.createElement("div");
  element.className = "gamepad";
  element.innerHTML = '<div class="gamepad-name"></div><div class="gamepad-parts"></div>';
  return element;
}

function drawGamepad(element, { name, axes, buttons }) {
  const parts = element.querySelector(".gamepad-parts");
  const sticks = Math.min(STICKS, Math.floor(axes.length / 2));
  const others = axes.length - 2 * sticks;
  const wanted = sticks + others + buttons.length;
  element.querySelector(".gamepad-name").textContent = name;
  while (parts.children.length > wanted) parts.lastChild.remove();
  while (parts.children.length < wanted) parts.append(document.createElement("div"));
  [...parts.children].forEach((part, index) => {
    if (index < sticks) drawStick(part, axes[2 * index], axes[2 * index + 1]);
    else if (index < sticks + others) drawShare(part, "gamepad-axis", axes[sticks + index]);
    else drawShare(part, "gamepad-button", buttons[index - sticks - others]);
  });
}

function drawStick(part, x, y) {
  part.className = "gamepad-stick";
  part.style.setProperty("--x", x);
  part.style.setProperty("--y", y);
}

function drawShare(part, kind, share) {
  part.className = kind;
  part.style.setProperty("--share", share);
  part.toggleAttribute("data-pressed", Math.abs(share) >= 0.5);
}

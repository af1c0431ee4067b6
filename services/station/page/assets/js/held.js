// What is held down in this tab: keys by their physical place, whether it is seen and has the focus, what else is there.

const KEYS_AT_MOST = 32;

export class Held {
  constructor(changed, controllers) {
    this.keys = new Set();
    this.controllers = controllers;
    this.changed = changed;
    window.addEventListener("blur", () => this.clear());
    window.addEventListener("focus", () => this.changed());
    window.addEventListener("pagehide", () => this.clear());
    document.addEventListener("visibilitychange", () => this.clear());
  }

  press(code) {
    if (this.keys.has(code) || this.keys.size >= KEYS_AT_MOST || !/^[A-Za-z0-9]{1,32}$/.test(code)) return;
    this.keys.add(code);
    this.changed();
  }

  // A release that cannot be told to be of one key lets go of all; while Meta is down some systems swallow the others'.
  release(code, isUnknown) {
    if (!isUnknown && !code.startsWith("Meta") && !this.keys.has(code)) return;
    if (isUnknown || code.startsWith("Meta")) this.keys.clear();
    else this.keys.delete(code);
    this.changed();
  }

  clear() {
    this.keys.clear();
    this.changed();
  }

  state() {
    const visible = document.visibilityState === "visible";
    const focused = visible && document.hasFocus();
    return { keys: [...this.keys], visible, focused, controllers: focused ? this.controllers() : [] };
  }
}

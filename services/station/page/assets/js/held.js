// What is held down in this tab: keys by their physical place, whether it is seen and has the focus, what else is there.

const KEYS_AT_MOST = 32;

export class Held {
  constructor(changed, controllers) {
    this.keys = new Set();
    this.since = null;
    this.controllers = controllers;
    this.changed = changed;
    window.addEventListener("blur", () => this.clear());
    window.addEventListener("focus", () => this.changed());
    window.addEventListener("pagehide", () => this.clear());
    document.addEventListener("visibilitychange", () => this.clear());
  }

  // at: when it happened, by the browser's clock [ms].
  press(code, at) {
    if (this.keys.has(code) || this.keys.size >= KEYS_AT_MOST || !/^[A-Za-z0-9]{1,32}$/.test(code)) return;
    this.keys.add(code);
    this.since = at;
    this.changed();
  }

  // A release that cannot be told to be of one key lets go of all; while Meta is down some systems swallow the others'.
  release(code, isUnknown, at) {
    if (!isUnknown && !code.startsWith("Meta") && !this.keys.has(code)) return;
    if (isUnknown || code.startsWith("Meta")) this.keys.clear();
    else this.keys.delete(code);
    this.since = at;
    this.changed();
  }

  clear() {
    this.keys.clear();
    this.changed();
  }

  // How long the newest change has waited to be said, once [ms].
  waited() {
    const since = this.since;
    this.since = null;
    return since === null ? 0 : Math.max(0, performance.now() - since);
  }

  state() {
    const visible = document.visibilityState === "visible";
    const focused = visible && document.hasFocus();
    return { keys: [...this.keys], visible, focused, controllers: focused ? this.controllers() : [] };
  }
}

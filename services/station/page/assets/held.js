// What is held down in this tab: keys by their physical place, the focus, the gamepad's axes.

const KEYS_AT_MOST = 32;
const AXES_AT_MOST = 16;
const DEAD_ZONE = 0.12;

export class Held {
  constructor(changed) {
    this.keys = new Set();
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

  release(code) {
    // While Meta is down some systems swallow the other keys' release.
    const gone = code.startsWith("Meta") ? this.keys.size > 0 : this.keys.has(code);
    if (!gone) return;
    if (code.startsWith("Meta")) this.keys.clear();
    else this.keys.delete(code);
    this.changed();
  }

  clear() {
    this.keys.clear();
    this.changed();
  }

  state() {
    const focused = document.hasFocus() && document.visibilityState === "visible";
    return { keys: [...this.keys], focused, axes: focused ? gamepadAxes() : [] };
  }
}

function gamepadAxes() {
  const gamepad = navigator.getGamepads().find((candidate) => candidate?.connected);
  if (!gamepad) return [];
  return gamepad.axes.slice(0, AXES_AT_MOST).map((axis) => {
    const bounded = Math.max(-1, Math.min(1, axis));
    return Math.abs(bounded) < DEAD_ZONE ? 0 : Math.round(bounded * 1000) / 1000;
  });
}

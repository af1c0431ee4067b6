// What a tab carries over a reload: its seat, and a stop that was not acknowledged. A duplicated tab carries nothing.
// In a frame the seat is whose the address says it is: they find it again in another browser.

import { given } from "/assets/js/identity.js";
import { addressed } from "/assets/js/memory.js";

const SEAT = "retouch-seat";
const STOP = "retouch-stop";

export class Tab {
  constructor() {
    Object.assign(this, given());
    this.load = random();
    this.seat = addressed("seat") ?? take(SEAT) ?? random();
    this.stopIsDue = take(STOP) !== null;
    this.stopWaits = () => false;
    window.addEventListener("pagehide", () => {
      keep(SEAT, this.seat);
      if (this.stopWaits()) keep(STOP, "due");
    });
    window.addEventListener("pageshow", ({ persisted }) => persisted && [SEAT, STOP].forEach(take));
  }
}

function random() {
  return Array.from(crypto.getRandomValues(new Uint8Array(12)), (byte) => byte.toString(16).padStart(2, "0")).join("");
}

// A browser may forbid the storage: then a reload is another tab.
function take(name) {
  try {
    const value = sessionStorage.getItem(name);
    sessionStorage.removeItem(name);
    return value;
  } catch {
    return null;
  }
}

function keep(name, value) {
  try {
    sessionStorage.setItem(name, value);
  } catch {
    // Nothing can be kept.
  }
}

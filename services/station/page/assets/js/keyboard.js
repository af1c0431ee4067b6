// Which key an event is about: by its place (`code`), or by what is printed on it where a browser does not tell the
// place. What is printed where is asked of the browser, or learnt from the keys that are pressed.

import { say } from "/assets/js/words.js";

const UNKNOWN = new Set(["", "Unidentified", undefined]);
const LEGENDS = "retouch-legends";

// By any sign: browsers that give no code, remapped keyboards and input methods each hide another one.
export function isStop({ code, key, keyCode }) {
  return code === "Escape" || key === "Escape" || key === "Esc" || keyCode === 27;
}

export function isSpace({ code, key }) {
  return code === "Space" || key === " " || key === "Spacebar";
}

export class Keyboard {
  constructor() {
    this.keys = new Map([...document.querySelectorAll("[data-key]")].map((element) => [element.dataset.key, element]));
    this.legends = new Map([...this.keys].map(([code, { dataset }]) => [code, dataset.cap]));
    this.known = false;
    for (const [code, legend] of Object.entries(remembered())) this.print(code, legend);
    this.ask();
    window.addEventListener("focus", () => this.ask());
    this.tell();
  }

  steers(code) {
    return this.keys.has(code);
  }

  // The place of an event's key; empty where it cannot be told.
  placeOf({ code, key }) {
    if (!UNKNOWN.has(code)) return code;
    const legend = legendOf(key);
    return [...this.legends].find(([, printed]) => printed === legend)?.[0] ?? "";
  }

  async ask() {
    try {
      const layout = await navigator.keyboard.getLayoutMap();
      for (const code of this.keys.keys()) this.print(code, layout.get(code));
      this.tell();
    } catch {
      // Not every browser tells: the keys are learnt as they are pressed.
    }
  }

  learn({ code, key, shiftKey, ctrlKey, altKey, metaKey }) {
    if (shiftKey || ctrlKey || altKey || metaKey || !this.keys.has(code) || !legendOf(key)) return;
    if (this.legends.get(code) === legendOf(key) && this.known) return;
    this.print(code, key);
    this.tell();
    try {
      localStorage.setItem(LEGENDS, JSON.stringify(Object.fromEntries(this.legends)));
    } catch {
      // Then they are learnt anew next time.
    }
  }

  print(code, key) {
    const legend = legendOf(key);
    if (!legend || !this.keys.has(code)) return;
    this.known = true;
    this.legends.set(code, legend);
    this.keys.get(code).querySelector(".key-cap").textContent = legend;
  }

  tell() {
    document.querySelector(".keys-layout").textContent = this.known ? "" : say("script.layout");
  }
}

// One character, as it is printed; nothing of dead keys and of keys with names.
function legendOf(key) {
  const legend = typeof key === "string" ? key.trim().toLocaleUpperCase() : "";
  return [...legend].length === 1 ? legend : "";
}

function remembered() {
  try {
    return JSON.parse(localStorage.getItem(LEGENDS)) ?? {};
  } catch {
    return {};
  }
}

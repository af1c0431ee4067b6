// Which key an event is about: by its place (`code`), or by what is printed on it where a browser does not tell the
// place. What is printed where is asked of the browser, or learnt from the keys that are pressed.

import { KeySettings } from "/assets/js/key_settings.js";
import { remember, remembered } from "/assets/js/memory.js";
import { say } from "/assets/js/words.js";

const UNKNOWN = new Set(["", "Unidentified", undefined]);
const LEGENDS = "retouch-legends";
const ARROWS = { ArrowUp: "↑", ArrowDown: "↓", ArrowLeft: "←", ArrowRight: "→" };

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
    this.settings = new KeySettings(this.keys.keys());
    this.legends = new Map([...this.keys].map(([place, { dataset }]) => [place, dataset.cap]));
    this.known = false;
    for (const [place, legend] of Object.entries(kept())) this.print(place, legend);
    this.show();
    this.ask();
    window.addEventListener("focus", () => this.ask());
  }

  steers(name) {
    return this.keys.has(name);
  }

  // What an event's key does, as the station names it; empty where it cannot be told, or does nothing any more.
  nameOf(event) {
    return this.settings.nameAt(this.placeOf(event));
  }

  // The place of an event's key; empty where it cannot be told.
  placeOf({ code, key }) {
    if (!UNKNOWN.has(code)) return code;
    const legend = legendOf(key);
    const place = [...this.legends].find(([, printed]) => printed === legend)?.[0];
    if (place !== undefined) return place;
    return this.settings.isSet(madeUp(legend)) ? madeUp(legend) : "";
  }

  // A key that has no place for the browser may be set all the same, by what is printed on it.
  placeToSet(event) {
    return this.placeOf(event) || madeUp(legendOf(event.key));
  }

  async ask() {
    try {
      const layout = await navigator.keyboard.getLayoutMap();
      for (const [place, legend] of layout.entries()) this.print(place, legend);
      this.show();
    } catch {
      // Not every browser tells: the keys are learnt as they are pressed.
    }
  }

  learn({ code, key, shiftKey, ctrlKey, altKey, metaKey }) {
    if (shiftKey || ctrlKey || altKey || metaKey || UNKNOWN.has(code) || !legendOf(key)) return;
    if (this.legends.get(code) === legendOf(key) && this.known) return;
    this.print(code, key);
    this.show();
    remember(LEGENDS, JSON.stringify(Object.fromEntries(this.legends)));
  }

  print(place, key) {
    const legend = legendOf(key);
    if (!legend) return;
    this.known ||= this.keys.has(place);
    this.legends.set(place, legend);
  }

  // As this person reads it: what is printed on the key that lies there, or what the place is called.
  legendAt(place) {
    return this.legends.get(place) ?? ARROWS[place] ?? fromMadeUp(place) ?? place.replace(/^(Key|Digit)/, "");
  }

  show() {
    for (const [name, element] of this.keys) {
      element.querySelector(".key-cap").textContent = this.legendAt(this.settings.placeOf(name));
    }
    document.querySelector(".keys-layout").textContent = this.known ? "" : say("script.layout");
  }
}

// One character, as it is printed; nothing of dead keys and of keys with names.
function legendOf(key) {
  const legend = typeof key === "string" ? key.trim().toLocaleUpperCase() : "";
  return [...legend].length === 1 ? legend : "";
}

const MADE_UP = /^Printed([0-9a-f]+)$/;

function madeUp(legend) {
  return legend ? `Printed${legend.codePointAt(0).toString(16)}` : "";
}

function fromMadeUp(place) {
  const point = MADE_UP.exec(place)?.[1];
  return point && String.fromCodePoint(parseInt(point, 16));
}

function kept() {
  try {
    return JSON.parse(remembered(LEGENDS)) ?? {};
  } catch {
    return {}; // what is there was not written here
  }
}

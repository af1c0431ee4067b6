// Which key a person has set for what. Everything that leads the robot is named by the place of the key that does it
// where nothing was set; that name is what the station is told, wherever the key lies that was set.

import { remember, remembered } from "/assets/js/memory.js";
import { say } from "/assets/js/words.js";

const KEPT = "retouch-keys";
const PLACE = /^[A-Za-z0-9]{1,32}$/;
const TAKEN = new Set(["Escape", "Space", "Enter", "NumpadEnter", "Tab", "CapsLock", "F5", "F11", "F12"]);
const MODIFIER = /^(Shift|Control|Alt|Meta|OS)(Left|Right)?$/;

export class KeySettings {
  constructor(names) {
    this.names = new Set(names);
    this.places = new Map(Object.entries(kept()).filter(([name, place]) => this.names.has(name) && PLACE.test(place)));
  }

  // The place of the key that does what a name says.
  placeOf(name) {
    return this.places.get(name) ?? name;
  }

  // What the key at a place does: nothing where another key was set for it, and nothing was set for this one.
  nameAt(place) {
    const name = [...this.names].find((one) => this.placeOf(one) === place);
    return name ?? (this.names.has(place) ? "" : place);
  }

  isSet(place) {
    return [...this.places.values()].includes(place);
  }

  // Why a key cannot be set for a name, in one line; empty where it was set.
  set(name, place, legend) {
    if (place === "") return say("script.key_unknown");
    if (!PLACE.test(place) || TAKEN.has(place) || MODIFIER.test(place)) return say("script.key_taken", { key: legend });
    const other = [...this.names].find((one) => one !== name && this.placeOf(one) === place);
    if (other) return say("script.key_conflict", { key: legend, what: whatDoes(other) });
    if (place === name) this.places.delete(name);
    else this.places.set(name, place);
    this.keep();
    return "";
  }

  reset() {
    this.places.clear();
    this.keep();
  }

  keep() {
    remember(KEPT, JSON.stringify(Object.fromEntries(this.places)));
  }
}

export function whatDoes(name) {
  return document.querySelector(`[data-key="${name}"] .key-direction`).textContent;
}

function kept() {
  try {
    return JSON.parse(remembered(KEPT)) ?? {};
  } catch {
    return {}; // what is there was not written here
  }
}

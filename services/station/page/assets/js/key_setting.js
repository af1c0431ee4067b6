// Setting the keys: press "Set the keys", choose what is to be done, press the key for it. Nothing steers meanwhile.

import { whatDoes } from "/assets/js/key_settings.js";
import { isSpace, isStop } from "/assets/js/keyboard.js";
import { say } from "/assets/js/words.js";

export class KeySetting {
  constructor(keyboard, opened) {
    this.keyboard = keyboard;
    this.opened = opened;
    this.panel = document.querySelector(".devices");
    this.opener = document.querySelector(".keys-set");
    this.note = document.querySelector(".keys-note");
    this.chosen = "";
    this.opener.addEventListener("click", ({ detail }) => {
      this.open(!this.isOpen);
      if (detail > 0) this.opener.blur();
    });
    document.querySelector(".keys-reset").addEventListener("click", () => this.reset());
    for (const [name, element] of keyboard.keys) element.addEventListener("click", () => this.isOpen && this.choose(name));
  }

  get isOpen() {
    return this.panel.hasAttribute("data-setting");
  }

  open(isOpen) {
    this.panel.toggleAttribute("data-setting", isOpen);
    this.opener.textContent = say(isOpen ? "script.keys_done" : "script.keys_set");
    this.opener.setAttribute("aria-expanded", String(isOpen));
    for (const element of this.keyboard.keys.values()) {
      if (isOpen) Object.entries({ role: "button", tabindex: "0" }).forEach(([name, value]) => element.setAttribute(name, value));
      else ["role", "tabindex"].forEach((name) => element.removeAttribute(name));
    }
    this.choose("");
    this.opened();
  }

  choose(name) {
    this.chosen = name;
    for (const [one, element] of this.keyboard.keys) element.toggleAttribute("data-chosen", one === name);
    this.tell(this.isOpen ? say(name ? "script.key_press" : "script.key_choose", { what: name && whatDoes(name) }) : "");
  }

  tell(words) {
    this.note.textContent = words;
  }

  reset() {
    this.keyboard.settings.reset();
    this.keyboard.show();
    this.choose("");
  }

  // Whether a key that was pressed is for the setting, and not for the robot; the stop is never.
  takes(event) {
    if (!this.isOpen) return false;
    if (isStop(event)) {
      this.open(false);
      return false;
    }
    const element = event.target?.closest?.("[data-key]");
    if ((event.key === "Enter" || isSpace(event)) && element && this.chosen === "") {
      this.choose(element.dataset.key);
      event.preventDefault?.();
    } else if (this.chosen !== "" && event.key !== "Tab") {
      this.set(event);
      event.preventDefault?.();
    }
    return true;
  }

  set(event) {
    if (event.repeat || ["Shift", "Control", "Alt", "Meta"].includes(event.key)) return;
    const place = this.keyboard.placeToSet(event);
    const refused = this.keyboard.settings.set(this.chosen, place, this.keyboard.legendAt(place));
    if (refused) {
      this.tell(refused);
      return;
    }
    this.keyboard.show();
    this.choose("");
  }
}

// What the skill has learnt, an entry a row: what it changed is shown where a row is looked at or was pressed, in the 3-D
// view, in words and as a small picture; each entry is taken back or used again. And how far what is taught next is to be
// believed.

import { Effects } from "/assets/js/effects.js";
import { mapOf } from "/assets/js/history_map.js";
import { timeOf } from "/assets/js/time.js";
import { say } from "/assets/js/words.js";

const MAPS_AT_ONCE = 8; // of the newest entries; the others' are worked out when they are looked at

export class History {
  // press: does what a control says.
  constructor(liveView, press) {
    Object.assign(this, { liveView, press, rows: new Map(), looked: null, pressed: null });
    this.effects = new Effects((id) => this.tell(id));
    this.panel = document.querySelector(".history");
    this.legend = document.querySelector(".legend-changed");
    this.list = this.panel.querySelector(".entries");
    this.slider = this.panel.querySelector("#confidence");
    this.slider.addEventListener("change", () => this.press("confidence", this.slider.value));
    this.slider.addEventListener("pointerup", () => setTimeout(() => this.slider.blur()));
    // A pointer gives the focus back, so that keys steer: what it pressed stays shown without it.
    this.list.addEventListener("click", ({ target, detail }) => {
      const button = target.closest(".entry-show");
      if (!button) return;
      if (detail > 0) button.blur();
      this.hold(idOf(button));
    });
    this.list.addEventListener("pointerover", ({ target }) => this.look(idOf(target)));
    this.list.addEventListener("pointerleave", () => this.look(idOf(document.activeElement)));
    this.list.addEventListener("focusin", ({ target }) => this.look(idOf(target)));
    this.list.addEventListener("focusout", ({ relatedTarget }) => this.look(idOf(relatedTarget)));
  }

  // listed: the history where it is new to this tab.
  show(listed) {
    const share = this.panel.querySelector(".confidence").dataset.share;
    if (share && document.activeElement !== this.slider) this.slider.value = share;
    if (listed) this.arrange(listed);
    const isSeated = document.body.dataset.link === "armed";
    const allowed = isSeated ? this.panel.dataset.allowed.split(" ") : [];
    for (const button of this.list.querySelectorAll(".turn")) button.disabled = !allowed.includes(button.dataset.action);
    this.slider.disabled = !allowed.includes("confidence");
  }

  arrange({ edition, rows }) {
    this.effects.renew(edition);
    const before = this.rows;
    this.rows = new Map(rows.map((row) => [row.id, before.get(row.id) ?? newRow(row.id)]));
    rows.forEach((row) => fill(this.rows.get(row.id), row));
    const elements = [...this.rows.values()];
    if (elements.some((element, i) => this.list.children[i] !== element) || before.size !== elements.length) {
      const { activeElement } = document;
      this.list.replaceChildren(...elements);
      if (this.list.contains(activeElement)) activeElement.focus({ preventScroll: true });
    }
    for (const which of ["looked", "pressed"]) if (!this.rows.has(this[which])) this[which] = null;
    this.turnTo();
    rows.slice(0, MAPS_AT_ONCE).forEach(({ id }) => this.effects.ask(id));
  }

  // The entry under the pointer or with the focus; null where there is none.
  look(id) {
    if (id === this.looked) return;
    this.looked = id;
    this.turnTo();
  }

  // Shows what an entry changed until it is pressed again.
  hold(id) {
    this.pressed = id === this.pressed ? null : id;
    this.turnTo();
  }

  turnTo() {
    this.effects.prefer(this.looked ?? this.pressed);
    for (const id of [this.looked, this.pressed]) if (id !== null) this.effects.ask(id);
    this.draw();
  }

  draw() {
    const shown = this.looked ?? this.pressed;
    for (const [id, row] of this.rows) {
      row.toggleAttribute("data-looked", id === shown);
      row.querySelector(".entry-show").setAttribute("aria-pressed", String(id === this.pressed));
      row.querySelector(".entry-told").textContent = id === this.pressed ? this.effects.words(id) : "";
    }
    const drawn = this.effects.drawn(shown);
    this.liveView.compare(drawn);
    document.body.toggleAttribute("data-comparing", Boolean(drawn));
    this.legend.textContent = shown === null ? "" : this.effects.words(shown);
  }

  // There is something new to say of an entry.
  tell(id) {
    const map = this.rows.get(id).querySelector(".entry-map");
    const drawn = this.effects.drawn(id);
    const words = this.effects.words(id);
    map.replaceChildren(...(drawn?.field ? [mapOf(drawn)] : []));
    map.setAttribute("aria-label", words);
    map.title = words;
    if (id === this.pressed || id === this.looked) this.draw();
  }
}

function idOf(element) {
  const row = element?.closest?.(".entry");
  return row ? Number(row.dataset.entry) : null;
}

function newRow(id) {
  const row = document.createElement("li");
  row.className = "entry";
  row.dataset.entry = id;
  row.innerHTML = `<button type="button" class="entry-show"><span class="entry-what"></span>
    <span class="entry-who"></span><span
    class="entry-rest"><span class="entry-moved"></span><span class="entry-how"></span><span
    class="entry-turned"></span></span></button>
    <div class="entry-map" role="img"></div><button type="button" class="button turn"></button>
    <div class="entry-told"></div>`;
  const look = row.querySelector(".entry-show");
  look.title = say("entry.show");
  look.setAttribute("aria-pressed", "false");
  row.querySelector(".entry-map").setAttribute("aria-label", say("entry.working"));
  return row;
}

function fill(row, { id, what, how, who, at, moved, believed, in_use: isUsed, turned, turned_at: turnedAt }) {
  row.dataset.used = isUsed ? "yes" : "no";
  const words = {
    what,
    who: [who, timeOf(at)].filter(Boolean).join(", "),
    how: [how, believed].filter(Boolean).join(", "),
    moved,
    turned: turned && [turned, timeOf(turnedAt)].filter(Boolean).join(", "),
  };
  for (const [name, text] of Object.entries(words)) row.querySelector(`.entry-${name}`).textContent = text;
  row.querySelector(".entry-rest").title = [words.moved, words.how, words.turned].filter(Boolean).join(", ");
  const action = isUsed ? "take_back" : "use_again";
  const button = row.querySelector(".turn");
  button.textContent = say(`entry.${action}`);
  button.setAttribute("aria-label", `${say(`entry.${action}`)}: ${what}`);
  Object.assign(button.dataset, {
    action,
    argument: id,
    confirm: say(`entry.ask_${action}`, { what }),
    confirmYes: say(`entry.yes_${action}`),
  });
}

// What the skill has learnt, an entry a row: what it changed is shown where a row is looked at, in the 3-D view and as a
// small picture; each entry is taken back or used again. And how far what is taught next is to be believed.

import { mapOf, summaryOf } from "/assets/js/history_map.js";
import { timeOf } from "/assets/js/time.js";
import { say } from "/assets/js/words.js";

const AGAIN_MS = 300;
const MAPS_AT_ONCE = 8; // of the newest entries; the others' are worked out when they are looked at

export class History {
  // press: does what a control says.
  constructor(liveView, press) {
    Object.assign(this, { liveView, press, rows: new Map(), effects: new Map(), version: 0, looked: null });
    this.panel = document.querySelector(".history");
    this.legend = document.querySelector(".legend-changed");
    this.list = this.panel.querySelector(".entries");
    this.slider = this.panel.querySelector("#confidence");
    this.slider.addEventListener("change", () => this.press("confidence", this.slider.value));
    this.slider.addEventListener("pointerup", () => setTimeout(() => this.slider.blur()));
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
    const turns = isSeated ? this.panel.dataset.turns.split(" ") : [];
    for (const button of this.list.querySelectorAll(".turn")) button.disabled = !turns.includes(button.dataset.action);
    this.slider.disabled = !isSeated;
  }

  arrange({ version, rows }) {
    if (version !== this.version) this.effects.clear();
    this.version = version;
    const before = this.rows;
    this.rows = new Map(rows.map((row) => [row.id, before.get(row.id) ?? newRow(row.id)]));
    rows.forEach((row) => fill(this.rows.get(row.id), row));
    const elements = [...this.rows.values()];
    if (elements.some((element, i) => this.list.children[i] !== element) || before.size !== elements.length) {
      const { activeElement } = document;
      this.list.replaceChildren(...elements);
      if (this.list.contains(activeElement)) activeElement.focus({ preventScroll: true });
    }
    rows.slice(0, MAPS_AT_ONCE).forEach(({ id }) => this.ask(id));
    if (this.looked !== null) this.look(this.rows.has(this.looked) ? this.looked : null);
  }

  // Shows what the entry changed; null where none is looked at.
  look(id) {
    if (id !== this.looked) {
      this.rows.get(this.looked)?.removeAttribute("data-looked");
      this.rows.get(id)?.setAttribute("data-looked", "");
      this.looked = id;
    }
    if (id !== null) this.ask(id);
    const effect = this.effects.get(id) ?? null;
    this.liveView.compare(effect);
    document.body.toggleAttribute("data-comparing", Boolean(effect));
    this.legend.textContent = effect ? summaryOf(effect) : "";
  }

  // Until it is there: the model works it out when it has nothing better to do.
  async ask(id) {
    if (this.effects.has(id)) return;
    const { version } = this;
    this.effects.set(id, undefined);
    const answer = await fetch(`/history/${version}/${id}`).catch(() => null);
    if (version !== this.version || !this.rows.has(id)) return;
    if (answer?.status === 200) {
      this.effects.set(id, await answer.json());
      showMap(this.rows.get(id), this.effects.get(id));
      if (this.looked === id) this.look(id);
    } else {
      this.effects.delete(id);
      if (answer?.status !== 204) setTimeout(() => version === this.version && this.ask(id), AGAIN_MS);
    }
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
    <span class="entry-who"></span><span class="entry-how"></span><span class="entry-moved"></span>
    <span class="entry-turned"></span></button>
    <div class="entry-map" role="img"></div><button type="button" class="button turn"></button>`;
  const look = row.querySelector(".entry-show");
  look.title = say("entry.show");
  look.addEventListener("click", ({ detail }) => detail > 0 && look.blur());
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

function showMap(row, effect) {
  const map = row.querySelector(".entry-map");
  map.replaceChildren(...(effect?.field ? [mapOf(effect)] : []));
  map.setAttribute("aria-label", summaryOf(effect));
  map.title = summaryOf(effect);
}

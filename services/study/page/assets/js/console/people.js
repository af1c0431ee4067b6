// All participants, and the field that enrols the next one.

import { make, replace } from "/assets/js/dom.js";
import { partTitle } from "/assets/js/parts.js";
import { nameOf, say, spoken } from "/assets/js/words.js";

const TONES = { runs: "good", interrupted: "bad", paused: "warn", gone: "none", finished: "good" };

export class People {
  constructor(link, choose) {
    this.link = link;
    this.choose = choose;
    this.title = make("h2.title");
    this.list = make("div.people");
    this.number = make("input.text.short", { inputMode: "numeric", pattern: "[0-9]{1,4}", required: true, autocomplete: "off" });
    this.number.addEventListener("input", () => (this.typed = true));
    this.name = make("input.text", { autocomplete: "off", maxLength: 200 });
    this.language = make("select.text");
    this.send = make("button.button.go", { type: "submit" });
    this.label = make("span");
    this.identity = make("span");
    this.problem = make("p.problem", { role: "alert" });
    this.form = make(
      "form.enrol",
      { onsubmit: (event) => this.enrol(event) },
      make("label.field", {}, this.label, this.number),
      this.language,
      make("label.field.identity", {}, this.identity, this.name),
      this.send,
      this.problem,
    );
    this.element = make("section.panel.people-panel", {}, this.title, this.list, this.form);
  }

  show(view) {
    this.title.textContent = `${say("console.participants")} · ${view.rows.filter((row) => !row.gone).length} / ${view.aimed}`;
    this.send.textContent = say("console.enrol");
    this.label.textContent = say("console.number");
    this.identity.textContent = say("console.identity");
    this.language.setAttribute("aria-label", say("page.languages"));
    if (!this.typed) this.number.value = view.proposed;
    const languages = view.languages.map((tag) => make("option", { value: tag }, nameOf(tag)));
    if (!this.language.options.length) {
      this.language.replaceChildren(...languages);
      this.language.value = view.languages.includes(spoken()) ? spoken() : view.languages[0];
    }
    const rows = view.rows.map((row) => this.row(row, row.number === view.number));
    replace(this.list, rows.length ? rows : [make("p.quiet", {}, say("console.nobody"))]);
  }

  row(row, chosen) {
    const state = say(`state.${row.state}`);
    const where = row.part ? partTitle(row.part) : row.state === "gone" ? row.gone : "";
    return make(
      "button.person",
      {
        type: "button",
        onclick: () => this.choose(row.number),
        "aria-pressed": `${chosen}`,
        data: { tone: TONES[row.state] ?? "none", focus: `person-${row.number}`, number: row.number },
      },
      make("b.person-number", {}, `${row.number}`),
      make("span.person-where", {}, where),
      make("span.person-state", {}, make("span.mark"), state),
      row.invalid ? make("span.person-invalid", {}, say("console.invalid_count", { count: row.invalid })) : null,
      make("span.person-bar", {}, make("i", { style: `width: ${row.gone ? 0 : (100 * (row.part ? row.step - 1 : row.steps)) / row.steps}%` })),
    );
  }

  async enrol(event) {
    event.preventDefault();
    const number = Number(this.number.value);
    const who = { number, language: this.language.value, name: this.name.value };
    const { refused } = await this.link.act({ act: "enrol", ...who });
    this.problem.textContent = refused;
    if (refused) return;
    this.typed = false;
    this.name.value = "";
    this.choose(number);
  }
}

// What was written down, and the field that writes more.

import { make, replace } from "/assets/js/dom.js";
import { say } from "/assets/js/words.js";
import { clock } from "/assets/js/console/time.js";

export class Notes {
  constructor(link) {
    this.link = link;
    this.text = make("textarea.text", { rows: 2, maxLength: 4000, required: true });
    this.about = make("select.text");
    this.send = make("button.button.go", { type: "submit" });
    this.problem = make("p.problem", { role: "alert" });
    this.list = make("div.notes");
    this.form = make(
      "form.note-form",
      { onsubmit: (event) => this.write(event) },
      this.text,
      make("div.row", {}, this.about, this.send),
      this.problem,
    );
    this.element = make("div", {}, this.form, this.list);
  }

  show({ notes, rows, number }) {
    this.text.setAttribute("aria-label", say("console.note_text"));
    this.text.placeholder = say("console.note_text");
    this.about.setAttribute("aria-label", say("console.note_about"));
    this.send.textContent = say("console.note");
    const chosen = document.activeElement === this.about ? this.about.value : `${number ?? ""}`;
    replace(this.about, [
      make("option", { value: "" }, say("console.study")),
      ...rows.map((row) => make("option", { value: row.number }, say("page.participant", row))),
    ]);
    this.about.value = chosen;
    replace(this.list, notes.length ? notes.map(note) : [make("p.quiet", {}, say("console.no_notes"))]);
  }

  async write(event) {
    event.preventDefault();
    const number = this.about.value ? Number(this.about.value) : null;
    const { refused } = await this.link.act({ act: "note", number, text: this.text.value });
    this.problem.textContent = refused;
    if (!refused) this.text.value = "";
  }
}

function note({ at, number, kind, text }) {
  return make(
    "div.note",
    { data: { kind } },
    make("time.quiet", { dateTime: at }, clock(at)),
    make("span.badge", {}, number ?? say("console.study")),
    make("b", {}, say(`kind.${kind}`)),
    make("span.note-text", {}, text),
  );
}

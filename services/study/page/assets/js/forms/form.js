// A questionnaire: its scales, choices and texts on one page, its pairs as cards on the next. Nothing leaves the browser
// until it is complete.

import { Draft } from "/assets/js/draft.js";
import { button, make } from "/assets/js/dom.js";
import { Pairs } from "/assets/js/forms/pairs.js";
import { questionElement } from "/assets/js/forms/questions.js";
import { paragraphs, pick, say, spoken } from "/assets/js/words.js";

const PAIRS = "pairs";

export class Form {
  constructor({ number, part, stage }, link) {
    this.part = part;
    this.stage = stage;
    this.link = link;
    this.draft = new Draft(number, part.name, stage.version);
    this.questions = new Map(stage.questions.map((question) => [question.name, question]));
    const paired = stage.questions.filter((question) => question.kind === PAIRS);
    this.pages = [this.plainPage(), ...paired.map((question) => this.pairsPage(question))];
    this.problem = make("div.problem", { role: "alert" });
    this.body = make("div");
    this.element = make("form.sheet.form", { novalidate: true, onsubmit: (event) => this.submit(event) }, this.body);
    this.turn(Math.min(this.draft.page, this.pages.length - 1));
  }

  plainPage() {
    const names = this.stage.order.filter((name) => !name.includes("/"));
    const elements = names.map((name) =>
      questionElement(this.questions.get(name), this.draft, (value) => this.answer(name, value)),
    );
    const missing = () =>
      names.filter((name) => this.questions.get(name).required !== false && !(name in this.draft.answers));
    return { elements, missing };
  }

  pairsPage(question) {
    const scales = new Set(question.of);
    const names = this.stage.order.filter((name) => name.includes("/") && name.split("/").every((one) => scales.has(one)));
    const missing = () => names.filter((name) => !(name in this.draft.answers));
    const pairs = new Pairs(question, names, this.questions, this.draft, {
      onTurn: () => (this.send.hidden = missing().length > 0),
      onBack: () => this.turn(this.page - 1),
    });
    return { elements: [pairs.element], missing, cards: true };
  }

  turn(page) {
    this.page = page;
    this.draft.turn(page);
    this.problem.replaceChildren();
    const last = page === this.pages.length - 1;
    const { elements, missing, cards = false } = this.pages[page];
    this.send = make("button.button.go", { type: "submit" }, say(last ? "form.send" : "page.next"));
    // Cards bring the next one themselves, and go back themselves.
    this.send.hidden = cards && missing().length > 0;
    const { instructions } = this.stage;
    const head = page === 0 && Object.keys(instructions).length ? paragraphs(pick(instructions)) : [];
    this.body.replaceChildren(
      make("h1.heading", {}, pick(this.part.title)),
      ...(this.part.method ? [make("p.method", {}, say("form.about", this.part))] : []),
      ...head.map((text) => make("p.instructions", {}, text)),
      ...elements,
      this.problem,
      make("div.row.end", {}, this.send),
    );
    this.element.closest(".stage")?.scrollTo(0, 0);
  }

  answer(name, value) {
    this.draft.answer(name, value);
    this.mark(name, "");
    if (!this.pages[this.page].missing().length) this.problem.replaceChildren();
  }

  async submit(event) {
    event.preventDefault();
    const missing = this.pages[this.page].missing();
    if (missing.length) {
      this.tellMissing(missing);
      return;
    }
    if (this.page < this.pages.length - 1) {
      this.turn(this.page + 1);
      return;
    }
    const { name } = this.part;
    const act = { act: "fill", part: name, version: this.stage.version, language: spoken(), answers: this.draft.answers };
    const { refused, faults } = await this.link.act(act);
    if (!refused) return;
    for (const [question, reason] of faults) this.mark(question, reason);
    this.problem.replaceChildren(refused);
  }

  tellMissing(missing) {
    const places = missing.filter((name) => this.questions.has(name));
    for (const name of places) this.mark(name, say("form.wanted"));
    const links = places.map((name) =>
      make("li", {}, button(pick(this.questions.get(name).text), () => this.lookAt(name), { kind: "link" })),
    );
    const told = make("p", {}, say("form.missing", { count: missing.length }));
    this.problem.replaceChildren(told, ...(links.length ? [make("ul", {}, links)] : []));
    if (places.length) this.lookAt(places[0]);
  }

  lookAt(name) {
    const question = document.getElementById(`question-${name}`);
    question.scrollIntoView({ block: "center" });
    question.querySelector("input, textarea").focus({ preventScroll: true });
  }

  mark(name, fault) {
    const question = this.body.querySelector(`[data-question="${CSS.escape(name)}"]`);
    if (!question) return;
    question.toggleAttribute("data-missing", Boolean(fault));
    const place = question.querySelector(".question-fault");
    place.textContent = fault;
    place.hidden = !fault;
  }
}

// Of every two scales: which one counts more. One card at a time; a press brings the next.

import { button, make } from "/assets/js/dom.js";
import { pick, say } from "/assets/js/words.js";

export class Pairs {
  constructor(question, names, scales, draft, { onTurn, onBack }) {
    this.question = question;
    this.names = names;
    this.scales = scales;
    this.draft = draft;
    this.onTurn = onTurn;
    this.onBack = onBack;
    this.card = this.firstOpen();
    this.element = make("div.pairs");
    this.show();
  }

  firstOpen() {
    const open = this.names.findIndex((name) => !(name in this.draft.answers));
    return open < 0 ? this.names.length : open;
  }

  show({ focus = false } = {}) {
    const { card, names } = this;
    const back = button(say("page.back"), () => (card ? this.turn(card - 1) : this.onBack()), { kind: "quiet" });
    const bar = make("div.cards-bar", {}, make("i", { style: `width: ${(100 * card) / names.length}%` }));
    if (card === names.length) {
      this.element.replaceChildren(make("p.pairs-done", {}, say("form.pairs_done")), bar, make("div.row", {}, back));
      return;
    }
    const said = say("form.pair", { card: card + 1, cards: names.length });
    const sides = names[card].split("/").map((side) => this.side(names[card], side));
    this.element.replaceChildren(
      make("h2.heading", {}, pick(this.question.text)),
      make("div.cards", { role: "group", "aria-label": said }, sides),
      bar,
      make("div.row.spread", {}, back, make("span.quiet", { "aria-live": "polite" }, said)),
    );
    if (focus) this.element.querySelector(".card").focus({ preventScroll: true });
  }

  side(name, side) {
    const scale = this.scales.get(side);
    const pressed = this.draft.answers[name] === side;
    const title = make("strong.card-title", {}, pick(scale.text));
    const about = scale.about ? make("span.card-about", {}, pick(scale.about)) : null;
    const onclick = () => {
      this.draft.answer(name, side);
      this.turn(this.card + 1);
    };
    return make("button.card", { type: "button", onclick, data: { side }, "aria-pressed": `${pressed}` }, title, about);
  }

  turn(card) {
    this.card = card;
    this.show({ focus: true });
    this.onTurn();
  }
}

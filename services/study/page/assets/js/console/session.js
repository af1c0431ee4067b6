// One participant: where they are, what they have done, and what the experimenter may do about it.

import { ask } from "/assets/js/dialog.js";
import { button, make, replace } from "/assets/js/dom.js";
import { partTitle } from "/assets/js/parts.js";
import { say } from "/assets/js/words.js";
import { age, seconds } from "/assets/js/console/time.js";

export class Session {
  constructor(link) {
    this.link = link;
    this.open = new Set();
    this.problem = make("p.problem", { role: "alert" });
    this.region = make("div");
    this.element = make("div", {}, this.problem, this.region);
  }

  show(view) {
    if (view.number !== this.number) this.problem.textContent = "";
    this.number = view.number;
    replace(this.region, this.elements(view));
  }

  elements(view) {
    const row = view.rows.find(({ number }) => number === view.number);
    if (!row) return [make("p.quiet", {}, say("console.choose"))];
    return [this.head(row), ...this.decision(row, view), this.parts(row, view)];
  }

  head(row) {
    const going = row.part !== null;
    const actions = [
      going && row.state !== "paused" ? this.action("pause", () => this.pause(row)) : null,
      going && row.state === "paused" && !row.old ? this.action("go_on", () => this.goOn(row), "go") : null,
      going ? this.action("abort", () => this.abort(row)) : null,
      this.leave(row),
    ];
    return make(
      "div.session-head",
      {},
      make("h2.heading", {}, say("page.participant", row)),
      make("span.badge", {}, say(`state.${row.state}`)),
      make("span.spring"),
      ...actions,
      make(
        "p.quiet.session-about",
        {},
        `${say("console.order", { order: row.order.join(", ") })} · ${row.language.toUpperCase()} · `,
        make("a.link", { href: `/participant/${row.number}`, target: "_blank", rel: "noopener" }, say("console.their_page")),
      ),
      row.state === "gone" ? make("p.notice", {}, say("console.gone", { reason: row.gone })) : null,
    );
  }

  leave(row) {
    if (row.state === "deleted") return null;
    if (row.state === "withdrawn") return this.action("delete", () => this.delete(row));
    return this.action("withdraw", () => this.withdraw(row));
  }

  // After a crash or a long pause: how it goes on is the experimenter's to say, who sees how long ago it was.
  decision(row, view) {
    const halted = row.state === "interrupted" || row.state === "paused";
    if (!halted || (row.state === "paused" && !row.old)) return [];
    const facts = { age: age(row.age_s), limit: age(60 * view.resume_minutes) };
    const told = make("p", {}, say(row.old ? "console.decide" : "console.interrupted", facts));
    const label = row.old ? "go_on_all_the_same" : "go_on";
    const anew = row.part.kind === "training" || row.part.kind === "model";
    return [
      make(
        "div.notice.decision",
        {},
        told,
        make(
          "div.row",
          {},
          this.action(label, () => this.goOn(row), "go"),
          anew ? this.action("anew", () => this.anew(row)) : null,
        ),
      ),
    ];
  }

  parts(row, view) {
    return make("div.parts", { role: "list" }, view.parts.map((done) => this.part(row, done)));
  }

  part(row, done) {
    const { part, attempts, state } = done;
    const here = row.part?.name === part.name;
    const voided = done.void.length;
    const marks = attempts.map((one) => make("i", { data: { success: `${one.success}` } }));
    const may = (attempts.length > 0 || ["begun", "passed", "failed"].includes(state)) && !["consent", "rest"].includes(part.kind) && !row.gone;
    const line = [
      make("span.part-name", {}, partTitle(part)),
      make("span.part-state", { data: { state } }, say(`state.${state}`)),
      make("span.marks", { "aria-hidden": "true" }, marks),
      make("span.part-time", {}, done.seconds ? seconds(done.seconds) : ""),
      make("span.part-invalid", {}, done.invalid || (voided ? `${voided} ${say("console.skipped")}` : "")),
      may && !done.invalid ? this.action("invalid", () => this.invalid(row, part), "quiet", `invalid-${part.name}`) : make("span"),
    ];
    const data = { part: part.name, here: `${here}`, invalid: `${Boolean(done.invalid)}` };
    if (!attempts.length && !voided) return make("div.part", { role: "listitem", data }, make("span.part-fold"), line);
    const opened = this.open.has(part.name);
    const fold = make(
      "button.part-fold",
      {
        type: "button",
        "aria-expanded": `${opened}`,
        "aria-label": `${say("console.attempts")}: ${partTitle(part)}`,
        data: { focus: `fold-${part.name}` },
        onclick: () => this.fold(part.name),
      },
      opened ? "−" : "+",
    );
    const inside = opened ? make("div.attempts", {}, [...attempts, ...done.void].map((one, at) => attempt(one, at >= attempts.length))) : null;
    return make("div.part", { role: "listitem", data }, fold, line, inside);
  }

  fold(name) {
    if (!this.open.delete(name)) this.open.add(name);
    this.onFold();
  }

  action(name, onclick, kind = "", focus = name) {
    return button(say(`action.${name}`), onclick, { kind, data: { action: name, focus } });
  }

  async act(act) {
    const { refused } = await this.link.act(act);
    return refused;
  }

  pause({ number }) {
    const yes = (reason) => this.act({ act: "pause", number, reason });
    ask({ heading: say("ask.pause", { number }), reason: true, buttons: [cancel(), [say("action.pause"), "go", yes]] });
  }

  async goOn({ number, part }) {
    this.problem.textContent = await this.act({ act: "go_on", number, part: part.name });
  }

  anew({ number, part }) {
    const yes = () => this.act({ act: "go_on", number, part: part.name, anew: true });
    const heading = say("ask.anew", { part: partTitle(part) });
    ask({ heading, about: say("ask.anew_about"), buttons: [cancel(), [say("action.anew"), "danger", yes]] });
  }

  invalid({ number }, part) {
    const act = (repeat) => (reason) => this.act({ act: "invalid", number, part: part.name, reason, repeat });
    ask({
      heading: say("ask.invalid", { number, part: partTitle(part) }),
      about: say("ask.invalid_about"),
      reason: true,
      buttons: [cancel(), [say("ask.no_repeat"), "", act(false)], [say("ask.repeat"), "go", act(true)]],
    });
  }

  abort({ number }) {
    const yes = (reason) => this.act({ act: "abort", number, reason });
    ask({ heading: say("ask.abort", { number }), reason: true, buttons: [cancel(), [say("ask.abort_yes"), "danger", yes]] });
  }

  withdraw({ number }) {
    const act = (remove) => () => this.act({ act: "withdraw_for", number, delete: remove });
    ask({
      heading: say("ask.withdraw", { number }),
      about: say("ask.withdraw_about"),
      buttons: [cancel(), [say("withdraw.keep"), "", act(false)], [say("withdraw.delete"), "danger", act(true)]],
    });
  }

  delete({ number }) {
    const yes = () => this.act({ act: "withdraw_for", number, delete: true });
    const buttons = [cancel(), [say("ask.delete_yes"), "danger", yes]];
    ask({ heading: say("ask.delete", { number }), about: say("ask.withdraw_about"), buttons });
  }
}

function cancel() {
  return [say("action.cancel"), ""];
}

function attempt(one, voided) {
  const faults = one.faults.map((fault) => say(`attempt.${fault}`));
  return make(
    "div.attempt",
    { data: { success: `${one.success}`, voided: `${voided}` } },
    make("span", {}, `${one.number}`),
    make("span", {}, say(`attempt.${one.teaching || "alone"}`)),
    make("b", {}, say(one.success ? "attempt.success" : "attempt.failure")),
    make("span", {}, faults.join(", ")),
    make("span.part-time", {}, seconds(one.active)),
    make("span.quiet", {}, voided ? `${say("console.skipped")}: ${one.why}` : one.why),
  );
}

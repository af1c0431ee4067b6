// What a participant's page shows at each point of a session.

import { button, make } from "/assets/js/dom.js";
import { Form } from "/assets/js/forms/form.js";
import { partName } from "/assets/js/parts.js";
import { paragraphs, pick, say, spoken } from "/assets/js/words.js";

export function stageOf(view, link) {
  return { consent, form, ready, trial, rest, wait, end }[view.stage.stage](view, link);
}

function consent({ stage }, link) {
  const box = make("input", { type: "checkbox", id: "agree", onchange: () => problem.replaceChildren() });
  const problem = make("p.problem", { role: "alert" });
  const agree = async () => {
    if (!box.checked) {
      problem.textContent = say("consent.missing");
      box.focus();
      return;
    }
    const { refused } = await link.act({ act: "consent", version: stage.version, language: spoken() });
    problem.textContent = refused;
  };
  const element = make(
    "div.sheet",
    {},
    make("h1.heading", {}, say("consent.heading")),
    paragraphs(pick(stage.text)).map((text) => make("p.consent-text", {}, text)),
    make("p.quiet", {}, say("consent.contact", stage)),
    make("p.quiet", {}, say("consent.version", stage)),
    make("label.agree", {}, box, make("span", {}, say("consent.agree"))),
    problem,
    make("div.row.end", {}, button(say("consent.begin"), agree, { kind: "go" })),
  );
  return { element };
}

function form(view, link) {
  return { element: new Form(view, link).element };
}

function ready({ part, stage }, link) {
  const problem = make("p.problem", { role: "alert" });
  const begin = async () => {
    problem.textContent = (await link.act({ act: "begin", part: part.name, language: spoken() })).refused;
  };
  const element = make(
    "div.sheet.narrow",
    {},
    make("p.method", {}, say("trial.method", part)),
    make("h1.heading", {}, partName(part)),
    Object.keys(stage.about).length ? make("p.lead", {}, pick(stage.about)) : null,
    make("p", {}, say(part.kind === "training" ? "trial.training_is" : "trial.model_is", stage)),
    stage.resumed ? make("p.notice", {}, say("trial.resumed")) : null,
    problem,
    make("div.row.end", {}, button(say(stage.resumed ? "trial.go_on" : "trial.begin"), begin, { kind: "go" })),
  );
  return { element };
}

// The robot's page keeps the keyboard: it is loaded once a part, whatever else changes.
function trial({ stage }) {
  const frame = make("iframe.robot", { src: stage.url, title: say("trial.frame"), allow: "gamepad; hid; fullscreen" });
  frame.addEventListener("load", () => frame.focus());
  return { element: frame, whole: true };
}

function rest(view, link) {
  const time = make("div.countdown", { role: "timer" });
  const text = make("p.lead");
  const problem = make("p.problem", { role: "alert" });
  const goOn = button(say("trial.go_on"), async () => {
    problem.textContent = (await link.act({ act: "end_break", part: view.part.name })).refused;
  }, { kind: "go" });
  const update = ({ stage }) => {
    const left = stage.left_s;
    const clock = `${Math.floor(left / 60)}:${String(left % 60).padStart(2, "0")}`;
    time.textContent = say("rest.left", { time: clock });
    time.hidden = left === 0;
    text.textContent = say(left ? "rest.text" : "rest.over", { method: stage.next_method });
    goOn.disabled = left > 0;
  };
  update(view);
  const element = make(
    "div.sheet.narrow",
    {},
    make("h1.heading", {}, say("rest.heading")),
    text,
    time,
    problem,
    make("div.row.end", {}, goOn),
  );
  return { element, update };
}

function wait({ stage }) {
  const heading = make("h1.heading", {}, say("wait.heading"));
  return { element: make("div.sheet.narrow", {}, heading, make("p.lead", {}, say(`wait.${stage.why}`))) };
}

function end({ stage }) {
  const heading = make("h1.heading", {}, say(`end.${stage.how}`));
  return { element: make("div.sheet.narrow", {}, heading, make("p.lead", {}, say(`end.${stage.how}_text`, stage))) };
}

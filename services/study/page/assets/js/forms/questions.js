// One question and the fields that answer it. Nothing is set before somebody sets it.

import { make } from "/assets/js/dom.js";
import { pick, say } from "/assets/js/words.js";

export function questionElement(question, draft, onAnswer) {
  const about = question.about && Object.keys(question.about).length ? pick(question.about) : "";
  const fields = { scale, choice, text, number }[question.kind](question, draft.answers[question.name], onAnswer);
  const optional = question.required === false ? make("span.optional", {}, ` (${say("form.optional")})`) : "";
  const id = `question-${question.name}`;
  return make(
    "fieldset.question",
    { id, data: { question: question.name, kind: question.kind }, "aria-describedby": `${id}-fault` },
    make("legend.question-text", {}, pick(question.text), optional),
    about ? make("p.question-about", {}, about) : null,
    fields,
    make("p.question-fault", { id: `${id}-fault`, hidden: true }),
  );
}

export function ticks({ low = 1, high = 5, step = 1 }) {
  return Array.from({ length: Math.round((high - low) / step) + 1 }, (_, number) => low + number * step);
}

function scale(question, answer, onAnswer) {
  const values = ticks(question);
  const marks = values.map((value) => {
    const input = radio(question.name, value, answer === value, () => onAnswer(value));
    const meaning = value === values[0] ? pick(question.left) : value === values.at(-1) ? pick(question.right) : "";
    input.setAttribute("aria-label", meaning ? `${value}, ${meaning}` : `${value}`);
    return make("label.tick", {}, input, make("span.mark", {}, question.numbered ? `${value}` : ""));
  });
  return make(
    `div.scale${question.numbered ? ".numbered" : ".lined"}`,
    {},
    make("div.ticks", { style: `--ticks: ${values.length}` }, marks),
    make("div.ends", { "aria-hidden": "true" }, make("span", {}, pick(question.left)), make("span", {}, pick(question.right))),
  );
}

function choice(question, answer, onAnswer) {
  const options = question.options.map((option) =>
    make(
      "label.option",
      {},
      radio(question.name, option.name, answer === option.name, () => onAnswer(option.name)),
      make("span", {}, pick(option.text)),
    ),
  );
  const long = question.options.some((option) => pick(option.text).length > 28);
  return make(`div.options${long ? ".long" : ""}`, {}, options);
}

function radio(name, value, checked, onchange) {
  return make("input", { type: "radio", name, value: `${value}`, checked, onchange });
}

function text(question, answer, onAnswer) {
  const { longest = 200, lines = 1 } = question;
  const kind = lines > 1 ? "textarea.text" : "input.text";
  const field = make(kind, {
    value: answer ?? "",
    maxLength: longest,
    autocomplete: "off",
    "aria-label": pick(question.text),
    oninput: () => onAnswer(field.value.trim() ? field.value : ""),
  });
  if (lines > 1) field.rows = lines;
  return field;
}

function number(question, answer, onAnswer) {
  const field = make("input.text.short", {
    type: "number",
    min: question.low,
    max: question.high,
    step: question.whole === false ? "any" : 1,
    value: answer ?? "",
    "aria-label": pick(question.text),
    oninput: () => onAnswer(Number.isNaN(field.valueAsNumber) ? "" : field.valueAsNumber),
  });
  return field;
}

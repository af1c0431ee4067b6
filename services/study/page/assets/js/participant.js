// The participant's page. It keeps nothing but the language and what is half filled in, in this tab: another one shows
// the same.

import { forgetOthers } from "/assets/js/draft.js";
import { brand, button, make } from "/assets/js/dom.js";
import { Link, renewed } from "/assets/js/link.js";
import { partTitle } from "/assets/js/parts.js";
import { stageOf } from "/assets/js/stages.js";
import { askToWithdraw } from "/assets/js/withdraw.js";
import { nameOf, say, speak, spoken } from "/assets/js/words.js";

const { number } = document.body.dataset;
const LANGUAGE = `language ${number}`;

const header = make("header.header");
const standing = make("span.header-standing.quiet");
const offline = make("div.offline", { role: "status", hidden: true });
const stage = make("main.stage");
document.getElementById("page").append(header, offline, stage);

const link = new Link(`/link/${number}`, { onView: show, onLost: lost, onUnknown: unknown });
let shown = null;
let shownAs = "";
let last = null;

function show(view) {
  if (renewed(view)) return;
  last = view;
  offline.hidden = true;
  speak(sessionStorage.getItem(LANGUAGE) ?? view.language);
  document.title = `${say("page.name")} · ${say("page.participant", view)}`;
  showHeader(view);
  forgetOthers(number, view.part?.name ?? "");
  const as = JSON.stringify([spoken(), view.part, identity(view.stage)]);
  if (as !== shownAs) {
    shownAs = as;
    shown = stageOf(view, link);
    stage.toggleAttribute("data-whole", Boolean(shown.whole));
    stage.replaceChildren(shown.element);
    stage.scrollTo(0, 0);
  } else {
    shown.update?.(view);
  }
}

// What changes while a stage stays as it is.
function identity({ left_s, attempts, practice, ...stage }) {
  return stage;
}

function showHeader(view) {
  standing.textContent = howItStands(view.stage);
  const ended = view.stage.stage === "end";
  const key = JSON.stringify([spoken(), view.part, view.step, ended]);
  if (header.dataset.key === key) return;
  header.dataset.key = key;
  const languages = view.languages.map((tag) =>
    make("option", { value: tag, selected: tag === spoken() }, nameOf(tag)),
  );
  const chosen = make("select.language", { "aria-label": say("page.languages"), onchange: choose }, languages);
  const progress = make(
    "div.progress",
    { title: say("page.step", view) },
    make("i", { style: `width: ${(100 * (ended ? view.steps : view.step - 1)) / view.steps}%` }),
  );
  const content = [
    brand(),
    make("span.header-title", {}, view.title),
    make("span.header-part", {}, make("span", {}, partTitle(view.part)), standing),
    make("span.spring"),
    view.rehearsal ? make("span.badge.rehearsal", {}, say("page.rehearsal")) : null,
    make("div.header-progress", {}, make("span.quiet.header-step", {}, ended ? "" : say("page.step", view)), progress),
    chosen,
    make("span.badge", {}, say("page.participant", view)),
    ended ? null : button(say("withdraw.open"), () => askToWithdraw(link), { kind: "quiet", id: "withdraw" }),
  ];
  header.replaceChildren(...content.filter(Boolean));
}

function howItStands({ stage, attempts, practice }) {
  if (stage !== "trial") return "";
  const made = say("trial.attempts", { count: attempts });
  return practice ? `${made} · ${say("trial.practice", practice)}` : made;
}

function choose({ target }) {
  sessionStorage.setItem(LANGUAGE, target.value);
  if (last) show(last);
}

function lost() {
  offline.textContent = say("page.offline");
  offline.hidden = false;
}

function unknown() {
  stage.replaceChildren(make("div.sheet.narrow", {}, make("p.lead", {}, say("page.unknown"))));
}

// The experimenter's console. It keeps nothing but what it looks at: another one shows the same study.

import { brand, make, replace } from "/assets/js/dom.js";
import { Link, renewed } from "/assets/js/link.js";
import { LANGUAGES, nameOf, say, speak, spoken } from "/assets/js/words.js";
import { allocationElements } from "/assets/js/console/allocation.js";
import { Notes } from "/assets/js/console/notes.js";
import { nowElements } from "/assets/js/console/now.js";
import { People } from "/assets/js/console/people.js";
import { Session } from "/assets/js/console/session.js";

const LANGUAGE = "console language";
const LOOKED_AT = "console looks at";
const TABS = ["session", "notes", "allocation"];

speak(firstLanguage());
const link = new Link(`/link/console${location.search}`, { onView: show, onLost: lost });
link.onOpen = () => look(sessionStorage.getItem(LOOKED_AT));

const header = make("header.header");
const offline = make("div.offline", { role: "status", hidden: true });
const now = make("section.panel.now");
const people = new People(link, (number) => {
  look(number);
  choose("session");
});
const session = new Session(link);
const notes = new Notes(link);
const tabs = make("div.tabs", { role: "tablist" });
const panels = Object.fromEntries(TABS.map((name) => [name, make("div.tab-panel", { role: "tabpanel", id: `panel-${name}` })]));
panels.session.append(session.element);
panels.notes.append(notes.element);
document.getElementById("page").append(
  header,
  offline,
  make(
    "main.console-main",
    {},
    make("div.console-side", {}, now, people.element),
    make("section.panel.console-body", {}, tabs, Object.values(panels)),
  ),
);
let tab = TABS[0];
let last = null;
session.onFold = () => show(last);

function show(view) {
  if (renewed(view)) return;
  last = view;
  offline.hidden = true;
  document.title = `${say("console.name")} · ${view.title}`;
  showHeader(view);
  showTabs();
  people.show(view);
  notes.show(view);
  replace(now, nowElements(view));
  session.show(view);
  replace(panels.allocation, allocationElements(view));
}

function showHeader(view) {
  const options = LANGUAGES.map((tag) => make("option", { value: tag }, nameOf(tag)));
  const language = make("select.language", { "aria-label": say("page.languages"), data: { focus: "language" } }, options);
  language.value = spoken();
  language.addEventListener("change", () => {
    localStorage.setItem(LANGUAGE, language.value);
    speak(language.value);
    header.removeAttribute("data-key");
    show(last);
  });
  const key = JSON.stringify([spoken(), view.title, view.protocol]);
  if (header.dataset.key === key) return;
  header.dataset.key = key;
  const content = [
    brand(),
    make("span.header-title", {}, say("console.name")),
    make("span.header-part", {}, view.title),
    make("span.spring"),
    view.rehearsal ? make("span.badge.rehearsal", {}, say("page.rehearsal")) : null,
    make("span.badge", {}, view.protocol),
    language,
  ];
  header.replaceChildren(...content.filter(Boolean));
}

function showTabs() {
  const buttons = TABS.map((name) =>
    make(
      "button.tab",
      {
        type: "button",
        role: "tab",
        onclick: () => choose(name),
        "aria-selected": `${name === tab}`,
        "aria-controls": `panel-${name}`,
        data: { focus: `tab-${name}`, tab: name },
      },
      say(`console.${name}`),
    ),
  );
  replace(tabs, buttons);
  for (const name of TABS) panels[name].hidden = name !== tab;
}

function choose(name) {
  tab = name;
  if (last) show(last);
}

function look(number) {
  if (number === null) return;
  sessionStorage.setItem(LOOKED_AT, `${number}`);
  link.tell({ look: Number(number) });
}

function lost() {
  offline.textContent = say("page.offline");
  offline.hidden = false;
}

function firstLanguage() {
  const wanted = [localStorage.getItem(LANGUAGE), ...navigator.languages.map((tag) => tag.split("-")[0]), "en"];
  return wanted.find((tag) => LANGUAGES.includes(tag));
}

// What the page says, in the language that was chosen.

const all = JSON.parse(document.getElementById("words").textContent);
const FALLBACK = "en";

let language = FALLBACK;

export function speak(wanted) {
  language = wanted;
  document.documentElement.lang = wanted;
}

export function spoken() {
  return language;
}

// The language's own name.
export function nameOf(tag) {
  return all[tag]?.["page.language"] ?? tag;
}

export const LANGUAGES = Object.keys(all);

export function say(key, facts = {}) {
  const words = (all[language] ?? all[FALLBACK])[key];
  return words.replace(/\{(\w+)\}/g, (_, name) => facts[name]);
}

// Of a text in several languages: the one in this language.
export function pick(texts) {
  return texts[language] ?? texts[FALLBACK] ?? Object.values(texts)[0] ?? "";
}

// As a file breaks its lines they mean nothing; an empty line begins a paragraph.
export function paragraphs(text) {
  return text.trim().split(/\n\s*\n/).map((one) => one.replace(/\s*\n\s*/g, " "));
}

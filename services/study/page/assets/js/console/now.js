// What runs now.

import { make } from "/assets/js/dom.js";
import { partTitle } from "/assets/js/parts.js";
import { say } from "/assets/js/words.js";
import { seconds } from "/assets/js/console/time.js";

export function nowElements({ live, rows }) {
  const title = make("h2.title", {}, say("console.now"));
  if (!live) return [title, make("p.quiet", {}, say("console.nothing"))];
  const row = rows.find(({ number }) => number === live.number);
  const fact = (name, value) => make("div.fact", {}, make("dt", {}, say(`console.${name}`)), make("dd", {}, value));
  return [
    title,
    make("p.now-part", {}, make("b", {}, say("page.participant", live)), make("span", {}, partTitle(row?.part))),
    make(
      "p.now-acting",
      { data: { tone: live.acting ? "good" : "none" } },
      make("span.mark"),
      say(live.ready ? (live.acting ? "console.acting" : "console.not_acting") : "wait.starting"),
    ),
    make(
      "dl.facts",
      {},
      fact("attempts", `${live.attempts}`),
      fact("updates", `${live.updates}`),
      fact("active", seconds(live.active)),
    ),
    live.fault ? make("p.problem", {}, live.fault) : null,
  ];
}

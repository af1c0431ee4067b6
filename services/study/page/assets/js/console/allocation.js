// Who has got which order, and which orders are still to be given.

import { make } from "/assets/js/dom.js";
import { say } from "/assets/js/words.js";

export function allocationElements({ rows, coming, aimed, seed }) {
  const line = (place, who, order, state) =>
    make("tr", {}, [`${place}`, who, order.join(" · "), state].map((text) => make("td", {}, text)));
  const given = rows.map((row, at) => line(at + 1, `${row.number}`, row.order, say(`state.${row.state}`)));
  const open = coming.map((order, at) => line(rows.length + at + 1, "–", order, say("console.open_place")));
  for (const one of open) one.classList.add("quiet");
  const heads = ["place", "who", "methods", "state"].map((name) => make("th", { scope: "col" }, say(`console.${name}`)));
  return [
    make("p.quiet", {}, say("console.allocation_about", { aimed, seed })),
    make("table.allocation", {}, make("thead", {}, make("tr", {}, heads)), make("tbody", {}, [...given, ...open])),
  ];
}

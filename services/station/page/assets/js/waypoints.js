// The waypoints that are stored, a row each: where it is, and what can be done with it.

import { say } from "/assets/js/words.js";

const EDITS = ["store", "earlier", "later", "delete"];

export class Waypoints {
  constructor() {
    this.list = document.querySelector(".waypoints");
    this.shown = "";
  }

  // Only what has changed is built anew, so that a row keeps the focus.
  show() {
    const { places, edits } = this.list.dataset;
    if (places !== this.shown) this.build(places === "" ? [] : places.split(";"));
    this.shown = places;
    const allowed = edits.split(" ");
    for (const button of this.list.querySelectorAll("button")) {
      const { action, argument } = button.dataset;
      const first = action === "earlier" && argument === "1";
      const last = action === "later" && Number(argument) === this.list.children.length;
      button.disabled = !allowed.includes(action) || first || last;
    }
  }

  build(places) {
    const held = document.activeElement?.closest?.(".waypoint button")?.dataset;
    const kept = held && { action: held.action, argument: held.argument };
    this.list.replaceChildren(...places.map((place, i) => rowOf(place.split(" "), String(i + 1))));
    if (!kept) return;
    this.list.querySelector(`[data-action="${kept.action}"][data-argument="${kept.argument}"]`)?.focus();
  }
}

function rowOf([x, y, z, opening], number) {
  const row = Object.assign(document.createElement("li"), { className: "waypoint" });
  const place = Object.assign(document.createElement("span"), { className: "waypoint-place" });
  place.textContent = say(opening === undefined ? "waypoint.place" : "waypoint.grasp", { number, x, y, z, opening });
  if (opening !== undefined) place.title = say("waypoint.grasp_of", { number, opening });
  row.append(place, ...EDITS.map((edit) => buttonOf(edit, number)));
  return row;
}

function buttonOf(edit, number) {
  const button = Object.assign(document.createElement("button"), { type: "button", className: "tool" });
  Object.assign(button.dataset, { action: edit, argument: number });
  button.textContent = say(`waypoint.${edit}`);
  button.setAttribute("aria-label", say(`waypoint.${edit}_of`, { number }));
  return button;
}

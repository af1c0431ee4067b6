// A question over the page. It is answered by a press, or left by Escape.

import { button, make } from "/assets/js/dom.js";
import { say } from "/assets/js/words.js";

let opened = null;

// buttons: [label, kind, what to do]; where that says something, it stands in the dialog, which stays.
export function ask({ heading, about = "", reason = false, buttons }) {
  opened?.close();
  const problem = make("p.problem", { role: "alert" });
  const text = reason ? make("textarea.text", { rows: 3, id: "reason", maxLength: 4000 }) : null;
  const press = async (act) => {
    if (text && !text.value.trim()) {
      problem.textContent = say("ask.reason_missing");
      text.focus();
      return;
    }
    const refused = await act(text?.value.trim());
    if (refused) problem.textContent = refused;
    else dialog.close();
  };
  const row = make(
    "div.row.end",
    {},
    buttons.map(([label, kind, act]) => button(label, () => (act ? press(act) : dialog.close()), { kind })),
  );
  const dialog = make(
    "dialog.dialog",
    { onclose: () => dialog.remove(), "aria-labelledby": "dialog-heading" },
    make("h2.heading", { id: "dialog-heading" }, heading),
    about ? make("p", {}, about) : null,
    text ? make("label.field", {}, make("span", {}, say("ask.reason")), text) : null,
    problem,
    row,
  );
  document.body.append(dialog);
  dialog.showModal();
  opened = dialog;
  return dialog;
}

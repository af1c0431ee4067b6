// The robot's skills, a row each, in the place of what the one in use has learnt while they are chosen from; those that do
// not fit say why. And a new one, by its name.

export class Skills {
  // press: does what a control says.
  constructor(press) {
    this.panel = document.querySelector(".skills");
    this.list = this.panel.querySelector(".skills-list");
    this.form = this.panel.querySelector(".skills-new");
    this.named = this.form.querySelector(".skills-named");
    this.opener = document.querySelector(".skills-open");
    this.shown = "";
    this.inUse = null;
    this.opener.addEventListener("click", () => this.open(this.panel.hidden));
    this.form.addEventListener("submit", (event) => {
      event.preventDefault();
      press("new_skill", this.named.value);
      this.form.reset();
      this.named.blur();
    });
  }

  // What is new; where another skill is in use now there is nothing left to choose.
  show() {
    const { listed, inUse, allowed } = this.panel.dataset;
    if (listed !== this.shown) this.build(JSON.parse(listed));
    this.shown = listed;
    if (this.inUse !== null && inUse !== this.inUse) this.open(false);
    this.inUse = inUse;
    const isSeated = document.body.dataset.link === "armed";
    const may = isSeated ? allowed.split(" ") : [];
    for (const button of this.list.querySelectorAll(".skills-row")) {
      const isUsed = button.dataset.argument === inUse;
      button.setAttribute("aria-pressed", String(isUsed));
      button.disabled = isUsed || !may.includes("skill") || button.dataset.fits === "no";
    }
    this.form.querySelector(".skills-make").disabled = !may.includes("new_skill");
  }

  open(isOpen) {
    this.panel.hidden = !isOpen;
    this.opener.setAttribute("aria-expanded", String(isOpen));
  }

  build(rows) {
    const held = document.activeElement?.closest?.(".skills-row")?.dataset.argument;
    this.list.replaceChildren(...rows.map(rowOf));
    const kept = [...this.list.querySelectorAll(".skills-row")].find(({ dataset }) => dataset.argument === held);
    kept?.focus({ preventScroll: true });
  }
}

function rowOf({ name, what, why, notes }) {
  const row = document.createElement("li");
  row.innerHTML = `<button type="button" class="skills-row" data-action="skill"><span class="skills-row-name"></span>
    <span class="skills-row-what"></span><span class="skills-row-why"></span><span
    class="skills-row-notes"></span></button>`;
  const button = row.firstElementChild;
  Object.assign(button.dataset, { argument: name, fits: why ? "no" : "yes" });
  for (const [part, text] of Object.entries({ name, what, why, notes })) {
    button.querySelector(`.skills-row-${part}`).textContent = text;
  }
  return row;
}

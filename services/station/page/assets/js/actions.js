// The buttons of the workflow: the one to press first stands by itself, and what takes something away is asked twice.

export class Actions {
  // press: does what a button says.
  constructor(press) {
    this.press = press;
    this.first = document.querySelector(".first");
    this.others = document.querySelector(".others");
    this.panel = document.querySelector(".confirm");
    this.asked = null;
    this.panel.querySelector(".confirm-yes").addEventListener("click", () => this.confirm());
    this.panel.querySelector(".confirm-no").addEventListener("click", () => this.withdraw());
  }

  // Where the buttons stand is where they are read and reached by Tab.
  arrange() {
    const chosen = document.querySelector('.action[data-first="yes"]:not([disabled])');
    if (this.first.firstElementChild !== chosen) {
      const { activeElement } = document;
      if (this.first.firstElementChild) this.putBack(this.first.firstElementChild);
      if (chosen) this.first.append(chosen);
      if (document.contains(activeElement)) activeElement.focus({ preventScroll: true });
    }
    if (this.asked?.disabled) this.withdraw();
  }

  ask(button) {
    if (!button || button.disabled) return;
    if (!button.dataset.confirm) {
      this.press(button);
      return;
    }
    this.asked = button;
    this.panel.querySelector(".confirm-text").textContent = button.dataset.confirm;
    this.panel.querySelector(".confirm-yes").textContent = button.dataset.confirmYes;
    this.panel.hidden = false;
    this.panel.querySelector(".confirm-no").focus();
  }

  confirm() {
    const { asked } = this;
    this.withdraw();
    if (asked && !asked.disabled) this.press(asked);
  }

  withdraw() {
    this.asked = null;
    this.panel.hidden = true;
  }

  putBack(button) {
    const after = [...this.others.children].find(({ dataset }) => Number(dataset.order) > Number(button.dataset.order));
    this.others.insertBefore(button, after ?? null);
  }
}

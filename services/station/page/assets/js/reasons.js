// What is taken from somebody needs a reason, which whoever loses it is shown: it is asked for before the press is said.

export class Reasons {
  constructor(presses) {
    this.presses = presses;
    this.form = document.querySelector(".reason");
    this.text = this.form.querySelector(".reason-text");
    this.action = null;
    this.form.addEventListener("submit", (event) => this.said(event));
    this.form.querySelector(".reason-cancel").addEventListener("click", () => this.close());
  }

  ask({ dataset }) {
    this.action = dataset.action;
    this.form.querySelector(".reason-question").textContent = dataset.question;
    this.form.toggleAttribute("data-open", true);
    this.text.value = "";
    this.text.focus();
  }

  said(event) {
    event.preventDefault();
    this.presses.press(this.action, this.text.value.trim());
    this.close();
  }

  close() {
    this.form.removeAttribute("data-open");
    this.text.blur();
  }
}

// Who is at this tab: a name, which the browser remembers, and a role, which stands in the page's address.

import { remember, remembered } from "/assets/js/memory.js";

const NAME = "retouch-name";

export class Identity {
  constructor(tab, link) {
    this.tab = tab;
    this.link = link;
    this.card = document.querySelector(".who");
    this.form = this.card.querySelector(".who-form");
    this.name = this.form.querySelector(".who-name");
    this.role = this.form.querySelector(".who-role");
    this.name.value = tab.name;
    this.role.value = tab.role || "operator";
    this.form.addEventListener("submit", (event) => this.said(event));
    this.card.querySelector(".log-out").addEventListener("submit", () => link.leave());
  }

  // What the station says counts: it knows which roles there are, and what an account allows.
  follow() {
    const { role } = this.card.dataset;
    if (!role || role === this.followed) return;
    this.followed = this.role.value = role;
  }

  said(event) {
    event.preventDefault();
    this.tab.name = this.name.value.trim();
    this.tab.role = this.role.value;
    remember(NAME, this.tab.name);
    const address = new URL(location.href);
    address.searchParams.set("role", this.tab.role);
    address.searchParams.delete("name");
    history.replaceState(null, "", address);
    this.link.sayHello();
    document.activeElement?.blur();
  }
}

// What the address says goes before what the browser remembers.
export function given() {
  const parameters = new URLSearchParams(location.search);
  const name = parameters.get("name")?.trim();
  if (name) remember(NAME, name);
  return { name: (name || (remembered(NAME) ?? "")).slice(0, 64), role: (parameters.get("role") ?? "").slice(0, 64) };
}

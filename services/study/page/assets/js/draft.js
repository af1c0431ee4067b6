// What is half filled in, kept in this tab: a reload or a server that dies loses nothing of it.

const PREFIX = "study";

export class Draft {
  constructor(number, part, version) {
    this.key = [PREFIX, number, part, version].join(" ");
    this.kept = JSON.parse(sessionStorage.getItem(this.key) ?? "{}");
  }

  get answers() {
    return this.kept.answers ?? {};
  }

  get page() {
    return this.kept.page ?? 0;
  }

  answer(name, value) {
    const answers = { ...this.answers };
    if (value === "" || value === null) delete answers[name];
    else answers[name] = value;
    this.keep({ answers });
  }

  turn(page) {
    this.keep({ page });
  }

  keep(change) {
    this.kept = { ...this.kept, ...change };
    sessionStorage.setItem(this.key, JSON.stringify(this.kept));
  }
}

// Of other parts and other people nothing stays.
export function forgetOthers(number, part) {
  const own = [PREFIX, number, part, ""].join(" ");
  for (const key of Object.keys(sessionStorage)) {
    if (key.startsWith(`${PREFIX} `) && !key.startsWith(own)) sessionStorage.removeItem(key);
  }
}

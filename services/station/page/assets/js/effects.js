// What entries of the history change, as far as it has come: each is asked for until it is there, by one chain of
// questions, what is looked at more often than what is not; and how far it is, in words.

import { summaryOf } from "/assets/js/history_map.js";
import { say } from "/assets/js/words.js";

const AGAIN_MS = 300;
const UNSEEN_AGAIN_MS = 1500; // of what nobody looks at
const ANSWERED_WITHIN_MS = 5000; // by the station, which only says whether it is there
const LATE_MS = 3000;

export class Effects {
  // came: is called with the number of an entry of which there is something new to say.
  constructor(came) {
    Object.assign(this, { came, version: null, first: null, known: new Map(), asked: new Map() });
  }

  // Of another model nothing is known yet.
  renew(version) {
    if (version === this.version) return;
    for (const { timer } of this.asked.values()) clearTimeout(timer);
    Object.assign(this, { version, known: new Map(), asked: new Map() });
  }

  // What is drawn of it; null where that is nothing, or not there yet.
  drawn(id) {
    const effect = this.known.get(id);
    return effect && !effect.refused ? effect : null;
  }

  words(id) {
    const effect = this.known.get(id);
    if (effect) return effect.refused ? say("entry.refused", { why: effect.refused }) : summaryOf(effect);
    const { since, isHeard } = this.asked.get(id);
    const waited = performance.now() - since;
    if (!isHeard) return say("entry.unanswered");
    return waited < LATE_MS ? say("entry.working") : say("entry.late", { seconds: Math.round(waited / 1e3) });
  }

  // It is looked at from now on: it comes before others, and is waited for from now; null for none.
  prefer(id) {
    if (id === this.first) return;
    this.first = id;
    if (this.asked.has(id)) this.asked.get(id).since = performance.now();
  }

  // Until it is there: the model works it out when it has nothing better to do.
  async ask(id) {
    const { version, known, asked } = this;
    const one = asked.get(id) ?? { since: performance.now(), isHeard: true, isAsking: false, timer: 0 };
    if (known.has(id) || one.isAsking) return;
    clearTimeout(one.timer);
    asked.set(id, one);
    one.isAsking = true;
    const [answer, effect] = await answered(`/history/${version}/${id}${id === this.first ? "?first=1" : ""}`);
    one.isAsking = false;
    if (asked !== this.asked) return;
    one.isHeard = answer;
    if (effect) known.set(id, effect);
    else one.timer = setTimeout(() => this.ask(id), id === this.first ? AGAIN_MS : UNSEEN_AGAIN_MS);
    this.came(id);
  }
}

// Whether there was an answer, and the effect in it.
async function answered(address) {
  try {
    const answer = await fetch(address, { signal: AbortSignal.timeout(ANSWERED_WITHIN_MS) });
    return [answer.ok, answer.status === 200 ? await answer.json() : null];
  } catch {
    return [false, null];
  }
}

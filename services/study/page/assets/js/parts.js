// What a part of a session is called.

import { pick, say } from "/assets/js/words.js";

export function partName(part) {
  if (!part) return say("part.end");
  if (part.kind === "form") return pick(part.title);
  return say(`part.${part.kind}`, part);
}

// With its method, where it has one.
export function partTitle(part) {
  return part?.method ? `${part.method} · ${partName(part)}` : partName(part);
}

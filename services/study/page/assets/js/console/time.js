// Times as the console writes them.

import { say } from "/assets/js/words.js";

export function age(seconds) {
  if (seconds < 120) return say("console.seconds", { seconds: Math.round(seconds) });
  return say("console.minutes", { minutes: Math.floor(seconds / 60) });
}

export function seconds(value) {
  return say("console.seconds", { seconds: value.toFixed(1) });
}

export function clock(iso) {
  const at = new Date(iso);
  return `${at.toLocaleDateString([], { month: "2-digit", day: "2-digit" })} ${at.toLocaleTimeString([], { hour: "2-digit", minute: "2-digit" })}`;
}

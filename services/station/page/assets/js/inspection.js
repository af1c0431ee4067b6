// The way to the viewer's page, a tab of its own. Its address is made here: only the browser knows by which name it
// reaches this machine.

import { say } from "/assets/js/words.js";

const LOOPBACK = new Set(["localhost", "127.0.0.1", "[::1]"]);
const EVERYWHERE = new Set(["0.0.0.0", "[::]"]);

export function showInspection() {
  const link = document.querySelector(".inspect");
  const here = addressHere(link.dataset.address ?? "");
  link.hidden = here === null;
  link.title = say(here === "" ? "script.inspect_elsewhere" : "script.inspect");
  if (here) link.href = here;
  else link.removeAttribute("href");
}

// Null where there is none, empty where it cannot be reached from here. On one machine it has another name than this
// page: the browser then gives it a process of its own, and its drawing does not delay the keys.
function addressHere(text) {
  if (!/^https?:\/\/[^/]/.test(text)) return null;
  const url = new URL(text);
  if (LOOPBACK.has(url.hostname) && !isHere(location.hostname)) return "";
  if (EVERYWHERE.has(url.hostname)) url.hostname = location.hostname;
  if (LOOPBACK.has(url.hostname)) url.hostname = location.hostname === "localhost" ? "127.0.0.1" : "localhost";
  return url.href;
}

function isHere(name) {
  return LOOPBACK.has(name) || name.startsWith("127.");
}

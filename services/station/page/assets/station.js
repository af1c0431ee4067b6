// The operator's page in the browser: the input state out at 50 Hz, pictures and this tab's standing in.

import { Held } from "/assets/held.js";
import { Link } from "/assets/link.js";
import { Pictures } from "/assets/pictures.js";

const INPUT_PERIOD_MS = 20;
const AGES_PERIOD_MS = 100;

await mounted();

const pictures = new Pictures();
const held = new Held(changed);
const link = new Link(() => pictures.restart(), showStanding, (buffer) => pictures.receive(buffer));

setInterval(say, INPUT_PERIOD_MS);
setInterval(showAges, AGES_PERIOD_MS);
document.addEventListener("keydown", (event) => down(event, event.code, event.repeat));
document.addEventListener("keyup", (event) => held.release(event.code));
document.addEventListener("pointerdown", pressed);
document.addEventListener("click", clicked);
window.addEventListener("message", fromViewer);

// NiceGUI puts the page's elements in place after the scripts were loaded.
async function mounted() {
  while (!document.querySelector(".station [data-key]")) await new Promise(requestAnimationFrame);
}

function say() {
  link.sendHeld(held.state(), pictures.drawn);
}

function changed() {
  say();
  for (const key of document.querySelectorAll("[data-key]")) {
    key.toggleAttribute("data-held", held.keys.has(key.dataset.key));
  }
}

function down(event, code, repeat) {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  if (!/^F\d/.test(code) && code !== "Tab") event.preventDefault();
  if (!repeat) pressKey(code);
}

function pressKey(code) {
  if (code === "Escape") link.press("stop");
  if (code === "Space") press(document.querySelector('[data-action="finish"]'));
  held.press(code);
}

// The stop counts when it is touched, not when it is let go.
function pressed(event) {
  if (event.target.closest('[data-action="stop"]')) link.press("stop");
}

function clicked(event) {
  if (event.target.closest("[data-take-input]")) link.takeInput();
  const button = event.target.closest("[data-action]");
  const touched = button?.dataset.action === "stop" && event.detail > 0;
  if (button && !touched) press(button);
  document.activeElement?.blur();
}

function press(button) {
  if (button && !button.disabled) link.press(button.dataset.action);
}

// A click into the live view gives it the keyboard; the viewer's page posts the keys back.
function fromViewer(event) {
  const viewer = document.querySelector("iframe.viewer");
  if (!viewer || event.source !== viewer.contentWindow || event.origin !== new URL(viewer.src).origin) return;
  const { kind, code, down: isDown } = event.data ?? {};
  if (kind !== "key" || typeof code !== "string") return;
  if (isDown) pressKey(code);
  else held.release(code);
}

function showStanding({ armed, let_go: letGo }) {
  document.body.dataset.link = armed ? "armed" : "view-only";
  document.body.toggleAttribute("data-let-go", armed && letGo && document.hasFocus());
}

function showAges() {
  if (!link.alive) document.body.dataset.link = "offline";
  pictures.showAges();
}

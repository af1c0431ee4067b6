"use strict";

// Keys belong to the operator's page, which holds this one in a frame: the viewer must not act on them. The browser's
// own shortcuts stay its own; what a key means, and that Escape stops, is the operator's page's to say.
function handOver(event) {
  const { code, key, keyCode, repeat, ctrlKey, altKey, metaKey, shiftKey } = event;
  const down = event.type === "keydown";
  window.parent.postMessage({ kind: "key", down, code, key, keyCode, repeat, ctrlKey, altKey, metaKey, shiftKey }, "*");
  event.stopImmediatePropagation();
  if (!ctrlKey && !altKey && !metaKey && !/^(F\d+|Tab)$/.test(code)) event.preventDefault();
}

function say(text) {
  const state = document.getElementById("state");
  state.textContent = text;
  state.hidden = text === "";
}

async function start() {
  const canvas = document.getElementById("view");
  await wasm_bindgen({ module_or_path: "re_viewer_bg.wasm" });
  const handle = new wasm_bindgen.WebHandle({
    // Under the name by which this browser reached the page.
    url: [`rerun+http://${location.hostname}:${canvas.dataset.streamPort}/proxy`],
    render_backend: "webgl",
    hide_welcome_screen: true,
    persist: false,
    theme: "dark",
    panel_state_overrides: { top: "Hidden", blueprint: "Hidden", selection: "Hidden", time: "Hidden" },
  });
  await handle.start(canvas);
  say("");
  setInterval(() => {
    if (handle.has_panicked()) {
      say("The view has stopped: reload it");
    }
  }, 1000);
}

if (window.parent !== window) {
  for (const type of ["keydown", "keyup"]) {
    window.addEventListener(type, handOver, { capture: true });
  }
  // After the viewer's own handlers, which take the focus.
  window.addEventListener("pointerup", () => setTimeout(() => window.parent.focus()), { capture: true });
}
start().catch((error) => say(`The view cannot start: ${error}`));

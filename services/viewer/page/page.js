"use strict";

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

start().catch((error) => say(`The view cannot start: ${error}`));

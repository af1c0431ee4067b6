// The views: one large, the others as insets. An inset that is pressed and the large view change places.

import { remember, remembered } from "/assets/js/memory.js";

const MAIN = "retouch-main";
const SIDES = ["left", "right"];

export function swapOnPress() {
  const scene = document.querySelector(".scene");
  show(scene, remembered(MAIN) ?? "live");
  for (const button of scene.querySelectorAll(".swap")) {
    button.addEventListener("click", ({ detail }) => {
      show(scene, button.dataset.swap);
      remember(MAIN, button.dataset.swap);
      // The button of what is large now is gone; whoever came by key goes on at the next one.
      if (detail > 0) button.blur();
      else scene.querySelector(".swap:not([hidden])")?.focus();
    });
  }
}

function show(scene, view) {
  if (!scene.querySelector(`[data-stage="${view}"]`)) return;
  scene.dataset.main = view;
  const stages = [...scene.querySelectorAll(".stage")];
  const insets = stages.filter(({ dataset }) => dataset.stage !== view);
  scene.style.setProperty("--insets", insets.length);
  for (const stage of stages) {
    const place = insets.indexOf(stage);
    stage.dataset.place = place < 0 ? "main" : SIDES[place % 2];
    stage.style.setProperty("--row", Math.max(0, Math.floor(place / 2)));
  }
  for (const button of scene.querySelectorAll(".swap")) button.hidden = button.dataset.swap === view;
}

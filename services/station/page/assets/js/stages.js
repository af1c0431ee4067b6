// The three views: one large, two as insets. An inset that is pressed and the large view change places.

const MAIN = "retouch-main";

export function swapOnPress() {
  const scene = document.querySelector(".scene");
  show(scene, remembered());
  for (const button of scene.querySelectorAll(".swap")) {
    button.addEventListener("click", ({ detail }) => {
      show(scene, button.dataset.swap);
      try {
        localStorage.setItem(MAIN, button.dataset.swap);
      } catch {
        // Then it is chosen anew next time.
      }
      // The button of what is large now is gone; whoever came by key goes on at the next one.
      if (detail > 0) button.blur();
      else scene.querySelector(".swap:not([hidden])")?.focus();
    });
  }
}

function show(scene, view) {
  if (!scene.querySelector(`[data-stage="${view}"]`)) return;
  scene.dataset.main = view;
  for (const button of scene.querySelectorAll(".swap")) button.hidden = button.dataset.swap === view;
}

function remembered() {
  try {
    return localStorage.getItem(MAIN) ?? "live";
  } catch {
    return "live";
  }
}

// Shows what the station says, value by value: a text, or after "@" an attribute or a style property of the
// element of that name.

import { timeOf } from "/assets/js/time.js";

const elements = new Map();

export function show(values) {
  for (const [name, value] of Object.entries(values)) {
    const [element, attribute] = find(name);
    if (!element) continue;
    if (attribute === undefined) element.textContent = value;
    else if (attribute.startsWith("--")) element.style.setProperty(attribute, value);
    else if (typeof value === "boolean") element.toggleAttribute(attribute, value);
    else element.setAttribute(attribute, value);
    if (attribute === "data-at") element.dataset.time = timeOf(value);
  }
}

// Looked for once each: hundreds of values come at once when a page is opened.
function find(name) {
  const [shown, attribute] = name.split("@");
  if (!elements.get(shown)?.isConnected) elements.set(shown, document.querySelector(`[data-value="${shown}"]`));
  return [elements.get(shown), attribute];
}

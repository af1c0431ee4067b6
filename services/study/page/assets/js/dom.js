// Elements made of names, properties and children; text is always text, whoever wrote it.

export function make(name, properties = {}, ...children) {
  const [tag, ...classes] = name.split(".");
  const element = document.createElement(tag || "div");
  if (classes.length) element.className = classes.join(" ");
  for (const [key, value] of Object.entries(properties)) {
    if (key.startsWith("on")) element.addEventListener(key.slice(2), value);
    else if (key === "data") Object.assign(element.dataset, value);
    else if (key in element && key !== "list" && !key.includes("-")) element[key] = value;
    else if (value !== undefined && value !== false) element.setAttribute(key, value);
  }
  element.append(...children.flat().filter((child) => child !== null && child !== undefined && child !== ""));
  return element;
}

export function button(label, onclick, properties = {}) {
  const { kind = "", ...others } = properties;
  return make(`button.button${kind ? `.${kind}` : ""}`, { type: "button", onclick, ...others }, label);
}

// Put others in the place of what an element holds, only where they differ: what is looked at or has the keyboard stays.
export function replace(element, children) {
  const next = make("div", {}, children);
  if (next.innerHTML === element.innerHTML) return;
  const focus = element.contains(document.activeElement) ? document.activeElement.dataset.focus : undefined;
  element.replaceChildren(...next.childNodes);
  if (focus) element.querySelector(`[data-focus="${CSS.escape(focus)}"]`)?.focus();
}

export function brand() {
  const space = "http://www.w3.org/2000/svg";
  const svg = document.createElementNS(space, "svg");
  svg.setAttribute("viewBox", "0 0 24 24");
  svg.setAttribute("aria-hidden", "true");
  svg.classList.add("brand");
  const use = document.createElementNS(space, "use");
  use.setAttribute("href", "/assets/symbols.svg#retouch");
  svg.append(use);
  return svg;
}

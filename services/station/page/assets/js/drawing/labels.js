// Words on the canvas, at places of the scene.

export class Labels {
  constructor(canvas) {
    this.canvas = canvas;
    this.labels = new Map();
  }

  // position: a point of the scene, three.js' own; null takes the label away.
  put(name, position, text = "", camera = null) {
    const label = this.labels.get(name) ?? this.made(name);
    const seen = position?.clone().project(camera);
    label.hidden = !seen || Math.abs(seen.x) > 1 || Math.abs(seen.y) > 1 || seen.z > 1;
    if (label.hidden) return;
    if (label.textContent !== text) label.textContent = text;
    label.style.left = `${50 * (1 + seen.x)}%`;
    label.style.top = `${50 * (1 - seen.y)}%`;
  }

  made(name) {
    const label = Object.assign(document.createElement("div"), { className: `mark-label mark-${name}`, hidden: true });
    label.setAttribute("aria-hidden", "true"); // it is drawn; what matters of it is said elsewhere
    this.canvas.after(label);
    this.labels.set(name, label);
    return label;
  }
}

// A length as one reads it off: millimetres up to a decimetre, then centimetres, then metres.
export function lengthOf(metres) {
  if (metres < 0.1) return `${Math.round(1000 * metres)} mm`;
  return metres < 1 ? `${Math.round(100 * metres)} cm` : `${metres.toFixed(1)} m`;
}

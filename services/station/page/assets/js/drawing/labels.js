// Words on the canvas, at places of the scene; where two would lie on each other the later one gives way downwards.

const APART_PX = 4;

export class Labels {
  constructor(canvas) {
    Object.assign(this, { canvas, labels: new Map(), size: [0, 0] });
    new ResizeObserver(() => (this.size = [canvas.clientWidth, canvas.clientHeight])).observe(canvas);
  }

  // position: a point of the scene, three.js' own; null takes the label away.
  put(name, position, text = "", camera = null) {
    const label = this.labels.get(name) ?? this.made(name);
    const seen = position?.clone().project(camera);
    label.hidden = !seen || Math.abs(seen.x) > 1 || Math.abs(seen.y) > 1 || seen.z > 1;
    if (label.hidden) return;
    if (label.textContent !== text) {
      label.textContent = text;
      label.box = { width: label.offsetWidth, height: label.offsetHeight };
    }
    label.style.left = `${50 * (1 + seen.x)}%`;
    label.style.top = `${50 * (1 - seen.y)}%`;
    Object.assign(label.box, { left: (this.size[0] * (1 + seen.x)) / 2, top: (this.size[1] * (1 - seen.y)) / 2 });
    this.giveWay(label);
  }

  giveWay(label) {
    const before = label.box.top;
    for (const other of this.labels.values()) {
      if (other === label) break;
      if (!other.hidden && overlap(label.box, other.box)) label.box.top = other.box.top + other.box.height + APART_PX;
    }
    label.style.translate = `0 ${label.box.top - before}px`;
  }

  made(name) {
    const label = Object.assign(document.createElement("div"), { className: `mark-label mark-${name}`, hidden: true });
    label.setAttribute("aria-hidden", "true"); // it is drawn; what matters of it is said elsewhere
    this.canvas.after(label);
    this.labels.set(name, label);
    return label;
  }
}

function overlap(one, other) {
  const isBeside = one.left > other.left + other.width || other.left > one.left + one.width;
  return !isBeside && one.top < other.top + other.height + APART_PX && other.top < one.top + one.height + APART_PX;
}

// A length as one reads it off: millimetres up to a decimetre, then centimetres, then metres.
export function lengthOf(metres) {
  if (metres < 0.1) return `${Math.round(1000 * metres)} mm`;
  return metres < 1 ? `${Math.round(100 * metres)} cm` : `${metres.toFixed(1)} m`;
}

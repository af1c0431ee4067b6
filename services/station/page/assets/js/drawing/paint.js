// Colours and materials: those of the page's style sheet, which everybody can tell apart.

import { Color, MeshBasicMaterial, MeshLambertMaterial, SRGBColorSpace } from "/assets/js/drawing/three.js";

// A colour of the style sheet, by the name of its property.
export function colourOf(name) {
  const value = getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
  return new Color(value || "#ffffff");
}

// Lit; red, green, blue and opacity from 0 to 1.
export function solid([red, green, blue, opacity]) {
  const color = new Color().setRGB(red, green, blue, SRGBColorSpace);
  return new MeshLambertMaterial({ color, opacity, transparent: opacity < 1, depthWrite: opacity === 1 });
}

// Not lit: what is a sign, and no thing.
export function plain(name, opacity = 1) {
  return new MeshBasicMaterial({ color: colourOf(name), opacity, transparent: opacity < 1, depthWrite: opacity === 1 });
}

// What the browser reads of gamepads and 3-D mice, as it reads it; nothing where it has not the interface, or does not
// let it be read.

import { say } from "/assets/js/words.js";

const AXES_AT_MOST = 16;
const BUTTONS_AT_MOST = 32;
const NAME_AT_MOST = 64;
const PADS_AT_MOST = 3;

// 3Dconnexion's own vendor, and the one it sold under before.
const SPACE_MOUSE = /space ?(mouse|navigator|pilot|explorer|ball)|3dconnexion|256f/i;

export function gamepads() {
  return connected().slice(0, PADS_AT_MOST).map(told);
}

// Why there is none, as a person can mend it; empty where there is one.
export function noGamepadBecause() {
  if (typeof navigator.getGamepads !== "function") return say("script.gamepad_unread");
  try {
    navigator.getGamepads();
  } catch {
    return say("script.gamepad_forbidden");
  }
  return connected().length === 0 ? say("script.gamepad_absent") : "";
}

function connected() {
  try {
    return [...navigator.getGamepads()].filter((gamepad) => gamepad?.connected);
  } catch {
    return [];
  }
}

function told(gamepad) {
  const name = String(gamepad.id ?? "");
  return {
    kind: SPACE_MOUSE.test(name) ? "spacemouse" : "gamepad",
    number: Number.isInteger(gamepad.index) ? Math.min(Math.max(gamepad.index, 0), 99) : 0,
    name: [...name].slice(0, NAME_AT_MOST).join(""),
    standard: gamepad.mapping === "standard",
    axes: [...(gamepad.axes ?? [])].slice(0, AXES_AT_MOST).map((axis) => bounded(axis, -1)),
    buttons: [...(gamepad.buttons ?? [])].slice(0, BUTTONS_AT_MOST).map((button) => bounded(button?.value, 0)),
  };
}

function bounded(value, least) {
  return Number.isFinite(value) ? Math.round(Math.max(least, Math.min(1, value)) * 1000) / 1000 : 0;
}

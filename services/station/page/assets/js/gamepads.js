// The axes of the gamepad that is in use; none where the browser has none, or does not let it be read.

const AXES_AT_MOST = 16;
const DEAD_ZONE = 0.12;

export function gamepadAxes() {
  try {
    const connected = [...navigator.getGamepads()].filter((gamepad) => gamepad?.connected);
    const [newest] = connected.sort((one, other) => other.timestamp - one.timestamp);
    return newest ? [...newest.axes].slice(0, AXES_AT_MOST).map(bounded) : [];
  } catch {
    return [];
  }
}

function bounded(axis) {
  if (!Number.isFinite(axis) || Math.abs(axis) < DEAD_ZONE) return 0;
  return Math.round(Math.max(-1, Math.min(1, axis)) * 1000) / 1000;
}

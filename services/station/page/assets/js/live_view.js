// The viewer's page in a frame. Its address is made here: only the browser knows by which name it reaches this machine.

const LOOPBACK = new Set(["localhost", "127.0.0.1", "[::1]"]);
const EVERYWHERE = new Set(["0.0.0.0", "[::]"]);
const ELSEWHERE = "It can be seen on its own computer only; [viewer] host in the configuration opens it to others.";

export class LiveView {
  constructor(onKey) {
    this.scene = document.querySelector(".scene");
    this.waiting = document.querySelector(".scene-empty-text").textContent;
    this.loaded = "";
    window.addEventListener("message", (event) => {
      const { kind, ...key } = event.data ?? {};
      if (kind === "key" && this.isFrom(event)) onKey(key);
    });
  }

  get frame() {
    return this.scene.querySelector("iframe");
  }

  // Loaded anew for another recording only: what else happens to this page leaves it alone.
  show() {
    const { address = "", recording = "" } = this.scene.dataset;
    if (this.loaded === `${recording} ${address}`) return;
    this.loaded = `${recording} ${address}`;
    const here = addressHere(address);
    this.scene.dataset.view = here ? "live" : "none";
    this.scene.querySelector(".scene-empty-text").textContent = here === "" ? ELSEWHERE : this.waiting;
    this.scene.querySelector(".frame").replaceChildren(...(here ? [frameOf(here, recording)] : []));
  }

  isFrom({ source, origin }) {
    return this.frame !== null && source === this.frame.contentWindow && origin === new URL(this.frame.src).origin;
  }
}

function frameOf(address, recording) {
  const frame = document.createElement("iframe");
  Object.assign(frame, { className: "viewer", title: "Live view", src: address });
  frame.dataset.recording = recording;
  return frame;
}

// Null where there is none, empty where it cannot be reached from here. On one machine it has another name than this
// page: the browser then gives it a process of its own, and its drawing does not delay the keys.
function addressHere(text) {
  if (!/^https?:\/\/[^/]/.test(text)) return null;
  const url = new URL(text);
  if (LOOPBACK.has(url.hostname) && !isHere(location.hostname)) return "";
  if (EVERYWHERE.has(url.hostname)) url.hostname = location.hostname;
  if (LOOPBACK.has(url.hostname)) url.hostname = location.hostname === "localhost" ? "127.0.0.1" : "localhost";
  return url.href;
}

function isHere(name) {
  return LOOPBACK.has(name) || name.startsWith("127.");
}

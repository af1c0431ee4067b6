// The connection to the server: views in, acts out. It comes back by itself, and shows what the server then says.

import { say } from "/assets/js/words.js";

const AGAIN_MS = 500;
const UNKNOWN = 4404;

export class Link {
  constructor(address, { onView, onLost, onUnknown = () => {} }) {
    this.address = address;
    this.onView = onView;
    this.onLost = onLost;
    this.onUnknown = onUnknown;
    this.waiting = new Map();
    this.next = 1;
    this.onOpen = () => {};
    this.open();
  }

  open() {
    const scheme = location.protocol === "https:" ? "wss" : "ws";
    this.socket = new WebSocket(`${scheme}://${location.host}${this.address}`);
    this.socket.addEventListener("open", () => this.onOpen());
    this.socket.addEventListener("message", ({ data }) => this.hear(JSON.parse(data)));
    this.socket.addEventListener("close", ({ code }) => this.closed(code));
  }

  // What becomes of it: `refused` says why it does not count, and is empty where it does.
  act(act) {
    const id = this.next++;
    if (this.socket.readyState !== WebSocket.OPEN) return Promise.resolve({ refused: say("page.offline"), faults: [] });
    return new Promise((settle) => {
      this.waiting.set(id, settle);
      this.socket.send(JSON.stringify({ id, act }));
    });
  }

  tell(message) {
    if (this.socket.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(message));
  }

  hear(message) {
    if (!("refused" in message)) {
      this.onView(message);
      return;
    }
    // The server could not tell which one it was.
    const ids = message.id ? [message.id] : [...this.waiting.keys()];
    for (const id of ids) {
      this.waiting.get(id)?.(message);
      this.waiting.delete(id);
    }
  }

  closed(code) {
    for (const settle of this.waiting.values()) settle({ refused: say("page.lost"), faults: [] });
    this.waiting.clear();
    if (code === UNKNOWN) {
      this.onUnknown();
      return;
    }
    this.onLost();
    setTimeout(() => this.open(), AGAIN_MS);
  }
}

// The page's files are others than those that this tab has loaded.
export function renewed(view) {
  if (view.version === document.body.dataset.version) return false;
  location.reload();
  return true;
}

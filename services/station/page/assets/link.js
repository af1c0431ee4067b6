// The WebSocket to the station: connects again when it is lost, and never lets input pile up.

const RETRY_MS = 500;
const SILENT_MS = 700;
const BACKLOG_BYTES = 2048;

export class Link {
  constructor(onOpen, onStanding, onPicture) {
    this.onOpen = onOpen;
    this.onStanding = onStanding;
    this.onPicture = onPicture;
    this.sequence = 0;
    this.heard = -Infinity;
    this.connect();
  }

  get alive() {
    return performance.now() - this.heard < SILENT_MS;
  }

  connect() {
    const scheme = location.protocol === "https:" ? "wss:" : "ws:";
    this.sequence = 0;
    this.socket = new WebSocket(`${scheme}//${location.host}/link`);
    this.socket.binaryType = "arraybuffer";
    this.socket.onopen = this.onOpen;
    this.socket.onmessage = ({ data }) => {
      this.heard = performance.now();
      if (typeof data === "string") this.onStanding(JSON.parse(data));
      else this.onPicture(data);
    };
    this.socket.onclose = () => {
      this.heard = -Infinity;
      setTimeout(() => this.connect(), RETRY_MS);
    };
  }

  // A state that cannot leave at once is not worth sending: a newer one follows within 20 ms.
  sendHeld(state, drawn) {
    if (this.socket.readyState !== WebSocket.OPEN || this.socket.bufferedAmount > BACKLOG_BYTES) return;
    this.sequence += 1;
    this.send({ kind: "held", sequence: this.sequence, stamp_ms: performance.now(), ...state, drawn });
  }

  press(action) {
    this.send({ kind: "pressed", action });
  }

  takeInput() {
    this.send({ kind: "take_input" });
  }

  send(message) {
    if (this.socket.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(message));
  }
}

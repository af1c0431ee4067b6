// The WebSocket to the station: connects again when it is lost or silent, and never lets input pile up.

const WATCH_MS = 50;
const RETRY_MS = 200;
const SILENT_MS = 1000;
const STOOD_STILL_MS = 500;
const BACKLOG_BYTES = 2048;
const NOT_LOGGED_IN = 4401;

// For how long a connection may take to come about: short, so that a link that is back is found at once, but a few times
// as long as the last one took, and the longer the longer the outage, so that a slow way is found at all. Not shorter:
// browsers put off what is tried again after many failures.
const CONNECT_MS = 500;
const CONNECT_MOST_MS = 4000;
const CONNECT_TIMES = 4;
const CONNECT_SHARE = 0.1;

export class Link {
  constructor(tab, { onOpen, onNews, onFrame, onSilence }) {
    Object.assign(this, { tab, onOpen, onNews, onFrame, onSilence });
    this.watched = this.openUntil = performance.now();
    this.opening = CONNECT_MOST_MS;
    this.connect();
    this.watching = setInterval(() => this.watch(), WATCH_MS);
    window.addEventListener("pagehide", () => this.abandon());
  }

  get alive() {
    return this.told && this.isOpen && performance.now() - this.since < SILENT_MS;
  }

  get isOpen() {
    return this.socket.readyState === WebSocket.OPEN;
  }

  connect() {
    const scheme = location.protocol === "https:" ? "wss:" : "ws:";
    const socket = new WebSocket(`${scheme}//${location.host}/link`);
    socket.binaryType = "arraybuffer";
    socket.onopen = () => this.opened();
    socket.onmessage = ({ data }) => this.received(data);
    socket.onclose = ({ code }) => (code === NOT_LOGGED_IN ? this.turnedAway() : this.lost());
    Object.assign(this, { socket, sequence: 0, told: false, since: performance.now() });
  }

  opened() {
    const now = performance.now();
    this.opening = now - this.since;
    this.since = this.openUntil = now;
    this.sayHello();
    this.onOpen();
  }

  sayHello() {
    const { seat, load, name, role } = this.tab;
    if (this.isOpen) this.send({ kind: "hello", seat, load, name, role });
  }

  received(data) {
    this.since = this.openUntil = performance.now();
    if (typeof data !== "string") return this.onFrame(data);
    this.told = true;
    return this.onNews(JSON.parse(data));
  }

  lost() {
    this.since = performance.now();
    this.onSilence();
  }

  // Somebody logs out: where that leads to is told by its own answer.
  leave() {
    this.leaving = true;
  }

  // Dialling again would help nobody who has to log in first.
  turnedAway() {
    this.lost();
    clearInterval(this.watching);
    if (this.leaving) return;
    const address = new URL("/login", location);
    address.search = location.search;
    address.searchParams.set("said", "ended");
    location.replace(address);
  }

  abandon() {
    this.socket.onopen = this.socket.onmessage = this.socket.onclose = null;
    this.socket.close();
    this.onSilence();
  }

  watch() {
    const now = performance.now();
    const stoodStill = now - this.watched > STOOD_STILL_MS;
    this.watched = now;
    // Where this tab itself was suspended, the silence was its own.
    if (stoodStill && this.isOpen) this.since = now;
    if (now - this.since <= this.patience) return;
    this.abandon();
    this.connect();
  }

  get patience() {
    if (this.isOpen) return SILENT_MS;
    if (this.socket.readyState !== WebSocket.CONNECTING) return RETRY_MS;
    const outage = performance.now() - this.openUntil;
    const needed = Math.max(CONNECT_MS, CONNECT_TIMES * this.opening, CONNECT_SHARE * outage);
    return Math.min(needed, CONNECT_MOST_MS);
  }

  // A state that cannot leave at once is not worth sending: a newer one follows within 20 ms.
  sayHeld(state) {
    if (this.isOpen && this.socket.bufferedAmount <= BACKLOG_BYTES) this.say("held", performance.now(), state);
  }

  sayPressed({ at, number, action, argument }) {
    this.say("pressed", at, { number, action, argument });
  }

  say(kind, stamp, content) {
    this.sequence += 1;
    this.send({ kind, sequence: this.sequence, stamp_ms: stamp, ...content });
  }

  send(message) {
    this.socket.send(JSON.stringify(message));
  }
}

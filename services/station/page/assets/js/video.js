// One camera's H.264, decoded by the browser where it can: on pages of this computer, and over HTTPS.

const PROBE = { codec: "avc1.42E01F", optimizeForLatency: true };
const LENGTH_BYTES = 4;
const PARAMETERS_AT = 5; // in a key picture: after the start code and the kind of what it begins with

export async function drawsVideo() {
  try {
    return (await VideoDecoder.isConfigSupported(PROBE)).supported;
  } catch {
    return false; // there is none
  }
}

export class Video {
  constructor() {
    this.reset();
  }

  // A promise of the last of the pictures; it is broken where one of them is none, or a key picture is missing.
  decode(content, fromKey) {
    const pictures = [...split(content)];
    if (fromKey) this.begin(pictures[0]);
    if (!this.decoder) return Promise.reject(new Error("no key picture"));
    return new Promise((resolve, reject) => {
      pictures.forEach((data, index) => {
        this.given += 1;
        const type = fromKey && index === 0 ? "key" : "delta";
        this.decoder.decode(new EncodedVideoChunk({ type, timestamp: this.given, data }));
      });
      this.promised.set(this.given, { resolve, reject });
    });
  }

  begin(key) {
    const codec = `avc1.${[...key.slice(PARAMETERS_AT, PARAMETERS_AT + 3)].map(inHex).join("")}`;
    if (this.decoder && this.codec === codec) return;
    this.reset();
    const decoder = new VideoDecoder({
      output: (frame) => this.came(frame),
      error: () => this.decoder === decoder && this.reset(),
    });
    decoder.configure({ codec, optimizeForLatency: true });
    Object.assign(this, { decoder, codec });
  }

  came(frame) {
    const promise = this.promised.get(frame.timestamp);
    this.promised.delete(frame.timestamp);
    if (promise) promise.resolve(frame);
    else frame.close();
  }

  reset() {
    for (const { reject } of this.promised?.values() ?? []) reject(new Error("not decoded"));
    if (this.decoder && this.decoder.state !== "closed") this.decoder.close();
    Object.assign(this, { decoder: null, codec: "", given: 0, promised: new Map() });
  }
}

function* split(content) {
  const view = new DataView(content.buffer, content.byteOffset, content.byteLength);
  for (let at = 0; at < content.length; ) {
    const length = view.getUint32(at, true);
    at += LENGTH_BYTES;
    yield content.subarray(at, at + length);
    at += length;
  }
}

function inHex(number) {
  return number.toString(16).padStart(2, "0");
}

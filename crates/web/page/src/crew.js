// Workers: what computes does so beside the page, which stays alive.
import LZMA from 'js-lzma';

/** Address of the worker's script, and the module's bytes once they are unpacked; both come with the page. */
let script;
let bytes;

/** The way back from `pack`. */
export function unpacked(packed) {
  const plain = new Uint8Array(Number(new DataView(packed.buffer).getBigUint64(5, true)));
  let [at, end] = [0, 0];
  LZMA.decompressFile({ readByte: () => packed[at++] }, {
    writeByte: (byte) => (plain[end++] = byte),
    writeBytes: (part) => (plain.set(part, end), (end += part.length)),
  });
  return plain.buffer;
}

export function prepare(text, base64) {
  script = URL.createObjectURL(new Blob([text], { type: 'text/javascript' }));
  const packed = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
  bytes = Promise.resolve().then(() => unpacked(packed));
}

/** A newer wish waits so long for an older one to end by itself. */
const PATIENCE = 1000; // ms
/** What ends a wish. */
const ENDS = new Set(['settled', 'mapped', 'scanned', 'walked', 'refused']);

/**
 * A worker that answers by `on[kind](message)`. `end` stops it in the middle of anything. Of wishes with an `id` the newest
 * supersedes all others: a worker that is still at an older one after a while is ended, and another begins with the newest.
 */
export function hire(on) {
  let worker = null;
  let newest = null; // wish with an id
  let busy = false; // at a wish with an id
  let timer;
  const calm = () => (clearTimeout(timer), (timer = undefined));
  const start = () => {
    worker = new Worker(script);
    worker.onmessage = ({ data }) => {
      if (data.kind === 'begun') {
        busy = true;
        if (data.id === newest?.id) calm();
      }
      if (ENDS.has(data.kind)) busy = false;
      on[data.kind]?.(data);
    };
    worker.onerror = (event) => {
      busy = false;
      on.refused?.({ message: event.message });
    };
    const mine = worker;
    bytes.then((module) => mine.postMessage({ kind: 'begin', bytes: module }));
  };
  const end = () => {
    calm();
    busy = false;
    worker?.terminate();
    worker = null;
  };
  const post = (message) => {
    if (!worker) start();
    const mine = worker;
    // After the module, and in the order asked for.
    bytes.then(() => mine.postMessage(message));
  };
  const replace = () => {
    end();
    post(newest);
  };
  return {
    ask(message) {
      if (message.id !== undefined) {
        newest = message;
        if (busy) timer ??= setTimeout(replace, PATIENCE);
      }
      post(message);
    },
    end,
  };
}

// Workers: computations run in threads of their own, so that the page keeps responding.
import LZMA from 'js-lzma';

/** Address of the worker's script, and the module's bytes once they are unpacked; both come with the page. */
let script;
let bytes;

/** The inverse of `pack`. */
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

/** Time for an older request to end before its worker is replaced. */
const PATIENCE = 1000; // ms
/** Messages that end a request. */
const ENDS = new Set(['settled', 'mapped', 'scanned', 'walked', 'refused']);

/**
 * A worker whose messages go to `on[kind](message)`. `end` terminates it. The newest request with an `id` replaces older ones:
 * a worker that still computes an older one after `PATIENCE` is terminated, and a new worker begins with the newest.
 */
export function hire(on) {
  let worker = null;
  let newest = null; // request with an id
  let busy = false; // computing a request with an id
  let timer;
  const disarm = () => (clearTimeout(timer), (timer = undefined));
  const start = () => {
    worker = new Worker(script);
    worker.onmessage = ({ data }) => {
      if (data.kind === 'begun') {
        busy = true;
        if (data.id === newest?.id) disarm();
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
    disarm();
    busy = false;
    worker?.terminate();
    worker = null;
  };
  const post = (message) => {
    if (!worker) start();
    const mine = worker;
    // After the module, and in the order of the requests.
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

// Workers: what computes does so beside the page, which stays alive.

/** Address of the worker's script, and the module's bytes once they are unpacked; both come with the page. */
let script;
let bytes;

export function prepare(text, base64) {
  script = URL.createObjectURL(new Blob([text], { type: 'text/javascript' }));
  const packed = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
  const plain = new Blob([packed]).stream().pipeThrough(new DecompressionStream('gzip'));
  bytes = new Response(plain).arrayBuffer();
}

/** A worker that answers by `on[kind](message)`. `end` stops it in the middle of anything. */
export function hire(on) {
  let worker = null;
  const start = () => {
    worker = new Worker(script);
    worker.onmessage = ({ data }) => on[data.kind]?.(data);
    worker.onerror = (event) => on.refused?.({ message: event.message });
    const mine = worker;
    bytes.then((module) => mine.postMessage({ kind: 'begin', bytes: module }));
  };
  return {
    ask(message) {
      if (!worker) start();
      const mine = worker;
      // After the module, and in the order asked for.
      bytes.then(() => mine.postMessage(message));
    },
    end() {
      worker?.terminate();
      worker = null;
    },
  };
}

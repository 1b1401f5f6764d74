// Answers moves in this browser: a worker solves one at a time, the latest waits for it, and those between are dropped.
"use strict";
window.solver = (() => {
  const inside = () => {
    const begun = async packed => {
      const code = new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip")));
      await wasm_bindgen({ module_or_path: await code.arrayBuffer() });
    };
    let ready = null;
    onmessage = async ({ data }) => {
      if (data instanceof Uint8Array) { ready = begun(data); return; }
      try {
        await ready;
        postMessage({ text: wasm_bindgen.answer(data) });
      } catch (error) {
        postMessage({ error: String(error) });
      }
    };
  };
  const text = name => document.getElementById(name).textContent;
  const packed = Uint8Array.from(atob(text("code").trim()), letter => letter.charCodeAt(0));
  const begin = () => {
    const worker = new Worker(URL.createObjectURL(new Blob([text("calls"), `\n(${inside})()`], { type: "text/javascript" })));
    worker.postMessage(packed);
    worker.onmessage = ({ data }) => {
      const { done, failed } = current;
      current = null;
      if (data.error) {
        // What has failed answers no more: another one begins.
        worker.terminate();
        solves = begin();
        failed(new Error(data.error));
      } else {
        done(new Response(data.text));
      }
      if (next) { const later = next; next = null; start(later); }
    };
    return worker;
  };
  let current = null, next = null;
  let solves = begin();
  const start = move => { current = move; solves.postMessage(move.body); };
  return body => new Promise((done, failed) => {
    const move = { body, done, failed };
    if (current) { next?.done(new Response(null, { status: 409 })); next = move; } else start(move);
  });
})();

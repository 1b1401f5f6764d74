// Answers moves in this browser: a worker solves one at a time, the latest waits for it, and those between are dropped.
"use strict";
window.solver = (() => {
  const inside = () => {
    let exports = null;
    const begun = async packed => {
      const unpacked = new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip")));
      const page = { clock_ms: () => performance.now() };
      exports = (await WebAssembly.instantiate(await unpacked.arrayBuffer(), { page })).instance.exports;
    };
    let ready = null;
    onmessage = async ({ data }) => {
      if (data instanceof Uint8Array) { ready = begun(data); return; }
      try {
        await ready;
        const words = new TextEncoder().encode(data), at = exports.room(words.length);
        new Uint8Array(exports.memory.buffer, at, words.length).set(words);
        const length = exports.answer();
        postMessage({ text: new TextDecoder().decode(new Uint8Array(exports.memory.buffer, exports.answered(), length)) });
      } catch (error) {
        postMessage({ error: String(error) });
      }
    };
  };
  const packed = Uint8Array.from(atob(document.getElementById("program").textContent.trim()), letter => letter.charCodeAt(0));
  const begin = () => {
    const worker = new Worker(URL.createObjectURL(new Blob([`(${inside})()`], { type: "text/javascript" })));
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

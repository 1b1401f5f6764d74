// The page that answers: sends what is moved, draws what comes back. Nothing is computed here.
"use strict";
(() => {
  const $ = id => document.getElementById(id);
  const main = document.querySelector("main"), page = Number(main.dataset.page);
  // The text that was loaded or written, and what is set beside it.
  const scene = { text: $("text").value, set: {} };
  // Numbers of moves: made, and shown; those under way; whether another waits to be sent.
  const moves = { made: 0, shown: 0, under: 0, waits: false, since: 0, search: null };
  // When moves were made and drawn, ms, for who measures.
  const drawn = [];
  const MOST_UNDER_WAY = 2;
  // A page that solves by itself has what answers.
  const ask = window.solver ?? (body => fetch("solve", { method: "POST", body }));

  const send = async () => {
    if (moves.under >= MOST_UNDER_WAY) { moves.waits = true; return; }
    const number = ++moves.made, since = moves.since, search = moves.search ?? {}, body = JSON.stringify({ page, number, ...scene, search });
    moves.search = null;
    moves.under += 1;
    const seeks = Object.keys(search).length > 0;
    const slow = setTimeout(() => { main.classList.add("waits"); $("time").textContent = ""; $("status").textContent = seeks ? "searching" : "solving; changed gears are reduced first"; }, 400);
    try {
      const reply = await ask(body);
      // 409: a later move has come.
      if (reply.status !== 409) {
        const came_ms = performance.now() - since;
        show(await reply.json(), number, since, came_ms);
      }
    } catch (error) {
      tell({ message: `ale-gear does not answer: ${error.message}`, hint: "does `ale-gear serve` still run?", keys: [] });
    } finally {
      clearTimeout(slow);
      moves.under -= 1;
      if (moves.under === 0) main.classList.remove("waits");
      if (moves.waits) { moves.waits = false; send(); }
    }
  };

  const set = (key, value) => {
    begun(key);
    scene.set[key] = value;
    send();
  };

  // The curves before a move that begins: of another key, or after a pause. They stay behind those that follow as ghosts.
  const PAUSE_MS = 1500;
  let last = null, ghosts = new Map(), key_moved = null;
  const begun = key => {
    const now = performance.now();
    if (key !== key_moved || now - moves.since > PAUSE_MS) ghosts = new Map((last ?? []).map(data => [data.title, data]));
    key_moved = key;
    moves.since = now;
  };
  // A chart with its ghost, where both have the same abscissa.
  const haunted = data => {
    const before = ghosts.get(data.title);
    const alike = before && ["lines", "bars", "sticks"].includes(data.kind) && String(before.data[0]) === String(data.data[0]) && before.names.length === data.names.length;
    if (!alike || JSON.stringify(before.data) === JSON.stringify(data.data)) return data;
    return { ...data, ghost: data.names.length, names: [...data.names, ...before.names.map((name, k) => k === 0 ? "before" : "")], colours: [...data.colours, ...before.colours], data: [...data.data, ...before.data.slice(1)] };
  };

  // Complaints: at the top, and beside the keys they are about.
  const tell = fault => {
    document.querySelectorAll(".complaint").forEach(words => words.remove());
    document.querySelectorAll("[aria-invalid]").forEach(input => input.removeAttribute("aria-invalid"));
    $("fault").hidden = !fault;
    if (!fault) return;
    const [message, excerpt, hint] = $("fault").children;
    message.textContent = fault.message;
    excerpt.textContent = fault.excerpt ?? "";
    excerpt.hidden = !fault.excerpt;
    hint.textContent = fault.hint ? `hint: ${fault.hint}` : "";
    $("status").textContent = "it cannot be solved as it is";
    $("time").textContent = "";
    for (const place of document.querySelectorAll("[data-key]")) {
      if (!fault.keys.includes(place.dataset.key)) continue;
      place.querySelectorAll("input, select").forEach(input => input.setAttribute("aria-invalid", "true"));
      const words = Object.assign(document.createElement("p"), { className: "complaint" });
      words.textContent = fault.hint ? `${fault.message}. Hint: ${fault.hint}` : fault.message;
      place.append(words);
      for (let table = place.closest("details"); table; table = table.parentElement.closest("details")) {
        if (place.classList.contains("row") && $("form")?.open) table.open = true;
      }
    }
  };

  // Sliders, made anew when there are others.
  let rows = "";
  const slide = (sliders, answer) => {
    const wanted = JSON.stringify(sliders);
    if (wanted !== rows && sliders.length) {
      rows = wanted;
      const groups = new Map();
      for (const slider of sliders) {
        if (!groups.has(slider.group)) {
          const box = document.createElement("fieldset");
          box.append(Object.assign(document.createElement("legend"), { textContent: slider.group }));
          groups.set(slider.group, box);
        }
        groups.get(slider.group).append(sliderOf(slider));
      }
      $("sliders").replaceChildren(...groups.values());
    }
    for (const slider of sliders) {
      const place = document.querySelector(`.slider[data-key="${slider.key}"]`), [exact, range] = ["text", "range"].map(type => place.querySelector(`[type=${type}]`));
      const value = valueOf(slider.key, answer) ?? String(slider.rest), number = Number(value);
      if (document.activeElement !== exact) exact.value = value;
      if (!Number.isFinite(number)) continue;
      // Who types a number beyond the ends widens them.
      range.min = Math.min(slider.ends[0], number);
      range.max = Math.max(slider.ends[1], number);
      // A hand that holds it is ahead of the answer.
      if (moves.under <= 1 && moves.made === answer.number) range.value = number;
      range.setAttribute("aria-valuetext", `${value} ${slider.unit}`);
    }
  };
  // What a key has in the scene: its own, or for micro-geometry that of the driving flanks.
  const valueOf = (key, { written, effective }) => written[key] ?? effective[key] ?? effective[key.replace(".modification.", ".modification.drive.")];

  const sliderOf = ({ key, label, unit, ends, step }) => {
    const place = document.createElement("div"), id = `slider-${key}`;
    place.className = "slider";
    place.dataset.key = key;
    const name = Object.assign(document.createElement("label"), { textContent: label, htmlFor: id });
    const exact = Object.assign(document.createElement("input"), { type: "text", inputMode: "decimal", autocomplete: "off" });
    exact.setAttribute("aria-label", `${label}, ${unit}, as a number`);
    const range = Object.assign(document.createElement("input"), { type: "range", id, min: ends[0], max: ends[1], step });
    range.setAttribute("aria-valuetext", unit);
    range.addEventListener("input", () => { exact.value = range.value; range.setAttribute("aria-valuetext", `${range.value} ${unit}`); set(key, range.value); });
    exact.addEventListener("change", () => set(key, exact.value));
    if ($("seek") && /\.modification\./.test(key)) {
      const tick = Object.assign(document.createElement("input"), { type: "checkbox", className: "seek", title: "the search may change it" });
      tick.setAttribute("aria-label", `the search may change the ${label}`);
      tick.addEventListener("change", () => { $("seek").disabled = !document.querySelector(".seek:checked"); });
      name.prepend(tick, " ");
    }
    place.append(name, exact, Object.assign(document.createElement("span"), { className: "unit", textContent: unit }), range);
    return place;
  };

  // The search moves what is ticked, each between the ends of its slider.
  const seek = () => {
    const ticked = [...document.querySelectorAll(".slider")].filter(place => place.querySelector(".seek:checked"));
    moves.search = Object.fromEntries(ticked.map(place => { const { min, max } = place.querySelector("[type=range]"); return [place.dataset.key, [Number(min), Number(max)]]; }));
    begun("search");
    send();
  };
  // `pinion.modification.tip_relief_um` as `pinion tip relief`, and the unit behind its value.
  const words = key => key.replace(".modification.", " ").replace(/_(um|deg)$/, "").replace(/[._]/g, " ");
  const unit = key => key.endsWith("_um") ? " µm" : key.endsWith("_deg") ? "°" : "";
  const found = ({ set: values, peak_to_peak_um: [from, to], evaluations }) => {
    Object.assign(scene.set, values);
    $("sought").textContent = `Peak to peak ${from.toPrecision(3)} µm before, ${to.toPrecision(3)} µm now, after ${evaluations} evaluations. Grind: ${Object.entries(values).map(([key, value]) => `${words(key)} ${value}${unit(key)}`).join(", ")}.`;
  };
  $("seek")?.addEventListener("click", seek);

  const fields = [...document.querySelectorAll(".row")].map(row => [row.dataset.key, row.querySelector("input, select")]);
  fields.forEach(([key, field]) => field.addEventListener("change", () => set(key, field.value)));
  const fill = answer => {
    for (const [key, field] of fields) {
      if (document.activeElement !== field) field.value = answer.written[key] ?? "";
      const standing = answer.effective[key] ?? "";
      if (field.tagName === "SELECT") field.options[0].textContent = standing && `(${standing})`; else field.placeholder = standing;
    }
  };

  // What is out of sight is drawn when it comes into sight, with the numbers of then.
  const later = new Map();
  const inSight = new Set();
  const watcher = new IntersectionObserver(seen => seen.forEach(({ target, isIntersecting }) => {
    if (!isIntersecting) { inSight.delete(target); return; }
    inSight.add(target);
    const draw = later.get(target);
    later.delete(target);
    draw?.();
  }), { rootMargin: "100px" });
  const drawIn = (place, draw) => { if (inSight.has(place)) draw(); else later.set(place, draw); };

  // Charts: each is made once, then gets other numbers.
  const charts = new Map();
  const chart = (figure, name, data, isMap) => {
    if (charts.has(name)) charts.get(name)(data); else charts.set(name, window.report.put(figure, data, isMap));
  };
  const figures = new Map();
  const figureOf = title => {
    if (!figures.has(title)) {
      const figure = Object.assign(document.createElement("figure"), { className: "chart lively" });
      figure.setAttribute("aria-label", title);
      $("charts").append(figure);
      watcher.observe(figure);
      figures.set(title, figure);
    }
    return figures.get(title);
  };

  const numbers = glance => {
    const boxes = glance.map(([what, value]) => {
      const box = document.createElement("div");
      box.append(Object.assign(document.createElement("span"), { textContent: what }), Object.assign(document.createElement("b"), { textContent: value.replace("/", "/\u2060") }));
      return box;
    });
    $("glance").replaceChildren(...boxes);
  };
  const warn = remarks => $("remarks").replaceChildren(...remarks.map(words => Object.assign(document.createElement("p"), { className: "warning", textContent: words })));

  const inSpace = view => { if (window.report.view) window.report.view.show(view); else if (!window.report.failed) window.report.open(view, $("stage")); };

  // The curve at once; after a frame with it has been handed over all else, and after another the picture in space.
  const show = (answer, number, since, came_ms) => {
    if (number < moves.shown) return;
    if (!answer.text) { tell(answer.fault); return; }
    moves.shown = number;
    const result = answer.result;
    if (answer.sought) found(answer.sought);
    if (result) chart($("first"), "first", haunted(result.charts[0]), false);
    tell(answer.fault);
    if (!result) { about(answer); return; }
    $("status").textContent = "solved";
    $("time").textContent = `in ${result.solve_ms.toFixed(0)} ms`;
    afterFrame(() => {
      const after_ms = performance.now() - since;
      if (number === moves.shown) { others(result); about(answer); }
      drawn.push({ number, after_ms, came_ms, solve_ms: result.solve_ms });
      if (result.view) afterFrame(() => { if (number === moves.shown) drawIn($("stage"), () => inSpace(result.view)); });
    });
  };
  const afterFrame = work => requestAnimationFrame(() => setTimeout(work));

  const others = result => {
    for (const data of result.charts.slice(1)) {
      const figure = figureOf(data.title), shown = haunted(data);
      drawIn(figure, () => chart(figure, data.title, shown, false));
    }
    last = result.charts;
    $("pattern").hidden = result.maps.length === 0;
    drawIn($("pattern"), () => result.maps.forEach((data, k) => chart($("pattern"), `map ${k}`, data, true)));
    numbers(result.glance);
    warn(result.remarks);
    $("name").textContent = result.name;
  };

  // The scene of the answer: in the sliders, in the form and as text.
  const about = answer => {
    slide(answer.sliders, answer);
    fill(answer);
    if (document.activeElement !== $("text") && $("text").value !== answer.text) $("text").value = answer.text;
  };

  $("text").addEventListener("change", () => { scene.text = $("text").value; scene.set = {}; send(); });
  $("back").addEventListener("click", () => { scene.set = {}; begun(null); send(); });
  $("copy").addEventListener("click", async () => {
    try {
      await navigator.clipboard.writeText($("text").value);
      $("copied").textContent = "copied";
    } catch {
      $("text").select();
      $("copied").textContent = "selected: copy it with the keyboard";
    }
    setTimeout(() => { $("copied").textContent = ""; }, 3000);
  });
  $("save").addEventListener("click", () => {
    const link = Object.assign(document.createElement("a"), { download: main.dataset.file });
    link.href = `data:application/toml;charset=utf-8,${encodeURIComponent($("text").value)}`;
    link.click();
  });

  watcher.observe($("pattern"));
  if ($("stage")) watcher.observe($("stage"));
  window.page = { drawn, moves };
  moves.since = performance.now();
  send();
})();

// Charts of a report: puts a chart that zooms and tells its values in place of each still picture.
"use strict";
(() => {
  const HEIGHT = 300;
  const VIRIDIS = ["440154", "482475", "414487", "355f8d", "2a788e", "21918c", "22a884", "44bf70", "7ad151", "bddf26", "fde725"]
    .map(c => [0, 2, 4].map(i => parseInt(c.slice(i, i + 2), 16)));

  // Colour at a share of the scale, 0 .. 1.
  const viridis = share => {
    const at = Math.min(Math.max(share, 0), 1) * (VIRIDIS.length - 1), k = Math.min(Math.floor(at), VIRIDIS.length - 2);
    return VIRIDIS[k].map((c, i) => Math.round(c + (at - k) * (VIRIDIS[k + 1][i] - c)));
  };

  const bytes = text => Uint8Array.from(atob(text), c => c.charCodeAt(0));

  // A number as short as it can be read.
  const short = (value, digits = 5) => {
    if (value === null || value === undefined || !Number.isFinite(value)) return "–";
    const size = Math.abs(value);
    if (size !== 0 && (size < 1e-3 || size >= 1e7)) return value.toExponential(digits - 2);
    return String(Number(value.toPrecision(digits)));
  };
  // Marks of an axis with as many decimals as say where they are: 0.025, not 0.03.
  const marks = (u, splits) => {
    const at = splits.filter(v => v !== null), size = Math.max(...at.map(Math.abs));
    const step = at.length > 1 ? Math.abs(at[1] - at[0]) : 1;
    const large = size >= 1e6 || (size > 0 && size < 1e-3);
    const write = (v, places) => large ? v.toExponential(places) : v.toFixed(places);
    let places = 0;
    while (places < 12 && at.some(v => Math.abs(Number(write(v, places)) - v) > 1e-2 * step)) places += 1;
    return splits.map(v => v === null ? "" : large && Math.abs(v) < 1e-2 * step ? "0" : write(v, places));
  };

  const axes = (x, y) => [
    { label: x, values: marks, size: 40, labelSize: 22, font: "12px system-ui", labelFont: "13px system-ui" },
    {
      // A long name is written smaller, so that it does not reach past the ends of its axis.
      label: y, values: marks, labelSize: 22, font: "12px system-ui", labelFont: `${Math.min(13, Math.floor(400 / y.length))}px system-ui`,
      size: (u, values) => 22 + 7.2 * Math.max(3, ...(values ?? []).map(v => v.length)),
    },
  ];

  // The whole of a scale with some room; from zero where asked.
  const room = zero => (u, low, high) => {
    if (low === null || high === null) return [0, 1];
    if (zero) { low = Math.min(low, 0); high = Math.max(high, 0); }
    const margin = high > low ? 0.06 * (high - low) : 0.05 * Math.abs(high) || 1;
    return [zero && low === 0 ? 0 : low - margin, zero && high === 0 ? 0 : high + margin];
  };

  const sizeOf = place => ({ width: Math.max(place.clientWidth, 240), height: HEIGHT });

  const lines = (plot, place) => {
    const sticks = plot.kind === "sticks";
    const series = plot.names.map((name, k) => ({
      // A curve without a name is more of the one before and needs no line in the legend.
      label: name, class: name ? undefined : "unnamed", stroke: plot.colours[k], width: plot.band && k > 0 ? 0.8 : 1.8, spanGaps: true, dash: k < plot.colours.length && k > 6 ? [6, 3] : undefined,
      points: { show: !sticks && !(plot.band && k > 0) && plot.data[0].length < 40, size: 4 },
      paths: sticks ? uPlot.paths.bars({ size: [0.0, 4, 2] }) : undefined, fill: sticks ? plot.colours[k] : undefined,
      value: (u, v) => short(v),
    }));
    return new uPlot({
      ...sizeOf(place), series: [{ label: plot.x, value: (u, v) => short(v, 7) }, ...series], axes: axes(plot.x, plot.y),
      scales: { x: { time: false }, y: { range: room(plot.zero) } },
      cursor: { sync: { key: plot.x }, drag: { x: true, y: false }, focus: { prox: 24 } },
      legend: { live: true }, bands: plot.band ? [{ series: [2, 3], fill: plot.colours[1] + "26" }] : [],
    }, plot.data, place);
  };

  // A frame with two linear axes in which `paint` draws; `tell` says in words what is at a place.
  const frame = (x, y, [left, right, low, high], place, words, paint, tell, under) => {
    const whole = { x: [left, right], y: [low, high] };
    const range = key => (u, min, max) => u.zoomed ? [min, max] : whole[key];
    const clipped = u => {
      const { ctx, bbox } = u;
      ctx.save();
      ctx.beginPath();
      ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
      ctx.clip();
      paint(u, ctx);
      ctx.restore();
    };
    return new uPlot({
      ...sizeOf(place), axes: axes(x, y).map(axis => under ? { ...axis, grid: { show: false } } : axis),
      series: [{}, { show: true, stroke: "transparent", points: { show: false } }],
      scales: { x: { time: false, range: range("x") }, y: { range: range("y") } },
      cursor: { drag: { x: true, y: true, uni: 20 }, points: { show: false } }, legend: { show: false },
      hooks: {
        [under ? "drawClear" : "draw"]: [clipped],
        setSelect: [u => { u.zoomed = u.select.width > 0; }],
        setCursor: [u => {
          const { left: at, top } = u.cursor;
          words.textContent = at < 0 ? words.dataset.hint : tell(u.posToVal(at, "x"), u.posToVal(top, "y"));
        }],
        ready: [u => u.over.addEventListener("dblclick", () => { u.zoomed = false; u.setData(u.data); })],
      },
    }, [[left, right], [low, high]], place);
  };

  // Curves with an abscissa each, drawn as a line or as dots.
  const curves = (plot, place, words) => {
    const dots = plot.kind === "dots", FEW = 100;
    const pairs = plot.names.map((name, k) => ({ name, colour: plot.colours[k], xs: plot.data[2 * k], ys: plot.data[2 * k + 1] }));
    const ends = values => {
      const finite = values.filter(v => v !== null);
      const [low, high] = [finite.reduce((a, b) => Math.min(a, b)), finite.reduce((a, b) => Math.max(a, b))];
      const margin = high > low ? 0.05 * (high - low) : 0.05 * Math.abs(high) || 1;
      return [low - margin, high + margin];
    };
    words.dataset.hint = words.textContent = plot.x + ", " + plot.y;
    if (pairs.length > 1) {
      const key = document.createElement("p");
      key.className = "small";
      for (const { name, colour } of pairs.filter(pair => pair.name)) {
        const mark = Object.assign(document.createElement("span"), { textContent: "\u25cf " });
        mark.style.color = colour;
        key.append(mark, name + "  ");
      }
      words.before(key);
    }
    const mark = (ctx, at, size) => { ctx.beginPath(); ctx.arc(at[0], at[1], size, 0, 2 * Math.PI); ctx.fill(); };
    const draw = (u, ctx) => pairs.forEach(({ colour, xs, ys }) => {
      const size = (xs.length <= FEW ? 2.5 : 1) * devicePixelRatio;
      ctx.strokeStyle = ctx.fillStyle = colour;
      ctx.lineWidth = 1.2 * devicePixelRatio;
      const line = new Path2D();
      let down = false;
      xs.forEach((x, i) => {
        if (x === null || ys[i] === null) { down = false; return; }
        const at = [u.valToPos(x, "x", true), u.valToPos(ys[i], "y", true)];
        if (dots) { mark(ctx, at, size); return; }
        if (down) line.lineTo(...at); else line.moveTo(...at);
        down = true;
      });
      if (!dots) ctx.stroke(line);
    });
    return frame(plot.x, plot.y, [...ends(pairs.flatMap(p => p.xs)), ...ends(pairs.flatMap(p => p.ys))], place, words, draw,
      (x, y) => `${plot.x}: ${short(x)}, ${plot.y}: ${short(y)}`, false);
  };

  const map = (field, place, words) => {
    const [across, up] = field.sides, [columns, rows] = [across.edges.length - 1, up.edges.length - 1];
    const raw = bytes(field.cells), cells = new Uint16Array(raw.buffer, 0, columns * rows);
    const share = cell => (cell - 1) / 65534;
    const image = Object.assign(document.createElement("canvas"), { width: columns, height: rows }), pen = image.getContext("2d"), pixels = pen.createImageData(columns, rows);
    cells.forEach((cell, i) => { if (cell) pixels.data.set([...viridis(share(cell)), 255], 4 * i); });
    pen.putImageData(pixels, 0, 0);
    const even = edges => { const h = (edges.at(-1) - edges[0]) / (edges.length - 1); return edges.every((e, i) => Math.abs(e - edges[0] - i * h) < 1e-3 * h); };
    const level = even(up.edges);
    const draw = (u, ctx) => {
      const x = v => u.valToPos(v, "x", true), y = v => u.valToPos(v, "y", true);
      const [left, right] = [x(across.edges[0]), x(across.edges.at(-1))];
      ctx.fillStyle = "#e8e8e4";
      ctx.fillRect(u.bbox.left, u.bbox.top, u.bbox.width, u.bbox.height);
      ctx.imageSmoothingEnabled = false;
      if (level) {
        // Rows count upwards, pixels downwards.
        ctx.save();
        ctx.translate(0, y(up.edges[0]));
        ctx.scale(1, -1);
        ctx.drawImage(image, left, 0, right - left, y(up.edges[0]) - y(up.edges.at(-1)));
        ctx.restore();
        return;
      }
      for (let r = 0; r < rows; r++) {
        const [bottom, top] = [y(up.edges[r]), y(up.edges[r + 1])];
        ctx.drawImage(image, 0, r, columns, 1, left, top, right - left, bottom - top + 0.5);
      }
    };
    const cell = (edges, v) => { let i = 0; while (i < edges.length - 2 && v >= edges[i + 1]) i++; return i; };
    const value = cell => field.decades
      ? field.largest * 10 ** (field.decades * (share(cell) - 1)) : field.largest * share(cell);
    const least = field.decades ? field.largest * 10 ** -field.decades : 0;
    words.dataset.hint = words.textContent = "Point at the map to read it.";
    const bar = document.createElement("div");
    bar.className = "bar";
    bar.innerHTML = `<span>${short(least, 3)}</span><i></i><span>${short(field.largest, 4)}</span><b></b>`;
    bar.querySelector("b").textContent = field.quantity + (field.decades ? ", logarithmic" : "");
    const stops = VIRIDIS.map(c => `rgb(${c.join()})`).join();
    bar.querySelector("i").style.background = `linear-gradient(to right, ${stops})`;
    const made = frame(across.label, up.label, [across.edges[0], across.edges.at(-1), up.edges[0], up.edges.at(-1)], place, words, draw,
      (x, y) => {
        const [c, r] = [cell(across.edges, x), cell(up.edges, y)], here = cells[r * columns + c];
        const beside = field.beside ? `, ${field.beside[0]}: ${short(field.beside[1][r])}` : "";
        return `${across.label}: ${short(x, 4)}, ${up.label}: ${short(y, 4)}${beside}, ${field.quantity}: ${here ? short(value(here), 4) : "–"}`;
      }, true);
    words.before(bar);
    return made;
  };

  const all = [];
  const put = (figure, script) => {
    const data = JSON.parse(script.textContent);
    const box = document.createElement("div"), title = document.createElement("h3"), place = document.createElement("div");
    const words = document.createElement("p");
    box.className = "live";
    words.className = "words";
    title.textContent = data.title;
    box.append(title, place);
    figure.append(box);
    const own = data.kind === "path" || data.kind === "dots", plain = script.className === "plot" && !own;
    if (!plain) box.append(words);
    const made = plain ? lines(data, place) : script.className === "map" ? map(data, place, words) : curves(data, place, words);
    all.push([made, place]);
  };
  for (const figure of document.querySelectorAll("figure.chart")) {
    figure.classList.add("lively");
    figure.querySelectorAll("script.plot, script.map").forEach(script => put(figure, script));
  }
  let waiting = 0;
  addEventListener("resize", () => {
    cancelAnimationFrame(waiting);
    waiting = requestAnimationFrame(() => all.forEach(([chart, place]) => chart.setSize(sizeOf(place))));
  });
  // For the other scripts of the page.
  window.report = { viridis, bytes, short, VIRIDIS, charts: all };
})();

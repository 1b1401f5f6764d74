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

  // Light or dark: colours come from the page's style, and curves too dark for a dark page are drawn lighter.
  const scheme = matchMedia("(prefers-color-scheme: dark)");
  const ink = name => getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
  const shade = colour => {
    const parts = [1, 3, 5].map(i => parseInt(colour.slice(i, i + 2), 16));
    const bright = 0.3 * parts[0] + 0.59 * parts[1] + 0.11 * parts[2];
    return scheme.matches && bright < 90 ? `rgb(${parts.map(c => Math.round(c + 0.55 * (255 - c))).join()})` : colour;
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

  const lined = { stroke: () => ink("ink"), grid: { stroke: () => ink("rule"), width: 1 }, ticks: { stroke: () => ink("rule"), width: 1 } };
  const axes = (x, y) => [
    { ...lined, label: x, values: marks, size: 40, labelSize: 22, font: "12px system-ui", labelFont: "13px system-ui" },
    {
      ...lined,
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

  // A page may want its charts lower.
  const sizeOf = place => ({ width: Math.max(place.clientWidth, 240), height: parseInt(getComputedStyle(place).getPropertyValue("--chart-height")) || HEIGHT });

  // Whole numbers (evaluations, pairs, orders) have whole marks.
  const WHOLE = [...Array(8).keys()].flatMap(k => [1, 2, 5].map(v => v * 10 ** k));
  const whole = values => values.every(v => v === null || v === undefined || Number.isInteger(v));

  const idle = u => u.root.classList.toggle("idle", u.legend?.idx === null || u.legend?.idx === undefined);

  const lines = (plot, place) => {
    const bars = plot.kind === "bars", sticks = bars || plot.kind === "sticks";
    const isGhost = k => plot.ghost !== undefined && k >= plot.ghost;
    const series = plot.names.map((name, k) => isGhost(k) ? {
      label: name, class: name ? undefined : "unnamed", stroke: () => ink("faint"), width: 1.2, spanGaps: true, dash: [5, 4],
      points: { show: sticks, size: 9 }, paths: sticks ? () => null : undefined, value: (u, v) => short(v),
    } : {
      // A curve without a name is more of the one before and needs no line in the legend.
      label: name, class: name ? undefined : "unnamed", stroke: () => shade(plot.colours[k]), width: plot.band && k > 0 ? 0.8 : 1.8, spanGaps: true, dash: k < plot.colours.length && k > 6 ? [6, 3] : undefined,
      points: { show: !sticks && !(plot.band && k > 0) && plot.data[0].length < 40, size: 4 },
      paths: sticks ? uPlot.paths.bars({ size: bars ? [0.6, 60] : [0.0, 4, 2] }) : undefined, fill: sticks ? () => shade(plot.colours[k]) : undefined,
      value: (u, v) => short(v),
    });
    return new uPlot({
      ...sizeOf(place), series: [{ label: plot.x, value: (u, v) => short(v, 7) }, ...series],
      axes: axes(plot.x, plot.y).map((axis, k) => whole(k ? plot.data.slice(1).flat() : plot.data[0]) ? { ...axis, incrs: WHOLE } : axis),
      scales: { x: { time: false, range: bars ? (u, low, high) => [low - 0.6, high + 0.6] : undefined }, y: { range: room(plot.zero) } },
      cursor: { sync: { key: plot.x }, drag: { x: true, y: false }, focus: { prox: 24 } },
      // Without a cursor there is no value to be read.
      legend: { live: true }, hooks: { ready: [idle], setLegend: [idle] }, bands: plot.band ? [{ series: [2, 3], fill: plot.colours[1] + "26" }] : [],
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
    const dots = plot.kind === "dots", [FEW, MANY] = [100, 2000];
    const pairs = plot.names.map((name, k) => ({ name, colour: plot.colours[k], xs: plot.data[2 * k], ys: plot.data[2 * k + 1] }));
    const ends = values => {
      const finite = values.filter(v => v !== null);
      const [low, high] = [finite.reduce((a, b) => Math.min(a, b)), finite.reduce((a, b) => Math.max(a, b))];
      const margin = high > low ? 0.05 * (high - low) : 0.05 * Math.abs(high) || 1;
      return [low - margin, high + margin];
    };
    words.dataset.hint = words.textContent = "Point at the chart to read it.";
    if (pairs.length > 1) {
      const key = document.createElement("p");
      key.className = "small";
      for (const { name, colour } of pairs.filter(pair => pair.name)) {
        const mark = Object.assign(document.createElement("span"), { textContent: "\u25cf " });
        mark.style.color = shade(colour);
        key.append(mark, name + "  ");
      }
      words.before(key);
    }
    const mark = (ctx, at, size) => { ctx.beginPath(); ctx.arc(at[0], at[1], size, 0, 2 * Math.PI); ctx.fill(); };
    const draw = (u, ctx) => pairs.forEach(({ colour, xs, ys }) => {
      const size = (xs.length <= FEW ? 2.5 : xs.length <= MANY ? 1.8 : 1) * devicePixelRatio;
      ctx.strokeStyle = ctx.fillStyle = shade(colour);
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

  // Lines of equal value, dots and the marked place of a map.
  const overlay = (field, u, ctx) => {
    const x = v => u.valToPos(v, "x", true), y = v => u.valToPos(v, "y", true), dense = devicePixelRatio;
    const write = (text, left, top) => {
      ctx.font = `${13 * dense}px system-ui`;
      ctx.lineWidth = 3 * dense;
      ctx.strokeStyle = "#222";
      ctx.strokeText(text, left, top);
      ctx.fillStyle = "#fff";
      ctx.fillText(text, left, top);
    };
    for (const [a, b, share] of field.dots ?? []) {
      ctx.fillStyle = `rgb(${viridis(share).join()})`;
      ctx.strokeStyle = "#555";
      ctx.lineWidth = 0.4 * dense;
      ctx.beginPath();
      ctx.arc(x(a), y(b), 3.5 * dense, 0, 2 * Math.PI);
      ctx.fill();
      ctx.stroke();
    }
    for (const { value, pieces } of field.lines ?? []) {
      const path = new Path2D();
      for (let i = 0; i < pieces.length; i += 4) {
        path.moveTo(x(pieces[i]), y(pieces[i + 1]));
        path.lineTo(x(pieces[i + 2]), y(pieces[i + 3]));
      }
      ctx.strokeStyle = "#fff";
      ctx.lineWidth = dense;
      ctx.stroke(path);
      const middle = 4 * Math.floor(pieces.length / 8);
      if (pieces.length) write(value, x(pieces[middle]) + 3 * dense, y(pieces[middle + 1]) - 3 * dense);
    }
    if (field.mark) {
      // At a corner the mark and its text stay inside of the map; zoomed past it, they go with it.
      const { bbox } = u, inside = (at, from, size) => at < from - dense || at > from + size + dense ? at : Math.min(Math.max(at, from + 8 * dense), from + size - 8 * dense);
      const [left, top] = [inside(x(field.mark.at[0]), bbox.left, bbox.width), inside(y(field.mark.at[1]), bbox.top, bbox.height)];
      ctx.beginPath();
      ctx.arc(left, top, 6 * dense, 0, 2 * Math.PI);
      ctx.fillStyle = "#d55e00";
      ctx.strokeStyle = "#fff";
      ctx.lineWidth = 2 * dense;
      ctx.fill();
      ctx.stroke();
      ctx.font = `${13 * dense}px system-ui`;
      const wide = ctx.measureText(field.mark.text).width, end = u.bbox.left + u.bbox.width;
      write(field.mark.text, left + 10 * dense + wide > end ? left - 10 * dense - wide : left + 10 * dense, top + 5 * dense);
    }
  };

  // Cells as a picture, one pixel each.
  const cellsOf = field => {
    const [columns, rows] = field.sides.map(side => side.edges.length - 1), raw = bytes(field.cells);
    const cells = new Uint16Array(raw.buffer, 0, columns * rows), share = cell => (cell - 1) / 65534;
    const image = Object.assign(document.createElement("canvas"), { width: columns, height: rows }), pen = image.getContext("2d"), pixels = pen.createImageData(columns, rows);
    cells.forEach((cell, i) => { if (cell) pixels.data.set([...viridis(share(cell)), 255], 4 * i); });
    pen.putImageData(pixels, 0, 0);
    const value = cell => field.decades
      ? field.largest * 10 ** (field.decades * (share(cell) - 1)) : field.least + (field.largest - field.least) * share(cell);
    return { field, columns, rows, cells, image, value };
  };

  const map = (first, place, words) => {
    const [across, up] = first.sides;
    let now = cellsOf(first);
    const even = edges => { const h = (edges.at(-1) - edges[0]) / (edges.length - 1); return edges.every((e, i) => Math.abs(e - edges[0] - i * h) < 1e-3 * h); };
    const level = even(up.edges);
    const draw = (u, ctx) => {
      const x = v => u.valToPos(v, "x", true), y = v => u.valToPos(v, "y", true);
      const [left, right] = [x(across.edges[0]), x(across.edges.at(-1))], { image, columns, rows } = now;
      ctx.fillStyle = ink("untouched");
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
    const whole = (u, ctx) => { draw(u, ctx); overlay(now.field, u, ctx); };
    const cell = (edges, v) => { let i = 0; while (i < edges.length - 2 && v >= edges[i + 1]) i++; return i; };
    const spans = [across, up].map(side => side.edges.at(-1) - side.edges[0]);
    const nearest = (x, y) => (now.field.dots ?? []).reduce(([best, from], dot) => {
      const off = Math.hypot((dot[0] - x) / spans[0], (dot[1] - y) / spans[1]);
      return off < from ? [dot, off] : [best, from];
    }, [null, 0.03])[0];
    words.dataset.hint = words.textContent = "Point at the map to read it.";
    const bar = document.createElement("div");
    bar.className = "bar";
    bar.innerHTML = "<span></span><i></i><span></span><b></b>";
    const scale = () => {
      const { field } = now, [least, largest] = bar.querySelectorAll("span");
      least.textContent = short(field.decades ? field.largest * 10 ** -field.decades : field.least, 3);
      largest.textContent = short(field.largest, 4);
      bar.querySelector("b").textContent = field.quantity + (field.decades ? ", logarithmic" : "");
    };
    scale();
    const stops = VIRIDIS.map(c => `rgb(${c.join()})`).join();
    bar.querySelector("i").style.background = `linear-gradient(to right, ${stops})`;
    const made = frame(across.label, up.label, [across.edges[0], across.edges.at(-1), up.edges[0], up.edges.at(-1)], place, words, whole,
      (x, y) => {
        const { field, columns, cells, value } = now;
        const dot = nearest(x, y);
        if (dot) return `${across.label}: ${short(dot[0], 4)}, ${up.label}: ${short(dot[1], 4)}, ${field.quantity}: ${short(field.least + (field.largest - field.least) * dot[2], 4)}`;
        const [c, r] = [cell(across.edges, x), cell(up.edges, y)], here = cells[r * columns + c];
        const beside = field.beside ? `, ${field.beside[0]}: ${short(field.beside[1][r])}` : "";
        return `${across.label}: ${short(x, 4)}, ${up.label}: ${short(y, 4)}${beside}, ${field.quantity}: ${here ? short(value(here), 4) : "–"}`;
      }, true);
    words.before(bar);
    made.cells = field => { now = cellsOf(field); scale(); made.redraw(); };
    return made;
  };

  // Other numbers in a chart of the same curves, which keeps what it is zoomed to.
  const renew = (chart, data) => {
    const ends = columns => [columns[0][0], columns[0].at(-1)], [low, high] = ends(chart.data), { min, max } = chart.scales.x;
    const zoomed = min > low || max < high, [from, to] = zoomed ? [min, max] : ends(data);
    chart.batch(() => { chart.setData(data, false); chart.setScale("x", { min: from, max: to }); });
  };
  const ends = map => JSON.stringify(map.sides.map(side => [side.label, side.edges]));

  const all = [];
  // A chart in a figure; what comes back puts other data in its place.
  const put = (figure, first, isMap) => {
    const box = document.createElement("div"), title = document.createElement("h3");
    box.className = "live";
    figure.append(box);
    const entry = [null, null];
    let shown = null;
    const make = data => {
      const place = document.createElement("div"), words = document.createElement("p");
      words.className = "words";
      box.replaceChildren(title, place);
      const own = data.kind === "path" || data.kind === "dots", plain = !isMap && !own;
      if (!plain) box.append(words);
      entry[0]?.destroy();
      entry[0] = plain ? lines(data, place) : isMap ? map(data, place, words) : curves(data, place, words);
      entry[1] = place;
    };
    const update = data => {
      title.textContent = data.title;
      const alike = shown && (isMap ? ends(shown) === ends(data) : ["lines", "sticks", "bars"].includes(data.kind)
        && ["kind", "names", "x", "y"].every(key => String(shown[key]) === String(data[key])));
      shown = data;
      if (!alike) make(data); else if (isMap) entry[0].cells(data); else renew(entry[0], data.data);
    };
    update(first);
    all.push(entry);
    // Those that stood in the figure before may have got less room.
    for (const [chart, place] of all) {
      if (figure.contains(place) && chart.width !== sizeOf(place).width) chart.setSize(sizeOf(place));
    }
    return update;
  };
  // The still picture of a figure in pixels, twice as many as the drawing has: sharp on a dense screen and in print.
  const pixels = still => new Promise((done, fail) => {
    const { width, height } = still.viewBox.baseVal.width ? still.viewBox.baseVal : { width: still.width.baseVal.value, height: still.height.baseVal.value };
    const canvas = Object.assign(document.createElement("canvas"), { width: 2 * width, height: 2 * height }), drawing = new Image();
    drawing.onerror = fail;
    drawing.onload = () => {
      canvas.getContext("2d").drawImage(drawing, 0, 0, canvas.width, canvas.height);
      done(canvas.toDataURL("image/png"));
    };
    // A drawing that stands alone says what it is and how large.
    const copy = still.cloneNode(true);
    for (const [key, value] of Object.entries({ xmlns: "http://www.w3.org/2000/svg", width, height })) copy.setAttribute(key, value);
    drawing.src = "data:image/svg+xml;charset=utf-8," + encodeURIComponent(new XMLSerializer().serializeToString(copy));
  });
  const offer = figure => figure.querySelectorAll(".still svg, :scope > svg").forEach((still, k) => {
    const link = Object.assign(document.createElement("a"), { className: "png small screen", href: "#", textContent: "save as PNG" });
    const name = still.querySelector("text")?.textContent.trim().toLowerCase().replace(/[^a-z0-9]+/g, "_") || "chart";
    link.addEventListener("click", async event => {
      event.preventDefault();
      Object.assign(document.createElement("a"), { href: await pixels(still), download: `${name}.png` }).click();
    });
    (figure.querySelectorAll(".live")[k] ?? figure).append(link);
  });
  for (const figure of document.querySelectorAll("figure.chart")) {
    figure.classList.add("lively");
    figure.querySelectorAll("script.plot, script.map").forEach(script => put(figure, JSON.parse(script.textContent), script.className === "map"));
    offer(figure);
  }
  let waiting = 0;
  addEventListener("resize", () => {
    cancelAnimationFrame(waiting);
    waiting = requestAnimationFrame(() => all.forEach(([chart, place]) => chart.setSize(sizeOf(place))));
  });
  scheme.addEventListener("change", () => all.forEach(([chart]) => chart.redraw()));
  // For the other scripts of the page.
  window.report = { viridis, bytes, short, ink, scheme, put, pixels, VIRIDIS, charts: all };
})();

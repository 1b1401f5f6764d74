// The gears in space: turns, steps through the mesh cycle, shows pressure, displacement and root stress.
"use strict";
(() => {
  const $ = id => document.getElementById(id);
  const { viridis, short, VIRIDIS, unpack, surface } = window.report;
  const BODY = [[0.62, 0.68, 0.75], [0.75, 0.70, 0.62]];
  const SHADES = Array.from({ length: 256 }, (_, i) => new THREE.Color().setRGB(...viridis(i / 255).map(c => c / 255), THREE.SRGBColorSpace).toArray());
  const TAU = 2 * Math.PI;

  const largestOf = lists => lists.reduce((m, list) => list.reduce((n, v) => Number.isFinite(v) ? Math.max(n, v) : n, m), 0);
  const sizes = list => Float32Array.from({ length: list.length / 3 }, (_, i) => Math.hypot(list[3 * i], list[3 * i + 1], list[3 * i + 2]));

  // One gear: all its teeth, those of the window with their fields.
  class GearInSpace {
    constructor(data, index) {
      Object.assign(this, { data, index, pitch: TAU / data.teeth });
      this.group = new THREE.Group();
      this.body = new THREE.Color().setRGB(...BODY[index], THREE.SRGBColorSpace);
      const plain = new THREE.MeshLambertMaterial({ color: this.body, side: THREE.DoubleSide });
      const { geometry, points } = surface(data.sector);
      // How far it reaches from its axis, and its half width.
      this.reach = points.reduce((r, v, i) => i % 3 === 0 ? Math.max(r, Math.hypot(v, points[i + 1])) : r, 0);
      this.half = points.reduce((h, v, i) => i % 3 === 2 ? Math.max(h, v) : h, 0);
      this.teeth = new THREE.InstancedMesh(geometry, plain, data.teeth);
      this.teeth.frustumCulled = false;
      this.group.add(this.teeth);
      this.bands = new THREE.Mesh(new THREE.BufferGeometry(), new THREE.MeshBasicMaterial({ vertexColors: true, side: THREE.DoubleSide, transparent: true }));
      this.bands.frustumCulled = false;
      this.bands.renderOrder = 1;
      this.group.add(this.bands);
      if (data.window) this.addWindow(data.window);
    }

    addWindow(data) {
      const { geometry, points, corners } = surface(data.shape);
      geometry.setAttribute("color", new THREE.BufferAttribute(new Float32Array(3 * corners.length), 3));
      const mesh = new THREE.Mesh(geometry, new THREE.MeshLambertMaterial({ vertexColors: true, side: THREE.DoubleSide }));
      mesh.frustumCulled = false;
      this.group.add(mesh);
      const displacement = unpack(data.displacement);
      this.window = {
        mesh, points, corners, displacement, teeth: data.teeth,
        fields: { displacement: displacement.map(sizes), stress: unpack(data.stress), pressure: unpack(data.pressure) },
      };
    }

    largest(quantity) { return this.window ? largestOf(this.window.fields[quantity] ?? []) : 0; }

    show(frame, k, quantity, largest, times) {
      const { window: own, data, index } = this, shift = frame.shift[index];
      this.group.rotation.z = frame.angles[index];
      const hidden = new Set(own ? own.teeth.map(t => (t + shift) % data.teeth) : []);
      const turn = new THREE.Matrix4();
      for (let t = 0; t < data.teeth; t++) {
        if (hidden.has(t)) turn.makeScale(0, 0, 0); else turn.makeRotationZ(t * this.pitch);
        this.teeth.setMatrixAt(t, turn);
      }
      this.teeth.instanceMatrix.needsUpdate = true;
      if (own) {
        own.mesh.rotation.z = shift * this.pitch;
        this.paint(own, own.fields[quantity][k], own.displacement[k], quantity, largest, times);
      }
      this.press(frame.bands, quantity === "pressure" ? largest : 0);
    }

    paint(own, values, moved, quantity, largest, times) {
      const { position, color } = own.mesh.geometry.attributes, body = this.body.toArray();
      own.corners.forEach((point, corner) => {
        const value = values ? values[point] : NaN;
        const bare = !Number.isFinite(value) || !(largest > 0) || (quantity === "pressure" && value <= 0);
        color.array.set(bare ? body : SHADES[Math.round(255 * Math.min(1, Math.max(0, value / largest)))], 3 * corner);
        for (let i = 0; i < 3; i++) position.array[3 * corner + i] = own.points[3 * point + i] + 1e-3 * times * (moved ? moved[3 * point + i] : 0);
      });
      position.needsUpdate = color.needsUpdate = true;
    }

    // Ribbons along the contact lines, a little above the flanks.
    press(bands, largest) {
      const [radius, sigma, twist] = this.data.flank, g = this.index, positions = [], colours = [], faces = [];
      const cos = 1 / Math.hypot(1, twist * radius), sin = cos * twist * radius, least = 0.012 * this.pitch * radius;
      for (const band of largest > 0 ? bands : []) {
        const at = (u, z) => {
          const phi = band.teeth[g] * this.pitch + twist * z + band.side * (sigma - u), [s, c] = [Math.sin(phi), Math.cos(phi)], up = least * band.side;
          return [radius * (c - band.side * u * s) - up * s * cos, radius * (s + band.side * u * c) + up * c * cos, z - up * sin];
        };
        band.pressure.forEach((pressure, i) => {
          const u = band.roll[g][i], half = Math.max(band.half_width[i] / cos, least) / (radius * Math.max(u, 0.05)), first = positions.length / 3;
          positions.push(...at(u - half, band.z[g][i]), ...at(u + half, band.z[g][i]));
          const shade = SHADES[Math.round(255 * Math.min(1, pressure / largest))];
          colours.push(...shade, ...shade);
          // Slices that are no neighbours belong to two pieces of a line.
          const gap = i > 0 ? Math.abs(band.z[g][i] - band.z[g][i - 1]) : Infinity;
          const step = band.pressure.length > 1 ? Math.abs(band.z[g].at(-1) - band.z[g][0]) / (band.pressure.length - 1) : 0;
          if (gap < 2.5 * step) faces.push(first - 2, first - 1, first + 1, first - 2, first + 1, first);
        });
      }
      this.bands.geometry.dispose();
      this.bands.geometry = new THREE.BufferGeometry();
      this.bands.geometry.setAttribute("position", new THREE.Float32BufferAttribute(positions, 3));
      this.bands.geometry.setAttribute("color", new THREE.Float32BufferAttribute(colours, 3));
      this.bands.geometry.setIndex(faces);
      this.bands.visible = faces.length > 0;
    }
  }

  const QUANTITIES = { pressure: "pressure [MPa]", displacement: "displacement [µm]", stress: "first principal stress [MPa]" };

  const start = (first, stage) => {
    const state = { frame: 0, quantity: "pressure", shown: 0, look: null };
    let data = null, gears = [], centre = 0, largest = {}, most = 0;

    // Takes gears and positions; whether the gears are others than before.
    const take = next => {
      const others = JSON.stringify(data?.gears) !== JSON.stringify(next.gears);
      data = next;
      if (others) {
        gears.forEach(gear => space.scene.remove(gear.group));
        gears = data.gears.map((gear, i) => new GearInSpace(gear, i));
        gears.forEach(gear => space.scene.add(gear.group));
        centre = data.gears[1].centre[0];
      }
      largest = Object.fromEntries(Object.keys(QUANTITIES).map(q => [q, Math.max(...gears.map(g => g.largest(q)))]));
      largest.pressure = data.frames.reduce((top, f) => f.bands.reduce((m, b) => b.pressure.reduce((n, p) => Math.max(n, p), m), top), largest.pressure);
      // The slider's end: the largest displacement as long as a tenth of a gear's radius.
      most = largest.displacement > 0 ? 100 * Math.max(...gears.map(g => g.reach)) / largest.displacement : 0;
      state.frame = Math.min(state.frame, data.frames.length - 1);
      $("frame").max = data.frames.length - 1;
      for (const input of document.querySelectorAll("#quantity input")) input.disabled = !(largest[input.value] > 0);
      $("quantity").hidden = !Object.values(largest).some(v => v > 0);
      $("view-note").textContent = data.note;
      return others;
    };
    // Where the wheel's centre is that is drawn aside by so much; a ring's is on the other side of the pinion's.
    const beside = apart => centre < 0 ? centre : centre + 0.006 * apart * centre;
    const update = () => {
      const frame = data.frames[state.frame], solid = state.quantity !== "pressure";
      const times = solid ? most * Number($("scale").value) / 100 : 0;
      gears.forEach(gear => gear.show(frame, state.frame, state.quantity, largest[state.quantity], times));
      gears[0].group.position.x = 0;
      const apart = Number($("apart").value);
      gears[1].group.position.x = beside(apart);
      // A ring goes along its axis, where nothing is in its way.
      gears[1].group.position.z = data.gears[1].centre[1] - (centre < 0 ? 0.03 * apart * (gears[0].half + gears[1].half) : 0);
      // In mesh the bands lie between flanks, where nobody sees them: they shine through.
      gears.forEach(gear => { gear.bands.material.depthTest = apart > 0; });
      $("phase").textContent = `phase ${frame.phase.toFixed(3)}`;
      $("times").textContent = `${short(times, 2)} x`;
      $("deformed").hidden = !solid || most === 0;
      bar();
      space.draw();
    };
    const bar = () => {
      const top = largest[state.quantity], stops = VIRIDIS.map(c => `rgb(${c.join()})`).join();
      $("scale-bar").hidden = !(top > 0);
      $("scale-bar").innerHTML = `<span>0</span><i></i><span>${short(top, 4)}</span><b>${QUANTITIES[state.quantity]}</b>`;
      $("scale-bar").querySelector("i").style.background = `linear-gradient(to right, ${stops})`;
    };
    // Middle, direction, and what is to be seen across and up.
    const both = () => {
      const at = beside(Number($("apart").value)), left = Math.min(-gears[0].reach, at - gears[1].reach), right = Math.max(gears[0].reach, at + gears[1].reach);
      return [[0.5 * (left + right), 0, 0], 1.06 * (right - left), 2.12 * Math.max(...gears.map(g => g.reach))];
    };
    // The pinion's flank that is loaded, from where it faces.
    const loaded = () => {
      const side = data.frames.find(f => f.bands.length)?.bands[0].side ?? 1, { reach, half, data: { teeth } } = gears[0];
      const pitch = TAU * reach / teeth;
      return [[reach - 0.35 * pitch, 0, 0], [0.75, 0.55 * side, 0.5], 4.5 * pitch + half, Math.max(3.5 * pitch, 2.2 * half)];
    };
    const look = {
      whole: () => { const [target, across, up] = both(); return [target, [0.25, -0.35, 1], 1.12 * across, 1.12 * up]; },
      front: () => { const [target, across, up] = both(); return [target, [0, 0, 1], across, up]; },
      mesh: loaded,
    };
    // The wheel stands in the way of a look at the flank: it is drawn aside until another look is taken.
    let aside = null;
    const stand = name => {
      if (name === "mesh" && aside === null) {
        aside = $("apart").value;
        $("apart").value = 100;
      } else if (name !== "mesh" && aside !== null) {
        $("apart").value = aside;
        aside = null;
      }
    };
    const space = window.report.space(stage, state, look, { before: stand, update });
    $("frame").addEventListener("input", () => { state.frame = Number($("frame").value); update(); });
    ["scale", "apart"].forEach(id => $(id).addEventListener("input", update));
    for (const input of document.querySelectorAll("#quantity input")) {
      input.addEventListener("change", () => { state.quantity = input.value; update(); });
    }
    window.report.player($("play"), () => { $("frame").value = state.frame = (state.frame + 1) % data.frames.length; update(); });
    take(first);
    // The picture opens at the mesh, where something is to be seen there.
    space.open(data.frames.some(frame => frame.bands.length) ? "mesh" : "whole");
    // Other numbers, or other gears, in the same picture.
    const show = next => { if (take(next)) space.view("whole"); else update(); };
    window.report.view = { state, look: space.view, show };
  };

  const open = (data, stage) => window.report.tried(stage, () => start(data, stage));
  window.report.open = open;
  const holder = document.querySelector("script.view"), stage = $("stage");
  if (holder && stage) open(JSON.parse(holder.textContent), stage);
})();

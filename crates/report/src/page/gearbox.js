// A gearbox in space: shafts bent by load or swinging in a mode, gears, bearings with their forces.
"use strict";
(() => {
  const $ = id => document.getElementById(id);
  const { short, unpack, surface, space: stageOf, tried, player } = window.report;
  const TAU = 2 * Math.PI, AROUND = 32, STEPS = 24;
  const SHAFT = 0x8a929c, GEARS = [0x9fb0c4, 0xc4b69f, 0xa9c0a4, 0xc2a3ae], BEARING = 0x5a6470, FORCE = 0xd55e00;

  // Displacement and turn (six numbers) at a height of a shaft, linear between its nodes.
  const between = (nodes, values, z) => {
    let i = 0;
    while (i < nodes.length - 2 && z > nodes[i + 1]) i++;
    const span = nodes[i + 1] - nodes[i] || 1, share = Math.min(1, Math.max(0, (z - nodes[i]) / span));
    return [0, 1, 2, 3, 4, 5].map(k => (1 - share) * values[6 * i + k] + share * values[6 * (i + 1) + k]);
  };

  // Faces between neighbours of so many rings.
  const rings = count => {
    const faces = [];
    for (let r = 0; r + 1 < count; r++) {
      for (let k = 0; k < AROUND; k++) {
        const [a, b] = [AROUND * r + k, AROUND * r + (k + 1) % AROUND];
        faces.push(a, b, b + AROUND, a, b + AROUND, a + AROUND);
      }
    }
    return faces;
  };

  // Rings along a shaft, closed at both ends, moved as its sections are.
  class ShaftInSpace {
    constructor(data) {
      this.data = data;
      // Radius and height along the outside, then back along the bore.
      const out = data.sections.flatMap(([from, to, outer]) => this.heights(from, to).map(z => [outer, z]));
      const back = data.sections.flatMap(([from, to, , inner]) => this.heights(from, to).map(z => [inner, z])).reverse();
      this.rings = [...out, ...back, out[0]];
      const geometry = new THREE.BufferGeometry();
      this.places = new Float32Array(3 * AROUND * this.rings.length);
      geometry.setAttribute("position", new THREE.BufferAttribute(this.places, 3));
      geometry.setIndex(rings(this.rings.length));
      this.mesh = new THREE.Mesh(geometry, new THREE.MeshLambertMaterial({ color: SHAFT, side: THREE.DoubleSide, flatShading: true }));
      this.mesh.frustumCulled = false;
    }

    heights(from, to) { return [from, ...this.data.nodes.filter(z => z > from && z < to), to]; }

    show(moved, times) {
      const [x, y, origin] = this.data.origin;
      this.rings.forEach(([radius, z], r) => {
        const [ux, uy, uz, ax, ay, az] = between(this.data.nodes, moved, z).map(v => times * v);
        for (let k = 0; k < AROUND; k++) {
          const [c, s] = [radius * Math.cos(TAU * k / AROUND), radius * Math.sin(TAU * k / AROUND)];
          this.places.set([x + c + ux - az * s, y + s + uy + az * c, origin + z + uz + ax * s - ay * c], 3 * (AROUND * r + k));
        }
      });
      this.mesh.geometry.attributes.position.needsUpdate = true;
    }
  }

  class GearInBox {
    constructor(data, shaft, colour) {
      Object.assign(this, { data, shaft });
      const { geometry, points } = surface(data.sector);
      this.reach = points.reduce((r, v, i) => i % 3 === 0 ? Math.max(r, Math.hypot(v, points[i + 1])) : r, 0);
      this.teeth = new THREE.InstancedMesh(geometry, new THREE.MeshLambertMaterial({ color: colour, side: THREE.DoubleSide }), data.teeth);
      this.teeth.frustumCulled = false;
      for (let t = 0; t < data.teeth; t++) this.teeth.setMatrixAt(t, new THREE.Matrix4().makeRotationZ(TAU * t / data.teeth));
    }

    show(moved, times, input) {
      const { origin, nodes, ratio } = this.shaft, [ux, uy, uz, ax, ay, az] = between(nodes, moved, this.data.position).map(v => times * v);
      this.teeth.position.set(origin[0] + ux, origin[1] + uy, origin[2] + this.data.position + uz);
      // Turns are small but for the scale that they are drawn at.
      const turn = new THREE.Vector3(ax, ay, az), angle = turn.length();
      this.teeth.quaternion.setFromAxisAngle(angle > 0 ? turn.divideScalar(angle) : new THREE.Vector3(0, 0, 1), angle);
      this.teeth.quaternion.multiply(this.teeth.quaternion.clone().setFromAxisAngle(new THREE.Vector3(0, 0, 1), this.data.angle + ratio * input));
    }
  }

  // A surface of revolution about z of radii and heights.
  const revolved = profile => {
    const places = profile.flatMap(([r, z]) => Array.from({ length: AROUND }, (_, k) => [r * Math.cos(TAU * k / AROUND), r * Math.sin(TAU * k / AROUND), z]).flat());
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.Float32BufferAttribute(places, 3));
    geometry.setIndex(rings(profile.length));
    return geometry;
  };

  class BearingInBox {
    constructor(data, shaft, longest) {
      Object.assign(this, { data, shaft, longest });
      const { radius } = data, solid = (color, more) => new THREE.MeshLambertMaterial({ color, side: THREE.DoubleSide, flatShading: true, ...more });
      this.place = new THREE.Vector3(shaft.origin[0], shaft.origin[1], shaft.origin[2] + data.position);
      const ring = [[1.45, -0.25], [1.6, -0.25], [1.6, 0.25], [1.45, 0.25], [1.45, -0.25]].map(([r, z]) => [r * radius, z * radius]);
      this.ring = new THREE.Mesh(revolved(ring), solid(BEARING));
      this.ring.position.copy(this.place);
      // Of length 1, its point at the origin.
      this.arrow = new THREE.Mesh(revolved([[0, -1], [0.025, -1], [0.025, -0.25], [0.07, -0.25], [0, 0]]), solid(FORCE));
      this.arrow.frustumCulled = false;
    }

    // The force on the shaft, as an arrow that ends where it acts.
    show(force, most) {
      const along = new THREE.Vector3(...(force ?? [0, 0, 0])), size = along.length();
      this.arrow.visible = size > 1e-6 * most;
      if (!this.arrow.visible) return;
      along.divideScalar(size);
      this.arrow.scale.setScalar(Math.max(0.15, size / most) * this.longest);
      this.arrow.quaternion.setFromUnitVectors(new THREE.Vector3(0, 0, 1), along);
      // Outside of the ring, where it can be seen.
      this.arrow.position.copy(this.place).addScaledVector(along, -1.6 * this.data.radius);
    }
  }

  const start = (data, stage) => {
    const state = { frame: 0, shape: 0, phase: 0, shown: 0, look: null };
    const lists = data.frames.map(frame => unpack(frame.shafts));
    const modes = data.modes.map(mode => unpack(mode.shafts));
    const shafts = data.shafts.map(shaft => new ShaftInSpace(shaft));
    const gears = data.gears.map((gear, i) => new GearInBox(gear, data.shafts[gear.shaft], GEARS[i % GEARS.length]));
    const low = [0, 1, 2].map(() => Infinity), high = low.map(() => -Infinity);
    const reach = (place, radius) => [0, 1, 2].forEach(k => {
      const more = k < 2 ? radius : 0;
      low[k] = Math.min(low[k], place[k] - more);
      high[k] = Math.max(high[k], place[k] + more);
    });
    data.shafts.forEach(({ origin: [x, y, z], sections }) => sections.forEach(([from, to, outer]) => { reach([x, y, z + from], outer); reach([x, y, z + to], outer); }));
    gears.forEach(gear => reach([...gear.shaft.origin.slice(0, 2), gear.shaft.origin[2] + gear.data.position], gear.reach));
    const size = Math.hypot(...high.map((h, k) => h - low[k])), middle = high.map((h, k) => 0.5 * (h + low[k]));
    const bearings = data.bearings.map(bearing => new BearingInBox(bearing, data.shafts[bearing.shaft], 0.18 * size));
    const strongest = data.frames.reduce((m, f) => f.bearings.reduce((n, force) => Math.max(n, Math.hypot(...force)), m), 0);

    // The slider's end: the largest displacement, or turn at the largest radius, is a tenth of the box.
    const furthest = Math.max(1, ...gears.map(gear => gear.reach), ...data.shafts.flatMap(s => s.sections.map(([, , outer]) => outer)));
    const largest = all => all.reduce((m, list) => list.reduce((n, v, i) => Math.max(n, Math.abs(v) * (i % 6 < 3 ? 1 : furthest)), m), 0);
    const ends = [largest(lists.flat()), ...modes.map(largest)].map(most => most > 0 ? 0.1 * size / most : 0);

    const shape = () => {
      if (state.shape === 0) return lists[state.frame];
      // Real and imaginary parts, shaft by shaft.
      const [c, s] = [Math.cos(TAU * state.phase / STEPS), Math.sin(TAU * state.phase / STEPS)], parts = modes[state.shape - 1], half = parts.length / 2;
      return parts.slice(0, half).map((re, i) => re.map((v, k) => c * v - s * parts[half + i][k]));
    };
    const update = () => {
      const moved = shape(), times = ends[state.shape] * Number($("scale").value) / 100, frame = data.frames[state.frame], at_rest = state.shape === 0;
      shafts.forEach((shaft, i) => shaft.show(moved[i], times));
      gears.forEach(gear => gear.show(moved[gear.data.shaft], times, frame.angle));
      bearings.forEach((bearing, i) => bearing.show(at_rest ? frame.bearings[i] : null, strongest));
      $("phase").textContent = at_rest ? `input at ${short(frame.angle * 360 / TAU, 4)} deg` : data.modes[state.shape - 1].name;
      $("times").textContent = at_rest ? `${short(times, 2)} x` : "";
      space.draw();
    };
    const seen = () => [high[0] - low[0], high[1] - low[1], high[2] - low[2]];
    const look = {
      whole: () => [middle, [0.85, 0.5, 0.75], 1.05 * size, 0.85 * size],
      front: () => { const [x, y] = seen(); return [middle, [0, 0, 1], 1.15 * x, 1.15 * y]; },
      side: () => { const [, y, z] = seen(); return [middle, [1, 0, 0], 1.15 * z, 1.15 * y]; },
    };
    const space = stageOf(stage, state, look, { update });
    [...shafts.map(s => s.mesh), ...gears.map(g => g.teeth), ...bearings.flatMap(b => [b.ring, b.arrow])].forEach(part => space.scene.add(part));
    const along = (shaft, z) => [shaft.origin[0], shaft.origin[1], shaft.origin[2] + z];
    data.shafts.forEach(shaft => space.tag(shaft.name, along(shaft, shaft.sections.at(-1)[1] + 0.03 * size), "shaft"));
    gears.forEach(gear => {
      const [x, y, z] = along(gear.shaft, gear.data.position);
      space.tag(gear.data.name, [x, y + gear.reach + 0.015 * size, z], "gear");
    });
    data.bearings.forEach(bearing => {
      const [x, y, z] = along(data.shafts[bearing.shaft], bearing.position);
      space.tag(bearing.name, [x, y - 2.1 * bearing.radius - 0.01 * size, z], "bearing");
    });
    $("names").addEventListener("change", () => { stage.classList.toggle("nameless", !$("names").checked); });
    data.modes.forEach((mode, i) => $("shape").append(new Option(mode.name, i + 1)));
    $("shape").closest("label").hidden = data.modes.length === 0;
    $("shape").addEventListener("change", () => { state.shape = Number($("shape").value); update(); });
    $("frame").max = data.frames.length - 1;
    $("frame").addEventListener("input", () => { state.frame = Number($("frame").value); update(); });
    $("scale").addEventListener("input", update);
    // At rest the gears turn; a mode swings.
    player($("play"), () => {
      if (state.shape === 0) $("frame").value = state.frame = (state.frame + 1) % data.frames.length; else state.phase = (state.phase + 1) % STEPS;
      update();
    });
    space.open("whole");
    window.report.view = { state, look: space.view };
  };

  const holder = document.querySelector("script.gearbox"), stage = $("stage");
  if (holder && stage) tried(stage, () => start(JSON.parse(holder.textContent), stage));
})();

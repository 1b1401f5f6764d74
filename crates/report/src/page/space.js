// A picture in space: camera, light, keys, paper; surfaces of triangles. Gears of a pair and gearboxes are drawn in it.
"use strict";
(() => {
  const { bytes, ink, scheme } = window.report;
  // Edges sharper than this (cosine) stay edges.
  const CREASE = Math.cos(0.6);

  const unpack = pack => pack.lists.map(text => {
    const whole = new Int16Array(bytes(text).buffer);
    return Float32Array.from(whole, n => n === -32768 ? NaN : n * pack.unit);
  });

  // A surface corner by corner, with normals that are smooth but at edges.
  const surface = shape => {
    const points = unpack(shape.points)[0], corners = new Uint16Array(bytes(shape.triangles).buffer), count = corners.length / 3;
    const normals = new Float32Array(3 * count), around = Array.from({ length: points.length / 3 }, () => []);
    for (let t = 0; t < count; t++) {
      const [a, b, c] = [0, 1, 2].map(k => 3 * corners[3 * t + k]);
      const u = [0, 1, 2].map(i => points[b + i] - points[a + i]), v = [0, 1, 2].map(i => points[c + i] - points[a + i]);
      normals.set([u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]], 3 * t);
      for (let k = 0; k < 3; k++) around[corners[3 * t + k]].push(t);
    }
    const size = t => Math.hypot(normals[3 * t], normals[3 * t + 1], normals[3 * t + 2]) || 1;
    const position = new Float32Array(9 * count), normal = new Float32Array(9 * count);
    corners.forEach((point, corner) => {
      const own = Math.floor(corner / 3), sum = [0, 0, 0];
      for (const t of around[point]) {
        let dot = 0;
        for (let i = 0; i < 3; i++) dot += normals[3 * t + i] * normals[3 * own + i];
        if (dot > CREASE * size(t) * size(own)) for (let i = 0; i < 3; i++) sum[i] += normals[3 * t + i];
      }
      const length = Math.hypot(...sum) || 1;
      for (let i = 0; i < 3; i++) {
        position[3 * corner + i] = points[3 * point + i];
        normal[3 * corner + i] = sum[i] / length;
      }
    });
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(position, 3));
    geometry.setAttribute("normal", new THREE.BufferAttribute(normal, 3));
    return { geometry, points, corners };
  };

  // A stage with the looks that its buttons ask for: each is middle, direction, and what is to be seen across and up.
  // `before` hears which look comes next, `update` puts all in its place and calls `draw`.
  const space = (stage, state, look, { before = () => {}, update }) => {
    const renderer = new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
    renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    stage.replaceChildren(renderer.domElement);
    const scene = new THREE.Scene(), camera = new THREE.PerspectiveCamera(28, 1, 1, 1e5), controls = new THREE.OrbitControls(camera, stage);
    scene.add(new THREE.HemisphereLight(0xffffff, 0xb0b0b0, 2.7), camera);
    const lamp = new THREE.DirectionalLight(0xffffff, 1.1);
    lamp.position.set(0.6, 0.8, 1);
    camera.add(lamp);
    // Names beside what they name: text of the page over the picture, each at a place in space.
    const tags = [];
    const tag = (text, place, kind) => {
      const words = Object.assign(document.createElement("span"), { className: `tag ${kind}`, textContent: text });
      stage.append(words);
      tags.push([words, place]);
    };
    const write = () => {
      const [wide, high] = [stage.clientWidth, stage.clientHeight];
      for (const [words, place] of tags) {
        const at = new THREE.Vector3(...place).project(camera);
        words.style.transform = `translate(${(0.5 * (at.x + 1) * wide).toFixed(1)}px, ${(0.5 * (1 - at.y) * high).toFixed(1)}px) translate(-50%, -50%)`;
        words.hidden = Math.abs(at.z) > 1 || Math.abs(at.x) > 1 || Math.abs(at.y) > 1;
      }
    };
    const draw = () => { renderer.render(scene, camera); write(); state.shown += 1; };
    const view = name => {
      state.look = name;
      before(name);
      const [target, direction, across, up] = look[name](), high = 2 * Math.tan(camera.fov * Math.PI / 360);
      const away = Math.max(across / (high * Math.max(0.1, stage.clientWidth / stage.clientHeight)), up / high);
      camera.position.set(...direction).setLength(away).add(new THREE.Vector3(...target));
      controls.target.set(...target);
      controls.update();
      update();
    };
    const resize = () => {
      renderer.setSize(stage.clientWidth, stage.clientHeight);
      camera.aspect = stage.clientWidth / stage.clientHeight;
      camera.updateProjectionMatrix();
      // A look that nobody has changed fits the new frame as well.
      if (state.look) view(state.look); else draw();
    };
    const turned = event => {
      const turns = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, -0.1], ArrowDown: [0, 0.1] }[event.key];
      const nearer = { "+": 0.9, "-": 1 / 0.9 }[event.key];
      if (!turns && !nearer) return;
      event.preventDefault();
      state.look = null;
      const around = new THREE.Spherical().setFromVector3(camera.position.clone().sub(controls.target));
      around.theta += turns?.[0] ?? 0;
      around.phi = Math.min(Math.PI - 0.05, Math.max(0.05, around.phi + (turns?.[1] ?? 0)));
      around.radius *= nearer ?? 1;
      camera.position.setFromSpherical(around).add(controls.target);
      controls.update();
      draw();
    };
    const paper = colour => { scene.background = new THREE.Color(colour); };
    // Listeners come last: before the first picture there is nothing to draw.
    const open = name => {
      controls.addEventListener("change", draw);
      controls.addEventListener("start", () => { state.look = null; });
      stage.addEventListener("keydown", turned);
      document.querySelectorAll("[data-look]").forEach(button => button.addEventListener("click", () => view(button.dataset.look)));
      addEventListener("resize", resize);
      scheme.addEventListener("change", () => { paper(ink("paper")); draw(); });
      // Printers take no canvas: a still picture of it on white paper.
      addEventListener("beforeprint", () => {
        paper("#fff");
        draw();
        document.getElementById("printed").src = renderer.domElement.toDataURL("image/png");
        paper(ink("paper"));
        draw();
      });
      paper(ink("paper"));
      state.look = name;
      resize();
    };
    return { scene, draw, view, open, tag };
  };

  // A browser without WebGL shows all the rest.
  const tried = (stage, start) => {
    try {
      start();
    } catch (error) {
      stage.textContent = `This browser shows no picture in space (${error.message}).`;
      stage.classList.add("failed");
      document.querySelector(".view .controls").hidden = true;
      window.report.failed = error.message;
    }
  };

  // Steps through the frames of a slider while a button says so.
  const player = (button, step) => {
    let running = 0;
    button.addEventListener("click", () => {
      if (running) clearInterval(running);
      running = running ? 0 : setInterval(step, 90);
      button.textContent = running ? "pause" : "play";
    });
  };

  Object.assign(window.report, { unpack, surface, space, tried, player });
})();

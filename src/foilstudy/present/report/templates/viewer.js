// Interactive view of the crumpled shapes and their modes: plain WebGL 1, no library, no request.
"use strict";
(function () {
  const root = document.getElementById("viewer");
  if (!root) return;
  const data = JSON.parse(document.getElementById("viewer-data").textContent);
  const canvas = root.querySelector("canvas");
  const choice = root.querySelector("select");
  const morph = root.querySelector("input[type=range]");
  const note = root.querySelector("output");
  const vibration = root.querySelector("[data-act=vibration]");
  const modeChoice = root.querySelector("[data-act=mode]");
  const play = root.querySelector("[data-act=play]");
  const amplitude = root.querySelector("[data-act=amplitude]");
  const shapeColours = root.querySelector("[data-act=shape-colours]");
  const motionColours = root.querySelector("[data-act=motion-colours]");
  const gl = canvas.getContext("webgl", { antialias: true, preserveDrawingBuffer: true });
  if (!gl) return; // the still picture stays

  const vertexShader = `
    attribute vec3 position, normal;
    attribute float displacement;
    uniform mat4 projection;
    uniform mat3 rotation;
    uniform float away;
    varying vec3 viewNormal, viewPosition;
    varying float value;
    void main() {
      vec3 p = rotation * position - vec3(0.0, 0.0, away);
      viewPosition = p;
      viewNormal = rotation * normal;
      value = displacement;
      gl_Position = projection * vec4(p, 1.0);
    }`;
  const fragmentShader = `
    precision mediump float;
    uniform sampler2D colours;
    uniform float range; // 0 while the movement of a mode is coloured, a share of its largest
    uniform vec4 line; // the ring's colour; alpha 0 while the sheet is drawn
    varying vec3 viewNormal, viewPosition;
    varying float value;
    void main() {
      if (line.a > 0.0) { gl_FragColor = line; return; }
      vec3 toEye = normalize(-viewPosition);
      vec3 n = normalize(viewNormal);
      if (dot(n, toEye) < 0.0) n = -n; // both sides of the sheet are seen
      float light = 0.45 + 0.35 * max(dot(n, normalize(vec3(-0.4, 0.7, 0.6))), 0.0)
                         + 0.30 * dot(n, toEye);
      float shine = 0.10 * pow(max(dot(n, normalize(toEye + vec3(-0.4, 0.7, 0.6))), 0.0), 40.0);
      float w = range > 0.0 ? 0.5 + 0.5 * value / range : value;
      vec2 at = vec2(clamp(w, 0.002, 0.998), range > 0.0 ? 0.25 : 0.75);
      gl_FragColor = vec4(texture2D(colours, at).rgb * light + shine, 1.0);
    }`;

  // Lengths are in radii of the cylinder, so that every case is seen at the same scale.
  const DISTANCE = 7;
  const home = { turn: 0.5, tilt: 0.35, zoom: 1 };
  const view = Object.assign({}, home);
  const SECONDS_PER_CYCLE = 2;
  const stillness = window.matchMedia("(prefers-reduced-motion: reduce)");
  const swing = { playing: false, phase: 0, last: 0 };
  let program, uniforms, buffers, mesh, waiting = false;

  function bytes(text) {
    return Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  }

  function points(text, quantum) {
    const raw = new DataView(bytes(text).buffer);
    const out = new Float32Array(raw.byteLength / 2);
    for (let i = 0; i < out.length; i++) out[i] = raw.getInt16(2 * i, true) * quantum;
    return out;
  }

  // Displacement of every node from the mode's own grid, which spans that of the shape evenly.
  function modeAt(mode, rows, columns) {
    const quanta = new Int8Array(bytes(mode.displacement).buffer);
    const out = new Float32Array(3 * rows * columns);
    for (let i = 0; i < rows; i++) {
      const down = i * (mode.rows - 1) / (rows - 1);
      const top = Math.min(Math.floor(down), mode.rows - 2), v = down - top;
      for (let j = 0; j < columns; j++) {
        const across = j * mode.columns / columns, left = Math.floor(across), u = across - left;
        const right = (left + 1) % mode.columns;
        const at = (row, column) => 3 * (row * mode.columns + column);
        for (let c = 0; c < 3; c++) {
          const upper = (1 - u) * quanta[at(top, left) + c] + u * quanta[at(top, right) + c];
          const lower = (1 - u) * quanta[at(top + 1, left) + c] +
            u * quanta[at(top + 1, right) + c];
          out[3 * (i * columns + j) + c] = ((1 - v) * upper + v * lower) / 127;
        }
      }
    }
    return out;
  }

  function signed(value) {
    return (value < 0 ? "\u2212" : "+") + Math.abs(value).toFixed(1);
  }

  function compile(kind, source) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) {
      throw new Error(gl.getShaderInfoLog(shader));
    }
    return shader;
  }

  function prepare() {
    program = gl.createProgram();
    gl.attachShader(program, compile(gl.VERTEX_SHADER, vertexShader));
    gl.attachShader(program, compile(gl.FRAGMENT_SHADER, fragmentShader));
    gl.linkProgram(program);
    gl.useProgram(program);
    uniforms = {};
    for (const name of ["projection", "rotation", "away", "range", "line"]) {
      uniforms[name] = gl.getUniformLocation(program, name);
    }
    buffers = {};
    for (const [name, size] of [["position", 3], ["normal", 3], ["displacement", 1]]) {
      const at = gl.getAttribLocation(program, name);
      buffers[name] = gl.createBuffer();
      gl.bindBuffer(gl.ARRAY_BUFFER, buffers[name]);
      gl.enableVertexAttribArray(at);
      gl.vertexAttribPointer(at, size, gl.FLOAT, false, 0, 0);
    }
    buffers.triangles = gl.createBuffer();
    buffers.rings = gl.createBuffer();
    const colours = bytes(data.colours);
    gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
    // one row of colours for the shape, one for the movement of a mode
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGB, colours.length / 6, 2, 0, gl.RGB,
      gl.UNSIGNED_BYTE, colours);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.LINEAR);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
    gl.enable(gl.DEPTH_TEST);
    gl.enable(gl.POLYGON_OFFSET_FILL); // keeps the rings' lines in front of the sheet
    gl.polygonOffset(1, 1);
    load();
  }

  // Take the chosen realisation; the columns close around the cylinder.
  function load() {
    const shape = data.shapes[choice.selectedIndex];
    const { rows, columns } = shape;
    const quantum = shape.scale / shape.radius;
    const triangles = new Uint16Array(6 * (rows - 1) * columns);
    for (let i = 0; i < rows - 1; i++) {
      for (let j = 0; j < columns; j++) {
        const a = i * columns + j, b = i * columns + (j + 1) % columns;
        triangles.set([a, b, a + columns, b, b + columns, a + columns], 6 * a);
      }
    }
    const bottom = Uint16Array.from({ length: columns }, (_, j) => j);
    const rings = [...bottom, ...bottom.map((j) => (rows - 1) * columns + j)];
    mesh = {
      crumple: points(shape.surface, quantum),
      reference: points(shape.reference, quantum),
      triangles, columns,
    };
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, buffers.triangles);
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, triangles, gl.STATIC_DRAW);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, buffers.rings);
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, new Uint16Array(rings), gl.STATIC_DRAW);
    const wanted = Math.max(0, modeChoice.selectedIndex);
    modeChoice.replaceChildren(new Option("none"), ...shape.modes.map((mode, k) =>
      new Option(k + 1 + ": " + mode.frequency.toPrecision(3) + " Hz")));
    modeChoice.selectedIndex = wanted <= shape.modes.length ? wanted : 0;
    vibration.hidden = shape.modes.length === 0;
    loadMode();
  }

  // Take the chosen mode of the chosen realisation, or none.
  function loadMode() {
    const shape = data.shapes[choice.selectedIndex];
    const mode = shape.modes[modeChoice.selectedIndex - 1];
    mesh.mode = mode ? modeAt(mode, shape.rows, shape.columns) : null;
    if (mode) morph.value = 100; // the modes are those of the crumple
    else swing.playing = false;
    play.disabled = amplitude.disabled = !mode;
    gl.uniform1f(uniforms.range, mode ? 0 : data.range_mm * 1e-3 / shape.radius);
    shapeColours.hidden = Boolean(mode);
    motionColours.hidden = !mode;
    describe();
    deform();
  }

  function describe() {
    const shape = data.shapes[choice.selectedIndex];
    const mode = shape.modes[modeChoice.selectedIndex - 1];
    let text = "Radial displacement " + signed(shape.lowest_mm) + " to " +
      signed(shape.highest_mm) + " mm.";
    if (mode) {
      text += " Mode " + modeChoice.selectedIndex + " at " + mode.frequency.toPrecision(3) +
        " Hz, rings held: slowed to one cycle in " + SECONDS_PER_CYCLE +
        " s, its largest movement drawn as " + amplitude.value + " mm; colour: how far each point moves.";
    }
    note.textContent = text;
    amplitude.setAttribute("aria-valuetext", amplitude.value + " mm");
    play.textContent = swing.playing ? "Stop" : "Start";
  }

  function start(playing) {
    swing.playing = playing;
    swing.last = 0;
    describe();
    redraw();
  }

  // Positions between the cylinder and the crumple, with area-weighted node normals.
  function deform() {
    const s = Number(morph.value) / 100;
    const { crumple, reference, triangles, mode } = mesh;
    const radius = data.shapes[choice.selectedIndex].radius;
    const moved = mode ? Math.sin(swing.phase) * Number(amplitude.value) * 1e-3 / radius : 0;
    const position = new Float32Array(crumple.length);
    const normal = new Float32Array(crumple.length);
    const displacement = new Float32Array(crumple.length / 3);
    for (let i = 0; i < position.length; i++) {
      position[i] = reference[i] + s * (crumple[i] - reference[i]);
    }
    let low = Infinity, high = -Infinity;
    for (let k = 2; k < position.length; k += 3) {
      low = Math.min(low, position[k]);
      high = Math.max(high, position[k]);
    }
    if (mode) for (let i = 0; i < position.length; i++) position[i] += moved * mode[i];
    // what is coloured: how far a point moves in the mode, or how far it has left the cylinder
    for (let n = 0; n < displacement.length; n++) {
      displacement[n] = mode ? Math.hypot(mode[3 * n], mode[3 * n + 1], mode[3 * n + 2]) :
        Math.hypot(position[3 * n], position[3 * n + 1]) -
        Math.hypot(reference[3 * n], reference[3 * n + 1]);
    }
    for (let t = 0; t < triangles.length; t += 3) {
      const a = 3 * triangles[t], b = 3 * triangles[t + 1], c = 3 * triangles[t + 2];
      const ux = position[b] - position[a], vx = position[c] - position[a];
      const uy = position[b + 1] - position[a + 1], vy = position[c + 1] - position[a + 1];
      const uz = position[b + 2] - position[a + 2], vz = position[c + 2] - position[a + 2];
      const nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
      for (const k of [a, b, c]) {
        normal[k] += nx;
        normal[k + 1] += ny;
        normal[k + 2] += nz;
      }
    }
    // Unit length, because the fragment shader may compute with 16 bits.
    for (let k = 0; k < normal.length; k += 3) {
      const length = Math.hypot(normal[k], normal[k + 1], normal[k + 2]) || 1;
      for (let c = 0; c < 3; c++) normal[k + c] /= length;
    }
    for (let k = 2; k < position.length; k += 3) position[k] -= (low + high) / 2;
    mesh.halfWidth = Math.max(1.3, 0.55 + 0.5 * (high - low)); // the tall cylinder fits as well
    for (const [name, values] of Object.entries({ position, normal, displacement })) {
      gl.bindBuffer(gl.ARRAY_BUFFER, buffers[name]);
      gl.bufferData(gl.ARRAY_BUFFER, values, gl.DYNAMIC_DRAW);
    }
    morph.setAttribute("aria-valuetext", morph.value + " % of the way to the crumple");
    redraw();
  }

  function redraw() {
    if (!waiting) {
      waiting = true;
      requestAnimationFrame(draw);
    }
  }

  function draw(now) {
    waiting = false;
    if (swing.playing) {
      // a page that was hidden for a while goes on where it was
      const elapsed = swing.last ? Math.min(now - swing.last, 100) : 0;
      swing.phase = (swing.phase + 2e-3 * Math.PI * elapsed / SECONDS_PER_CYCLE) % (2 * Math.PI);
      swing.last = now;
      deform(); // asks for the next frame
    }
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    const width = Math.round(canvas.clientWidth * ratio);
    const height = Math.round(canvas.clientHeight * ratio);
    if (canvas.width !== width || canvas.height !== height) {
      canvas.width = width;
      canvas.height = height;
    }
    gl.viewport(0, 0, width, height);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    // Turn about the cylinder's axis, then tilt; the axis stays upright on the screen.
    const ct = Math.cos(view.turn), st = Math.sin(view.turn);
    const ce = Math.cos(view.tilt), se = Math.sin(view.tilt);
    gl.uniformMatrix3fv(uniforms.rotation, false,
      [ct, -st * se, st * ce, st, ct * se, -ct * ce, 0, ce, se]);
    const near = 1, far = 13, aspect = width / height;
    const focal = DISTANCE / mesh.halfWidth * view.zoom * Math.min(aspect, 1);
    gl.uniformMatrix4fv(uniforms.projection, false, [
      focal / aspect, 0, 0, 0, 0, focal, 0, 0,
      0, 0, -(far + near) / (far - near), -1, 0, 0, -2 * far * near / (far - near), 0]);
    gl.uniform1f(uniforms.away, DISTANCE);
    gl.uniform4f(uniforms.line, 0, 0, 0, 0);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, buffers.triangles);
    gl.drawElements(gl.TRIANGLES, mesh.triangles.length, gl.UNSIGNED_SHORT, 0);
    gl.uniform4f(uniforms.line, 0.3, 0.3, 0.3, 1);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, buffers.rings);
    gl.drawElements(gl.LINE_LOOP, mesh.columns, gl.UNSIGNED_SHORT, 0);
    gl.drawElements(gl.LINE_LOOP, mesh.columns, gl.UNSIGNED_SHORT, 2 * mesh.columns);
  }

  function turn(across, up) {
    view.turn -= across;
    view.tilt = Math.max(-1.57, Math.min(1.57, view.tilt + up));
    redraw();
  }

  function zoom(factor) {
    view.zoom = Math.max(0.5, Math.min(8, view.zoom * factor));
    redraw();
  }

  function reset() {
    Object.assign(view, home);
    redraw();
  }

  const pointers = new Map();
  const spread = () => {
    const [a, b] = [...pointers.values()];
    return Math.hypot(a.x - b.x, a.y - b.y);
  };
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
  });
  canvas.addEventListener("pointermove", (event) => {
    const last = pointers.get(event.pointerId);
    if (!last) return;
    const before = pointers.size === 2 ? spread() : 0;
    const here = { x: event.clientX, y: event.clientY };
    pointers.set(event.pointerId, here);
    const across = 0.008 * (here.x - last.x), up = 0.008 * (here.y - last.y);
    // One finger that moves up or down scrolls the page; two move as one by half of each.
    if (pointers.size === 1) turn(across, event.pointerType === "touch" ? 0 : up);
    else if (before > 0) {
      turn(across / 2, up / 2);
      zoom(spread() / before);
    }
  });
  for (const end of ["pointerup", "pointercancel"]) {
    canvas.addEventListener(end, (event) => pointers.delete(event.pointerId));
  }
  canvas.addEventListener("wheel", (event) => {
    // The wheel scrolls the page until the reader has clicked into the view.
    if (document.activeElement !== canvas && !event.ctrlKey) return;
    event.preventDefault();
    zoom(Math.exp(-0.0015 * event.deltaY));
  }, { passive: false });
  const keys = {
    ArrowLeft: () => turn(-0.1, 0), ArrowRight: () => turn(0.1, 0),
    ArrowUp: () => turn(0, -0.1), ArrowDown: () => turn(0, 0.1),
    "+": () => zoom(1.15), "=": () => zoom(1.15), "-": () => zoom(1 / 1.15),
    "0": reset, Home: reset,
  };
  canvas.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || !(event.key in keys)) return;
    event.preventDefault();
    keys[event.key]();
  });
  for (const [act, across, up] of [
    ["left", -0.2, 0], ["right", 0.2, 0], ["up", 0, -0.2], ["down", 0, 0.2],
  ]) {
    root.querySelector("[data-act=" + act + "]").addEventListener("click", () => turn(across, up));
  }
  root.querySelector("[data-act=closer]").addEventListener("click", () => zoom(1.25));
  root.querySelector("[data-act=farther]").addEventListener("click", () => zoom(0.8));
  root.querySelector("[data-act=reset]").addEventListener("click", reset);
  choice.addEventListener("change", load);
  morph.addEventListener("input", () => {
    if (mesh.mode) {
      modeChoice.selectedIndex = 0;
      loadMode();
    } else deform();
  });
  modeChoice.addEventListener("change", () => {
    if (stillness.matches && !swing.playing) swing.phase = Math.PI / 2; // shown, not moved
    else swing.playing = true;
    loadMode();
  });
  play.addEventListener("click", () => start(!swing.playing));
  amplitude.addEventListener("input", () => {
    describe();
    deform();
  });
  new ResizeObserver(redraw).observe(canvas);
  canvas.addEventListener("webglcontextlost", (event) => {
    event.preventDefault();
    waiting = true; // nothing is drawn until the browser gives the context back
  });
  canvas.addEventListener("webglcontextrestored", () => {
    waiting = false;
    prepare();
  });

  root.classList.add("live");
  prepare();
})();

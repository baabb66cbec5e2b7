// The part in 3-D by WebGL 2, or a still picture without it. Right-handed throughout; z is the pulley's axis.
(() => {
  const stage = document.querySelector(".stage");
  if (!stage) return;
  const canvas = stage.querySelector("canvas"), missing = stage.querySelector(".missing");
  const gl = canvas.getContext("webgl2", { antialias: true, stencil: true, preserveDrawingBuffer: true });

  // Decodes the format of export/report/mesh_code.h.
  const bytes = Uint8Array.from(atob(document.getElementById("mesh").textContent.trim()), c => c.charCodeAt(0));
  const data = canvas.dataset, low = data.low.split(" ").map(Number), step = Number(data.step), corners = 3 * Number(data.triangles);
  const index = new Uint32Array(corners), place = [];
  let position = 0;
  const varint = () => { for (let v = 0, shift = 0; ; shift += 7) { const b = bytes[position++]; v |= (b & 127) << shift; if (b < 128) return v >>> 0; } };
  const before = [0, 0, 0];
  for (let i = 0, newest = 0; i < corners; i++) {
    const back = varint();
    index[i] = newest - back;
    if (back) continue;
    newest++;
    for (let k = 0; k < 3; k++) { const z = varint(); before[k] += z & 1 ? -(z + 1) / 2 : z / 2; place.push(low[k] + step * before[k]); }
  }

  // Corner normals: the mean over the faces about a vertex that meet at less than the crease angle. Others form edges.
  const faces = corners / 3, normals = new Float32Array(corners), count = place.length / 3;
  const sub = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const unit = v => { const n = Math.hypot(...v) || 1; return [v[0] / n, v[1] / n, v[2] / n]; };
  const vertex = i => [place[3 * i], place[3 * i + 1], place[3 * i + 2]];
  const area = [], flat = [], about = Array.from({ length: count }, () => []), centre = [0, 0, 0], top3 = [-1e9, -1e9, -1e9], low3 = [1e9, 1e9, 1e9];
  for (let f = 0; f < faces; f++) {
    const [a, b, c] = [0, 1, 2].map(k => vertex(index[3 * f + k])), n = cross(sub(b, a), sub(c, a));
    area.push(n); flat.push(unit(n));
    for (let k = 0; k < 3; k++) about[index[3 * f + k]].push(f);
  }
  for (let i = 0; i < place.length; i++) { low3[i % 3] = Math.min(low3[i % 3], place[i]); top3[i % 3] = Math.max(top3[i % 3], place[i]); }
  for (let k = 0; k < 3; k++) centre[k] = (low3[k] + top3[k]) / 2;
  const radius = Math.hypot(...sub(top3, low3)) / 2, crease = Math.cos(32 * Math.PI / 180);
  const points = new Float32Array(3 * corners), smooth = new Float32Array(3 * corners), edges = [], open = new Map();
  for (let f = 0; f < faces; f++) for (let k = 0; k < 3; k++) {
    const v = index[3 * f + k], next = index[3 * f + (k + 1) % 3], sum = [0, 0, 0];
    for (const g of about[v]) if (dot(flat[f], flat[g]) > crease) for (let d = 0; d < 3; d++) sum[d] += area[g][d];
    points.set(vertex(v), 9 * f + 3 * k);
    smooth.set(unit(sum), 9 * f + 3 * k);
    const twin = next * count + v;
    if (open.has(twin)) { if (dot(flat[f], flat[open.get(twin)]) < crease) edges.push(...vertex(v), ...vertex(next)); open.delete(twin); }
    else open.set(v * count + next, f);
  }

  const colour = name => { const h = getComputedStyle(stage).getPropertyValue(name).trim(); return [1, 3, 5].map(i => parseInt(h.slice(i, i + 2), 16) / 255); };
  const home = { turn: -65, lift: 32, zoom: 1, x: 0, y: 0, half: false };
  const view = { ...home };
  let spin = 0;  // α of the pulley, shown by a camera that turns the other way
  const fit = () => {
    const ratio = Math.min(devicePixelRatio || 1, 2), size = [canvas.clientWidth, canvas.clientHeight].map(n => Math.max(1, Math.round(n * ratio)));
    if (canvas.width !== size[0] || canvas.height !== size[1]) [canvas.width, canvas.height] = size;
    return size;
  };
  const camera = aspect => {
    const turn = (view.turn + spin) * Math.PI / 180, lift = view.lift * Math.PI / 180, f = 4;
    const back = [Math.cos(lift) * Math.cos(turn), Math.cos(lift) * Math.sin(turn), Math.sin(lift)];
    const side = [-Math.sin(turn), Math.cos(turn), 0], above = cross(back, side);  // side × above = back: right-handed
    const distance = f * radius * 0.86 * Math.max(1, 1 / aspect) / view.zoom;
    const eye = [0, 1, 2].map(k => centre[k] + distance * back[k] - view.x * side[k] - view.y * above[k]);
    const near = Math.max(distance - 3 * radius, 0.02 * radius), far = distance + 3 * radius;
    const a = (far + near) / (near - far), b = 2 * far * near / (near - far);
    const rows = [side.map(s => s * f / aspect), above.map(s => s * f), back];
    const shift = rows.map(r => -dot(r, eye));
    const matrix = [];
    for (let k = 0; k < 3; k++) matrix.push(rows[0][k], rows[1][k], a * back[k], -back[k]);
    matrix.push(shift[0], shift[1], a * shift[2] + b, -shift[2]);
    return { matrix, eye, side, above };
  };

  // The view also contains a part that is taller than wide.
  const { matrix: at_first } = camera(canvas.clientWidth / Math.max(1, canvas.clientHeight));
  let reach = 0;
  for (let i = 0; i < place.length; i += 3) {
    const [x, y, w] = [0, 1, 3].map(k => at_first[k] * place[i] + at_first[4 + k] * place[i + 1] + at_first[8 + k] * place[i + 2] + at_first[12 + k]);
    reach = Math.max(reach, Math.abs(x / w), Math.abs(y / w));
  }
  home.zoom = view.zoom = Math.min(1, .98 / reach);

  // Without WebGL: faces towards the viewer, the furthest first.
  const still = () => {
    const pen = canvas.getContext("2d"), [w, h] = fit(), { matrix, eye, side, above } = camera(w / h), order = [];
    const ink = ["--metal", "--p1", "--p2"].map(colour), tints = ink.map((c, k) => c.map((v, i) => k ? .45 * ink[0][i] + .55 * v : v));
    const grooves = [data.groove1, data.groove2].map(words => words.split(" ").map(Number));
    const seen = p => { const r = [0, 1, 3].map(k => matrix[k] * p[0] + matrix[4 + k] * p[1] + matrix[8 + k] * p[2] + matrix[12 + k]); return [w * (1 + r[0] / r[2]) / 2, h * (1 - r[1] / r[2]) / 2, r[2]]; };
    for (let f = 0; f < faces; f++) {
      const ends = [0, 1, 2].map(k => vertex(index[3 * f + k])), middle = [0, 1, 2].map(k => (ends[0][k] + ends[1][k] + ends[2][k]) / 3);
      const to_eye = unit(sub(eye, middle)), n = flat[f];
      if (dot(n, to_eye) <= 0) continue;
      const within = g => Math.abs(middle[2] - g[0]) < g[1] && Math.hypot(middle[0], middle[1]) > g[2];
      const key = unit([0, 1, 2].map(k => .8 * to_eye[k] - .45 * side[k] + .6 * above[k]));
      const light = 255 * (.45 + .08 * dot(n, above) + .6 * Math.max(dot(n, key), 0)), tint = tints[within(grooves[0]) ? 1 : within(grooves[1]) ? 2 : 0];
      order.push({ depth: seen(middle)[2], ends: ends.map(seen), ink: `rgb(${tint.map(v => Math.min(255, Math.round(v * light))).join()})` });
    }
    pen.clearRect(0, 0, w, h);
    for (const face of order.sort((p, q) => q.depth - p.depth)) {
      pen.fillStyle = pen.strokeStyle = face.ink;
      pen.beginPath();
      for (const [x, y] of face.ends) pen.lineTo(x, y);
      pen.closePath(); pen.fill(); pen.stroke();
    }
  };
  if (!gl) { canvas.removeAttribute("tabindex"); document.querySelector(".how").hidden = true; addEventListener("resize", still); addEventListener("beforeprint", still); still(); return; }
  missing.hidden = true;
  stage.querySelector(".buttons").hidden = false;

  const shader = (type, source) => {
    const s = gl.createShader(type);
    gl.shaderSource(s, "#version 300 es\nprecision highp float;\n" + source); gl.compileShader(s);
    if (!gl.getShaderParameter(s, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(s));
    return s;
  };
  const program = gl.createProgram();
  gl.attachShader(program, shader(gl.VERTEX_SHADER, `layout(location=0) in vec3 p; layout(location=1) in vec3 n; uniform mat4 m; uniform float lift; out vec3 at, normal;
    void main(){ at = p; normal = n; gl_Position = m * vec4(p, 1.); gl_Position.z -= lift * gl_Position.w; }`));
  gl.attachShader(program, shader(gl.FRAGMENT_SHADER, `in vec3 at, normal; uniform vec3 eye, side, above, metal, ink1, ink2, tint, g1, g2; uniform bool plain, half_; out vec4 colour;
    bool within(vec3 g){ return abs(at.z - g.x) < g.y && length(at.xy) > g.z; }
    void main(){
      if (half_ && at.y < 0.) discard;
      if (plain) { colour = vec4(tint, 1.); return; }
      vec3 n = normalize(normal), v = normalize(eye - at), base = within(g1) ? mix(metal, ink1, .55) : within(g2) ? mix(metal, ink2, .55) : metal;
      vec3 key = normalize(.8 * v - .45 * side + .6 * above), fill = normalize(.7 * v + .8 * side - .25 * above);
      float light = .40 + .08 * dot(n, above) + .44 * max(dot(n, key), 0.) + .24 * max(dot(n, fill), 0.);
      float shine = pow(max(dot(n, normalize(key + v)), 0.), 40.);
      colour = vec4(base * light * 1.12 + .10 * shine, 1.);
    }`));
  gl.linkProgram(program); gl.useProgram(program);
  const uniform = name => gl.getUniformLocation(program, name);
  const buffers = (positions, vectors) => {
    const array = gl.createVertexArray();
    gl.bindVertexArray(array);
    [positions, vectors].forEach((values, slot) => {
      if (!values) return;
      gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
      gl.bufferData(gl.ARRAY_BUFFER, values, gl.STATIC_DRAW);
      gl.enableVertexAttribArray(slot); gl.vertexAttribPointer(slot, 3, gl.FLOAT, false, 0, 0);
    });
    return array;
  };
  const body = buffers(points, smooth), wires = buffers(new Float32Array(edges), null);
  const y = 1e-5 * radius, plane = buffers(new Float32Array([low3[0], y, low3[2], top3[0], y, low3[2], low3[0], y, top3[2], top3[0], y, top3[2]]), null);
  gl.enable(gl.DEPTH_TEST); gl.enable(gl.CULL_FACE);

  const draw = () => {
    const [w, h] = fit();
    const { matrix, eye, side, above } = camera(w / h);
    gl.viewport(0, 0, w, h);
    gl.clearColor(...colour("--stage"), 1); gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT | gl.STENCIL_BUFFER_BIT);
    gl.uniformMatrix4fv(uniform("m"), false, matrix);
    for (const [name, value] of Object.entries({ eye, side, above })) gl.uniform3fv(uniform(name), value);
    for (const [name, source] of Object.entries({ metal: "--metal", ink1: "--p1", ink2: "--p2" })) gl.uniform3fv(uniform(name), colour(source));
    gl.uniform3fv(uniform("g1"), data.groove1.split(" ").map(Number)); gl.uniform3fv(uniform("g2"), data.groove2.split(" ").map(Number));
    gl.uniform1i(uniform("half_"), view.half);
    gl.uniform1i(uniform("plain"), 0); gl.uniform1f(uniform("lift"), 0);
    const paint = (shape, kind, n) => { gl.bindVertexArray(shape); gl.drawArrays(kind, 0, n); };
    const plain = name => { gl.uniform1i(uniform("plain"), 1); gl.uniform3fv(uniform("tint"), colour(name)); };
    if (view.half) {  // The cut face: if a ray meets more faces directed away than towards the viewer, the plane lies inside the part.
      gl.enable(gl.STENCIL_TEST); gl.disable(gl.CULL_FACE); gl.disable(gl.DEPTH_TEST); gl.colorMask(false, false, false, false);
      gl.stencilFunc(gl.ALWAYS, 0, 255); gl.stencilOpSeparate(gl.FRONT, gl.KEEP, gl.KEEP, gl.DECR_WRAP); gl.stencilOpSeparate(gl.BACK, gl.KEEP, gl.KEEP, gl.INCR_WRAP);
      paint(body, gl.TRIANGLES, corners);
      gl.enable(gl.DEPTH_TEST); gl.colorMask(true, true, true, true); gl.stencilFunc(gl.NOTEQUAL, 0, 255); gl.stencilOp(gl.KEEP, gl.KEEP, gl.KEEP);
      plain("--cut"); paint(plane, gl.TRIANGLE_STRIP, 4); gl.uniform1i(uniform("plain"), 0);
      gl.disable(gl.STENCIL_TEST); gl.enable(gl.CULL_FACE);
    }
    paint(body, gl.TRIANGLES, corners);
    gl.uniform1f(uniform("lift"), 8e-5);  // edges lie on faces and are moved slightly towards the viewer
    plain("--edge"); paint(wires, gl.LINES, edges.length / 3);
  };
  let waiting = false;
  const redraw = () => { if (!waiting) { waiting = true; requestAnimationFrame(() => { waiting = false; draw(); }); } };
  const orbit = (dx, dy) => { view.turn -= dx; view.lift = Math.max(-90, Math.min(90, view.lift + dy)); redraw(); };
  const zoom = factor => { view.zoom = Math.max(0.3, Math.min(20, view.zoom * factor)); redraw(); };
  const pan = (dx, dy) => { const mm = 2.12 * radius / view.zoom / canvas.clientHeight; view.x += dx * mm; view.y -= dy * mm; redraw(); };

  const fingers = new Map();
  canvas.addEventListener("pointerdown", e => { canvas.setPointerCapture(e.pointerId); fingers.set(e.pointerId, [e.clientX, e.clientY]); canvas.focus({ preventScroll: true }); });
  canvas.addEventListener("pointermove", e => {
    const last = fingers.get(e.pointerId);
    if (!last) return;
    const dx = e.clientX - last[0], dy = e.clientY - last[1], apart = () => { const [p, q] = [...fingers.values()]; return Math.hypot(p[0] - q[0], p[1] - q[1]) || 1; };
    if (fingers.size === 2) { const old = apart(); fingers.set(e.pointerId, [e.clientX, e.clientY]); zoom(apart() / old); pan(dx / 2, dy / 2); return; }
    fingers.set(e.pointerId, [e.clientX, e.clientY]);
    if (e.shiftKey || e.buttons & 6) pan(dx, dy); else orbit(0.45 * dx, 0.45 * dy);
  });
  for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, e => fingers.delete(e.pointerId));
  canvas.addEventListener("contextmenu", e => e.preventDefault());
  // The wheel scrolls the page until the view was clicked.
  canvas.addEventListener("wheel", e => { if (document.activeElement === canvas || e.ctrlKey) { e.preventDefault(); zoom(Math.exp(-0.0015 * e.deltaY)); } }, { passive: false });
  const set = change => { Object.assign(view, change); redraw(); };
  const keys = { ArrowLeft: () => orbit(-6, 0), ArrowRight: () => orbit(6, 0), ArrowUp: () => orbit(0, -6), ArrowDown: () => orbit(0, 6), "+": () => zoom(1.15), "=": () => zoom(1.15), "-": () => zoom(1 / 1.15), Home: () => set({ ...home, half: view.half }) };
  canvas.addEventListener("keydown", e => { const act = keys[e.key]; if (act) { e.preventDefault(); act(); } });
  const views = { isometric: home, top: { turn: -90, lift: 90 }, side: { turn: -90, lift: 0 }, below: { turn: -90, lift: -90 } };
  for (const button of stage.querySelectorAll("button")) button.addEventListener("click", () => {
    const name = button.dataset.view;
    if (name !== "half") return set({ ...home, ...views[name], half: view.half });
    set({ half: !view.half });
    button.setAttribute("aria-pressed", view.half);
  });
  document.addEventListener("pulley", e => { spin = e.detail; redraw(); });
  new ResizeObserver(redraw).observe(canvas);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);
  addEventListener("beforeprint", draw);
  canvas.addEventListener("webglcontextlost", () => { canvas.hidden = true; missing.hidden = false; missing.textContent = "The graphics were lost: load this page again."; });
  draw();
})();

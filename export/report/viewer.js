// The part in 3-D by WebGL 2, or a still picture without it. Right-handed throughout; z is the pulley's axis.
(() => {
  const stage = document.querySelector(".stage");
  if (!stage) return;
  const canvas = stage.querySelector("canvas"), missing = stage.querySelector(".missing");
  const gl = canvas.getContext("webgl2", { antialias: true, stencil: true, preserveDrawingBuffer: true });

  // Decodes the format of export/report/mesh_code.h.
  const bytes = Uint8Array.from(atob(document.getElementById("mesh").textContent.trim()), c => c.charCodeAt(0));
  const data = canvas.dataset, low = data.low.split(" ").map(Number), step = Number(data.step), corners = 3 * Number(data.triangles);
  // vertex_of_corner: three vertices of each triangle. coordinates: x, y and z of each vertex, mm.
  const vertex_of_corner = new Uint32Array(corners), coordinates = [];
  let read = 0;
  const varint = () => { for (let v = 0, shift = 0; ; shift += 7) { const b = bytes[read++]; v |= (b & 127) << shift; if (b < 128) return v >>> 0; } };
  // Each corner names a vertex by how far it lies back from the next new one. 0 is that vertex itself: its coordinates follow, as
  // differences to the vertex before it in steps, zigzag coded.
  const previous = [0, 0, 0];
  for (let i = 0, next_vertex = 0; i < corners; i++) {
    const back = varint();
    vertex_of_corner[i] = next_vertex - back;
    if (back) continue;
    next_vertex++;
    for (let k = 0; k < 3; k++) { const code = varint(); previous[k] += code & 1 ? -(code + 1) / 2 : code / 2; coordinates.push(low[k] + step * previous[k]); }
  }

  // Normal at a corner of a face: the mean, weighted by area, over those faces about the vertex whose normals differ from this
  // face's by less than the crease angle. Faces that differ by more meet in a drawn edge.
  const faces = corners / 3, vertices = coordinates.length / 3;
  const sub = (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const unit = v => { const n = Math.hypot(...v) || 1; return [v[0] / n, v[1] / n, v[2] / n]; };
  const vertex = i => [coordinates[3 * i], coordinates[3 * i + 1], coordinates[3 * i + 2]];
  // area_normals: as long as twice the face's area.
  const area_normals = [], unit_normals = [], faces_about = Array.from({ length: vertices }, () => []);
  const centre = [0, 0, 0], box_high = [-1e9, -1e9, -1e9], box_low = [1e9, 1e9, 1e9];
  for (let f = 0; f < faces; f++) {
    const [a, b, c] = [0, 1, 2].map(k => vertex(vertex_of_corner[3 * f + k])), n = cross(sub(b, a), sub(c, a));
    area_normals.push(n); unit_normals.push(unit(n));
    for (let k = 0; k < 3; k++) faces_about[vertex_of_corner[3 * f + k]].push(f);
  }
  for (let i = 0; i < coordinates.length; i++) { box_low[i % 3] = Math.min(box_low[i % 3], coordinates[i]); box_high[i % 3] = Math.max(box_high[i % 3], coordinates[i]); }
  for (let k = 0; k < 3; k++) centre[k] = (box_low[k] + box_high[k]) / 2;
  const radius = Math.hypot(...sub(box_high, box_low)) / 2, crease_cosine = Math.cos(32 * Math.PI / 180);
  // unpaired: faces by edge (first vertex · number of vertices + second), until the face on the edge's other side is found.
  const corner_points = new Float32Array(3 * corners), corner_normals = new Float32Array(3 * corners), edges = [], unpaired = new Map();
  for (let f = 0; f < faces; f++) for (let k = 0; k < 3; k++) {
    const v = vertex_of_corner[3 * f + k], next = vertex_of_corner[3 * f + (k + 1) % 3], sum = [0, 0, 0];
    for (const g of faces_about[v]) if (dot(unit_normals[f], unit_normals[g]) > crease_cosine) for (let d = 0; d < 3; d++) sum[d] += area_normals[g][d];
    corner_points.set(vertex(v), 9 * f + 3 * k);
    corner_normals.set(unit(sum), 9 * f + 3 * k);
    const reversed = next * vertices + v;
    if (unpaired.has(reversed)) { if (dot(unit_normals[f], unit_normals[unpaired.get(reversed)]) < crease_cosine) edges.push(...vertex(v), ...vertex(next)); unpaired.delete(reversed); }
    else unpaired.set(v * vertices + next, f);
  }

  // Red, green and blue, 0 to 1, of a colour #rrggbb in the page's style.
  const colour = name => { const h = getComputedStyle(stage).getPropertyValue(name).trim(); return [1, 3, 5].map(i => parseInt(h.slice(i, i + 2), 16) / 255); };
  // turn and lift of the camera about the part, degrees; its shift x and y in the image, mm; half: cut open.
  const home = { turn: -65, lift: 32, zoom: 1, x: 0, y: 0, half: false };
  const view = { ...home };
  let spin = 0;  // α of the pulley, shown by a camera that turns the other way
  // Gives the canvas as many px as the screen shows.
  const resize_canvas = () => {
    const ratio = Math.min(devicePixelRatio || 1, 2), size = [canvas.clientWidth, canvas.clientHeight].map(n => Math.max(1, Math.round(n * ratio)));
    if (canvas.width !== size[0] || canvas.height !== size[1]) [canvas.width, canvas.height] = size;
    return size;
  };
  // Perspective of OpenGL: matrix by columns. f: cotangent of half the angle of view. back, side, above: axes of the camera, to
  // the viewer, to the right and up.
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

  // x, y and w of a point in homogeneous clip coordinates: |x / w| and |y / w| are 1 at the border of the image.
  const clipped = (matrix, p) => [0, 1, 3].map(k => matrix[k] * p[0] + matrix[4 + k] * p[1] + matrix[8 + k] * p[2] + matrix[12 + k]);
  // The first view contains the whole part, also one that is taller than wide.
  const { matrix: first_matrix } = camera(canvas.clientWidth / Math.max(1, canvas.clientHeight));
  let reach = 0;
  for (let i = 0; i < vertices; i++) {
    const [x, y, w] = clipped(first_matrix, vertex(i));
    reach = Math.max(reach, Math.abs(x / w), Math.abs(y / w));
  }
  home.zoom = view.zoom = Math.min(1, .98 / reach);

  // Without WebGL: faces towards the viewer, the furthest first, with the tints and the main light of the shaders below.
  const draw_still = () => {
    const pen = canvas.getContext("2d"), [w, h] = resize_canvas(), { matrix, eye, side, above } = camera(w / h), visible = [];
    const colours = ["--metal", "--p1", "--p2"].map(colour), tints = colours.map((c, k) => c.map((v, i) => k ? .45 * colours[0][i] + .55 * v : v));
    // A tinted region: height of its middle, half its height, least radius, mm.
    const grooves = [data.groove1, data.groove2].map(numbers => numbers.split(" ").map(Number));
    // x and y in px, and the distance from the camera along its axis.
    const projected = p => { const [x, y, depth] = clipped(matrix, p); return [w * (1 + x / depth) / 2, h * (1 - y / depth) / 2, depth]; };
    for (let f = 0; f < faces; f++) {
      const triangle = [0, 1, 2].map(k => vertex(vertex_of_corner[3 * f + k])), middle = [0, 1, 2].map(k => (triangle[0][k] + triangle[1][k] + triangle[2][k]) / 3);
      const to_eye = unit(sub(eye, middle)), n = unit_normals[f];
      if (dot(n, to_eye) <= 0) continue;
      const is_in = g => Math.abs(middle[2] - g[0]) < g[1] && Math.hypot(middle[0], middle[1]) > g[2];
      const key_light = unit([0, 1, 2].map(k => .8 * to_eye[k] - .45 * side[k] + .6 * above[k]));  // from above, left of the viewer
      const light = 255 * (.45 + .08 * dot(n, above) + .6 * Math.max(dot(n, key_light), 0)), tint = tints[is_in(grooves[0]) ? 1 : is_in(grooves[1]) ? 2 : 0];
      visible.push({ depth: projected(middle)[2], triangle: triangle.map(projected), fill: `rgb(${tint.map(v => Math.min(255, Math.round(v * light))).join()})` });
    }
    pen.clearRect(0, 0, w, h);
    for (const face of visible.sort((p, q) => q.depth - p.depth)) {
      pen.fillStyle = pen.strokeStyle = face.fill;
      pen.beginPath();
      for (const [x, y] of face.triangle) pen.lineTo(x, y);
      pen.closePath(); pen.fill(); pen.stroke();
    }
  };
  if (!gl) { canvas.removeAttribute("tabindex"); document.querySelector(".how").hidden = true; addEventListener("resize", draw_still); addEventListener("beforeprint", draw_still); draw_still(); return; }
  missing.hidden = true;
  stage.querySelector(".buttons").hidden = false;

  const compiled_shader = (type, source) => {
    const s = gl.createShader(type);
    gl.shaderSource(s, "#version 300 es\nprecision highp float;\n" + source); gl.compileShader(s);
    if (!gl.getShaderParameter(s, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(s));
    return s;
  };
  const program = gl.createProgram();
  gl.attachShader(program, compiled_shader(gl.VERTEX_SHADER, `layout(location=0) in vec3 corner; layout(location=1) in vec3 corner_normal; uniform mat4 matrix; uniform float towards_viewer; out vec3 at, normal;
    void main(){ at = corner; normal = corner_normal; gl_Position = matrix * vec4(corner, 1.); gl_Position.z -= towards_viewer * gl_Position.w; }`));
  // groove1, groove2: tinted regions as (height of the middle, half height, least radius), mm. Lights: key from above left of the
  // viewer, fill from the right, and an ambient part.
  gl.attachShader(program, compiled_shader(gl.FRAGMENT_SHADER, `in vec3 at, normal; uniform vec3 eye, side, above, metal, p1, p2, flat_colour, groove1, groove2; uniform bool unlit, cut_open; out vec4 colour;
    bool is_in(vec3 groove){ return abs(at.z - groove.x) < groove.y && length(at.xy) > groove.z; }
    void main(){
      if (cut_open && at.y < 0.) discard;
      if (unlit) { colour = vec4(flat_colour, 1.); return; }
      vec3 n = normalize(normal), v = normalize(eye - at), base = is_in(groove1) ? mix(metal, p1, .55) : is_in(groove2) ? mix(metal, p2, .55) : metal;
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
  const part = buffers(corner_points, corner_normals), edge_lines = buffers(new Float32Array(edges), null);
  // The cut lies slightly behind y = 0, where fragments are discarded.
  const y = 1e-5 * radius, cut_plane = buffers(new Float32Array([box_low[0], y, box_low[2], box_high[0], y, box_low[2], box_low[0], y, box_high[2], box_high[0], y, box_high[2]]), null);
  gl.enable(gl.DEPTH_TEST); gl.enable(gl.CULL_FACE);

  const draw = () => {
    const [w, h] = resize_canvas();
    const { matrix, eye, side, above } = camera(w / h);
    gl.viewport(0, 0, w, h);
    gl.clearColor(...colour("--stage"), 1); gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT | gl.STENCIL_BUFFER_BIT);
    gl.uniformMatrix4fv(uniform("matrix"), false, matrix);
    for (const [name, value] of Object.entries({ eye, side, above })) gl.uniform3fv(uniform(name), value);
    for (const [name, source] of Object.entries({ metal: "--metal", p1: "--p1", p2: "--p2" })) gl.uniform3fv(uniform(name), colour(source));
    gl.uniform3fv(uniform("groove1"), data.groove1.split(" ").map(Number)); gl.uniform3fv(uniform("groove2"), data.groove2.split(" ").map(Number));
    gl.uniform1i(uniform("cut_open"), view.half);
    gl.uniform1i(uniform("unlit"), 0); gl.uniform1f(uniform("towards_viewer"), 0);
    const paint = (shape, primitive, n) => { gl.bindVertexArray(shape); gl.drawArrays(primitive, 0, n); };
    const use_flat_colour = name => { gl.uniform1i(uniform("unlit"), 1); gl.uniform3fv(uniform("flat_colour"), colour(name)); };
    if (view.half) {  // Draw the cut face where a ray, behind the cut, meets more faces directed away from than towards the viewer: there the plane lies inside the part.
      gl.enable(gl.STENCIL_TEST); gl.disable(gl.CULL_FACE); gl.disable(gl.DEPTH_TEST); gl.colorMask(false, false, false, false);
      gl.stencilFunc(gl.ALWAYS, 0, 255); gl.stencilOpSeparate(gl.FRONT, gl.KEEP, gl.KEEP, gl.DECR_WRAP); gl.stencilOpSeparate(gl.BACK, gl.KEEP, gl.KEEP, gl.INCR_WRAP);
      paint(part, gl.TRIANGLES, corners);
      gl.enable(gl.DEPTH_TEST); gl.colorMask(true, true, true, true); gl.stencilFunc(gl.NOTEQUAL, 0, 255); gl.stencilOp(gl.KEEP, gl.KEEP, gl.KEEP);
      use_flat_colour("--cut"); paint(cut_plane, gl.TRIANGLE_STRIP, 4); gl.uniform1i(uniform("unlit"), 0);
      gl.disable(gl.STENCIL_TEST); gl.enable(gl.CULL_FACE);
    }
    paint(part, gl.TRIANGLES, corners);
    gl.uniform1f(uniform("towards_viewer"), 8e-5);  // edges lie on faces and are moved slightly towards the viewer
    use_flat_colour("--edge"); paint(edge_lines, gl.LINES, edges.length / 3);
  };
  let is_requested = false;
  const redraw = () => { if (!is_requested) { is_requested = true; requestAnimationFrame(() => { is_requested = false; draw(); }); } };
  const orbit = (dx, dy) => { view.turn -= dx; view.lift = Math.max(-90, Math.min(90, view.lift + dy)); redraw(); };
  const zoom = factor => { view.zoom = Math.max(0.3, Math.min(20, view.zoom * factor)); redraw(); };
  const pan = (dx, dy) => { const mm_per_px = 2.12 * radius / view.zoom / canvas.clientHeight; view.x += dx * mm_per_px; view.y -= dy * mm_per_px; redraw(); };

  // Pressed pointers (mouse or pointers) by id, with their positions in px.
  const pointers = new Map();
  canvas.addEventListener("pointerdown", e => { canvas.setPointerCapture(e.pointerId); pointers.set(e.pointerId, [e.clientX, e.clientY]); canvas.focus({ preventScroll: true }); });
  canvas.addEventListener("pointermove", e => {
    const last = pointers.get(e.pointerId);
    if (!last) return;
    const dx = e.clientX - last[0], dy = e.clientY - last[1], finger_distance = () => { const [p, q] = [...pointers.values()]; return Math.hypot(p[0] - q[0], p[1] - q[1]) || 1; };
    if (pointers.size === 2) { const old_distance = finger_distance(); pointers.set(e.pointerId, [e.clientX, e.clientY]); zoom(finger_distance() / old_distance); pan(dx / 2, dy / 2); return; }
    pointers.set(e.pointerId, [e.clientX, e.clientY]);
    if (e.shiftKey || e.buttons & 6) pan(dx, dy); else orbit(0.45 * dx, 0.45 * dy);  // 6: middle or right button
  });
  for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, e => pointers.delete(e.pointerId));
  canvas.addEventListener("contextmenu", e => e.preventDefault());
  // The wheel scrolls the page until the view was clicked.
  canvas.addEventListener("wheel", e => { if (document.activeElement === canvas || e.ctrlKey) { e.preventDefault(); zoom(Math.exp(-0.0015 * e.deltaY)); } }, { passive: false });
  const change_view = change => { Object.assign(view, change); redraw(); };
  const keys = { ArrowLeft: () => orbit(-6, 0), ArrowRight: () => orbit(6, 0), ArrowUp: () => orbit(0, -6), ArrowDown: () => orbit(0, 6), "+": () => zoom(1.15), "=": () => zoom(1.15), "-": () => zoom(1 / 1.15), Home: () => change_view({ ...home, half: view.half }) };
  canvas.addEventListener("keydown", e => { const action = keys[e.key]; if (action) { e.preventDefault(); action(); } });
  const views = { isometric: home, top: { turn: -90, lift: 90 }, side: { turn: -90, lift: 0 }, below: { turn: -90, lift: -90 } };
  for (const button of stage.querySelectorAll("button")) button.addEventListener("click", () => {
    const name = button.dataset.view;
    if (name !== "half") return change_view({ ...home, ...views[name], half: view.half });
    change_view({ half: !view.half });
    button.setAttribute("aria-pressed", view.half);
  });
  document.addEventListener("pulley", e => { spin = e.detail; redraw(); });
  new ResizeObserver(redraw).observe(canvas);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);
  addEventListener("beforeprint", draw);
  canvas.addEventListener("webglcontextlost", () => { canvas.hidden = true; missing.hidden = false; missing.textContent = "The graphics were lost: load this page again."; });
  draw();
})();

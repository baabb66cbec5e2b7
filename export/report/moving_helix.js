// Side view of both helical tendons at the slider's α: the turned spirals, and the take-offs of the tendons.
// Lengths in mm, angles in degrees. In the view, +y (towards the joint) points right, the pulley's axis z points up, and
// +x points to the viewer. A row of a spiral is [x, y, height, turn (radians)], as export/report/moving_helix.cpp writes it.
(() => {
  const box = document.querySelector(".moving.helix");
  if (!box) return;
  const data = JSON.parse(document.getElementById("helix").textContent), radian = Math.PI / 180;
  const slider = box.querySelector("#alpha"), play = box.querySelector(".play"), scene = box.querySelector(".helix-scene");
  const pulley_radius = Math.max(...data.sides.flatMap(side => side.rows.map(row => Math.hypot(row[0], row[1]))));
  const past_pin = 0.15 * data.pin, width = pulley_radius + data.pin + past_pin;  // a tendon is drawn that far beyond its guide pin
  // The figure is 900 × 320 px with margins of 20 px.
  const scale = Math.min(860 / width, 280 / data.top), axis_x = 20 + scale * pulley_radius, bottom_y = 160 + scale * data.top / 2;
  const px = (y, z) => [axis_x + scale * y, bottom_y - scale * z];
  const svg = (name, classes) => {
    const element = document.createElementNS("http://www.w3.org/2000/svg", name);
    element.setAttribute("class", classes);
    scene.append(element);
    return element;
  };
  const path = points => points.length < 2 ? "" : "M" + points.map(p => p.map(v => v.toFixed(1)).join(" ")).join("L");
  // `number`: 1 or 2, of the tendon and its groove.
  const add_lines = number => ({
    back: svg("path", "thin soft-line grid"), groove: svg("path", "thin frame"), hidden: svg("path", `thin p${number}`),
    wound: svg("path", `curve p${number} whole`), free: svg("path", `curve p${number} whole`), take_off: svg("circle", "take-off") });
  svg("path", "axis-line").setAttribute("d", path([px(0, -4), px(0, data.top + 4)]));
  svg("path", "dimension").setAttribute("d", path([px(-pulley_radius, 0), px(pulley_radius, 0)]) + path([px(-pulley_radius, data.top), px(pulley_radius, data.top)]));
  svg("path", "link").setAttribute("d", path([px(data.pin, -4), px(data.pin, data.top + 4)]));
  const pin_label = svg("text", "small middle");
  const [pin_x, pin_bottom] = px(data.pin, -4);
  pin_label.setAttribute("x", pin_x); pin_label.setAttribute("y", pin_bottom + 16); pin_label.textContent = "guide pins";
  const lines_of_side = [add_lines(1), add_lines(2)];

  // The interval of the table in which α lies, and the fraction u of that interval before α.
  const interval_at = alpha => {
    let i = 0;
    while (i < data.alpha.length - 2 && data.alpha[i + 1] < alpha) i++;
    return { i, u: (alpha - data.alpha[i]) / (data.alpha[i + 1] - data.alpha[i]) };
  };
  const interpolated = (values, { i, u }) => values[i] + u * (values[i + 1] - values[i]);
  // The row at height z by interpolation, and the index of the row before it. Rows are in order of increasing turn, and
  // their heights are monotonic.
  const row_at = (rows, z) => {
    const falls = rows[0][2] > rows[rows.length - 1][2];
    let i = 0;
    while (i < rows.length - 2 && (falls ? rows[i + 1][2] > z : rows[i + 1][2] < z)) i++;
    const u = (z - rows[i][2]) / (rows[i + 1][2] - rows[i][2]);
    return { i, row: rows[i].map((v, k) => v + u * (rows[i + 1][k] - v)) };
  };
  const show = (name, text) => { for (const element of box.querySelectorAll(`[data-show=${name}]`)) element.textContent = text; };
  const number = (value, decimals) => value.toFixed(decimals).replace(/^-0(\.0*)?$/, "0$1").replace("-", "\u2212");

  let shown_alpha = 0, rising = true;
  const show_at = alpha => {
    if (alpha !== shown_alpha) rising = alpha > shown_alpha;
    shown_alpha = alpha;
    const interval = interval_at(alpha), c = Math.cos(alpha * radian), s = Math.sin(alpha * radian), turns = [], heights = [];
    data.sides.forEach((side, side_index) => {
      // α turns the pulley clockwise, seen from above. Result: x and y in px, and x in mm, towards the viewer.
      const projected = row => [...px(row[1] * c - row[0] * s, row[2]), row[0] * c + row[1] * s];
      // The pieces of a spiral on the viewer's side of the axis (front) or behind it.
      const pieces = (rows, front) => {
        let text = "", run = [];
        for (const point of rows.map(projected)) {
          if ((point[2] >= 0) === front) run.push(point.slice(0, 2)); else { text += path(run); run = []; }
        }
        return text + path(run);
      };
      // Tendon 1 is tied at P1's last row, tendon 2 at P2's first row.
      const z = interpolated(side.z, interval), { i, row } = row_at(side.rows, z), tied_at_last = side_index === 0;
      const wound = tied_at_last ? [row, ...side.rows.slice(i + 1)] : [...side.rows.slice(0, i + 1), row];
      const take_off = projected(row).slice(0, 2), line = lines_of_side[side_index];
      const take_off_y = (take_off[0] - axis_x) / scale, slope = interpolated(side.slope, interval);
      line.back.setAttribute("d", pieces(side.rows, false));
      line.groove.setAttribute("d", pieces(side.rows, true));
      line.hidden.setAttribute("d", pieces(wound, false));
      line.wound.setAttribute("d", pieces(wound, true));
      line.free.setAttribute("d", path([take_off, px(data.pin + past_pin, z + slope * (data.pin + past_pin - take_off_y))]));
      line.take_off.setAttribute("cx", take_off[0]); line.take_off.setAttribute("cy", take_off[1]); line.take_off.setAttribute("r", 4);
      turns.push(Math.abs((tied_at_last ? side.rows[side.rows.length - 1] : side.rows[0])[3] - row[3]) / (2 * Math.PI));
      heights.push(z);
    });
    show("alpha", number(alpha, 1) + "°");
    show("theta", number(interpolated(data.theta, interval), 2) + "°");
    show("heights", heights.map(z => number(z, 1)).join(", ") + " mm");
    show("turns", turns.map(t => number(t, 2)).join(", "));
    show("fleets", data.sides.map(side => number(interpolated(side.fleet, interval), 2)).join(", ") + "°");
    slider.setAttribute("aria-valuetext", `α ${number(alpha, 1)} degrees, θ ${number(interpolated(data.theta, interval), 1)} degrees`);
    document.dispatchEvent(new CustomEvent("pulley", { detail: alpha }));
  };

  // Play: from end to end and back, in eight seconds each way. A pause of the browser counts as 100 ms at most.
  let frame_request = 0, last_time = 0;
  const stop = () => { cancelAnimationFrame(frame_request); frame_request = 0; play.textContent = "Play"; play.setAttribute("aria-pressed", "false"); };
  const tick = now => {
    const low = Number(slider.min), high = Number(slider.max), step = (high - low) * Math.min(100, now - last_time) / 8000;
    last_time = now;
    const alpha = Math.min(high, Math.max(low, shown_alpha + (rising ? step : -step)));
    show_at(alpha);
    if (alpha === high) rising = false; else if (alpha === low) rising = true;
    slider.value = alpha;
    frame_request = requestAnimationFrame(tick);
  };
  play.addEventListener("click", () => {
    if (frame_request) return stop();
    play.textContent = "Stop"; play.setAttribute("aria-pressed", "true");
    last_time = performance.now();
    frame_request = requestAnimationFrame(tick);
  });
  slider.addEventListener("input", () => { stop(); show_at(Number(slider.value)); });
  for (const part of box.querySelectorAll(".controls, dl")) part.hidden = false;
  show_at(0);
})();

// Side view of both helical tendons for the slider's α: the turned spirals, and the take-offs of the tendons.
// Lengths in mm, angles in degrees; right is +y, towards the joint, up is the pulley's axis.
(() => {
  const box = document.querySelector(".moving.helix");
  if (!box) return;
  const data = JSON.parse(document.getElementById("helix").textContent), radian = Math.PI / 180;
  const slider = box.querySelector("#alpha"), play = box.querySelector(".play"), scene = box.querySelector(".helix-scene");
  const reach = Math.max(...data.sides.flatMap(side => side.rows.map(row => Math.hypot(row[0], row[1]))));
  const beyond = 0.15 * data.pin, width = reach + data.pin + beyond;
  const scale = Math.min(860 / width, 280 / data.top), left = 20 + scale * reach, foot = 160 + scale * data.top / 2;
  const px = (u, z) => [left + scale * u, foot - scale * z];
  const svg = (name, classes) => {
    const element = document.createElementNS("http://www.w3.org/2000/svg", name);
    element.setAttribute("class", classes);
    scene.append(element);
    return element;
  };
  const path = points => points.length < 2 ? "" : "M" + points.map(p => p.map(v => v.toFixed(1)).join(" ")).join("L");
  const lines = which => ({
    back: svg("path", "thin soft-line grid"), groove: svg("path", "thin frame"), hidden: svg("path", `thin p${which}`),
    wound: svg("path", `curve p${which} whole`), free: svg("path", `curve p${which} whole`), off: svg("circle", "take-off") });
  svg("path", "axis-line").setAttribute("d", path([px(0, -4), px(0, data.top + 4)]));
  svg("path", "dimension").setAttribute("d", path([px(-reach, 0), px(reach, 0)]) + path([px(-reach, data.top), px(reach, data.top)]));
  svg("path", "link").setAttribute("d", path([px(data.pin, -4), px(data.pin, data.top + 4)]));
  const words = svg("text", "small middle");
  const [at_pin, under] = px(data.pin, -4);
  words.setAttribute("x", at_pin); words.setAttribute("y", under + 16); words.textContent = "guide pins";
  const drawn = [lines(1), lines(2)];

  const place_of = alpha => {
    let i = 0;
    while (i < data.alpha.length - 2 && data.alpha[i + 1] < alpha) i++;
    return { i, u: (alpha - data.alpha[i]) / (data.alpha[i + 1] - data.alpha[i]) };
  };
  const between = (values, { i, u }) => values[i] + u * (values[i + 1] - values[i]);
  // Rows are in order of increasing turn. Tendons are tied at P1's last row and P2's first row.
  const row_at = (rows, z) => {
    const falls = rows[0][2] > rows[rows.length - 1][2];
    let i = 0;
    while (i < rows.length - 2 && (falls ? rows[i + 1][2] > z : rows[i + 1][2] < z)) i++;
    const u = (z - rows[i][2]) / (rows[i + 1][2] - rows[i][2]);
    return { i, row: rows[i].map((v, k) => v + u * (rows[i + 1][k] - v)) };
  };
  const show = (name, text) => { for (const element of box.querySelectorAll(`[data-show=${name}]`)) element.textContent = text; };
  const number = (value, decimals) => value.toFixed(decimals).replace(/^-0(\.0*)?$/, "0$1").replace("-", "\u2212");

  let before = 0, rising = true;
  const set = alpha => {
    if (alpha !== before) rising = alpha > before;
    before = alpha;
    const place = place_of(alpha), c = Math.cos(alpha * radian), s = Math.sin(alpha * radian), turns = [], heights = [];
    data.sides.forEach((side, which) => {
      // α turns it clockwise, seen from above. +x points to the viewer.
      const seen = row => [...px(row[1] * c - row[0] * s, row[2]), row[0] * c + row[1] * s];
      const runs = (rows, front) => {
        let text = "", run = [];
        for (const row of rows.map(seen)) {
          if ((row[2] >= 0) === front) run.push(row.slice(0, 2)); else { text += path(run); run = []; }
        }
        return text + path(run);
      };
      const z = between(side.z, place), { i, row } = row_at(side.rows, z), tied = which === 0;
      const wound = tied ? [row, ...side.rows.slice(i + 1)] : [...side.rows.slice(0, i + 1), row];
      const at = seen(row).slice(0, 2), line = drawn[which], u = (at[0] - left) / scale, slope = between(side.slope, place);
      line.back.setAttribute("d", runs(side.rows, false));
      line.groove.setAttribute("d", runs(side.rows, true));
      line.hidden.setAttribute("d", runs(wound, false));
      line.wound.setAttribute("d", runs(wound, true));
      line.free.setAttribute("d", path([at, px(data.pin + beyond, z + slope * (data.pin + beyond - u))]));
      line.off.setAttribute("cx", at[0]); line.off.setAttribute("cy", at[1]); line.off.setAttribute("r", 4);
      turns.push(Math.abs((tied ? side.rows[side.rows.length - 1] : side.rows[0])[3] - row[3]) / (2 * Math.PI));
      heights.push(z);
    });
    show("alpha", number(alpha, 1) + "°");
    show("theta", number(between(data.theta, place), 2) + "°");
    show("heights", heights.map(z => number(z, 1)).join(", ") + " mm");
    show("turns", turns.map(t => number(t, 2)).join(", "));
    show("fleets", data.sides.map(side => number(between(side.fleet, place), 2)).join(", ") + "°");
    slider.setAttribute("aria-valuetext", `α ${number(alpha, 1)} degrees, θ ${number(between(data.theta, place), 1)} degrees`);
    document.dispatchEvent(new CustomEvent("pulley", { detail: alpha }));
  };

  // From end to end and back, in eight seconds each way.
  let running = 0, last = 0;
  const stop = () => { cancelAnimationFrame(running); running = 0; play.textContent = "Play"; play.setAttribute("aria-pressed", "false"); };
  const tick = now => {
    const low = Number(slider.min), high = Number(slider.max), step = (high - low) * Math.min(100, now - last) / 8000;
    last = now;
    const alpha = Math.min(high, Math.max(low, before + (rising ? step : -step)));
    set(alpha);
    if (alpha === high) rising = false; else if (alpha === low) rising = true;
    slider.value = alpha;
    running = requestAnimationFrame(tick);
  };
  play.addEventListener("click", () => {
    if (running) return stop();
    play.textContent = "Stop"; play.setAttribute("aria-pressed", "true");
    last = performance.now();
    running = requestAnimationFrame(tick);
  });
  slider.addEventListener("input", () => { stop(); set(Number(slider.value)); });
  for (const part of box.querySelectorAll(".controls, dl")) part.hidden = false;
  set(0);
})();

// The moving joint: θ for the slider's α by the target motion, then both tendons as taut strings over pins and pulley, by
// geometry alone (as in export/report/tendon_trace.cpp). Lengths in mm, angles in degrees.
// A line that ends in a mark is kept on pages of the joints that the mark names: plain (the paper's layout), drum (a drum or separate //=source
// attachments), pin (tendons from pin to pulley) or sheath (tendons through sheaths). See joint_script(). //=source
(() => {
  const box = document.querySelector(".moving");
  if (!box) return;
  const data = JSON.parse(document.getElementById("motion").textContent);
  const slider = box.querySelector("#alpha"), play = box.querySelector(".play");
  const count = data.alpha.length, radian = Math.PI / 180;

  const unit = a => [Math.cos(a), Math.sin(a)];
  const turned = (p, a) => { const c = Math.cos(a), s = Math.sin(a); return [c * p[0] - s * p[1], s * p[0] + c * p[1]]; };
  const add = (p, q, k = 1) => [p[0] + k * q[0], p[1] + k * q[1]];
  const nearer = a => a - 2 * Math.PI * Math.round(a / (2 * Math.PI));

  // The place of the stroke: interval and fraction.
  const place_of = alpha => {
    let low = 0, high = count - 1;
    while (high - low > 1) { const middle = low + high >> 1; if (data.alpha[middle] <= alpha) low = middle; else high = middle; }
    return { i: low, u: Math.max(0, Math.min(1, (alpha - data.alpha[low]) / (data.alpha[high] - data.alpha[low]))) };
  };
  const within = (knots, x) => {
    let i = 0;
    while (i < knots.length - 2 && knots[i + 1] < x) i++;
    return knots.length < 2 ? { i: 0, u: 0 } : { i, u: Math.max(0, Math.min(1, (x - knots[i]) / (knots[i + 1] - knots[i]))) };
  };
  const between = (values, { i, u }) => values[i] === null || values[i + 1] === null ? NaN : values[i] + u * (values[i + 1] - values[i]);
  // Cubic through the angles with their slopes: as exact as the table.
  const theta_at = ({ i, u }) => {
    const step = data.alpha[i + 1] - data.alpha[i], v = 1 - u;
    return data.theta[i] * v * v * (1 + 2 * u) + data.theta[i + 1] * u * u * (3 - 2 * u) + step * u * v * (data.slope[i] * v - data.slope[i + 1] * u);
  };

  // Outward normal of the tangent from a point to a pin.
  const tangent = (pin, point, above, sign) => {
    const d = add(point, pin, -1);
    return Math.atan2(d[1], d[0]) + (above ? -sign : sign) * Math.acos(data.rho / Math.hypot(...d));
  };
  const arc = (centre, from, to) => { //=plain
  const arc = (centre, from, to, radius = data.rho) => { //=drum
    const steps = Math.max(1, Math.ceil(Math.abs(to - from) / (4 * radian)));
    return Array.from({ length: steps + 1 }, (_, k) => add(centre, unit(from + (to - from) * k / steps), data.rho)); //=plain
    return Array.from({ length: steps + 1 }, (_, k) => add(centre, unit(from + (to - from) * k / steps), radius)); //=drum
  };
  // The three segments of a tendon: from C to the middle of the pin, to the take-off, and the wound part.
  const tendon_at = (which, alpha, theta) => {
    const { sign, end, points } = data.outlines[which], pin = data.pins[which], n = points.length;
    const c = [data.R * Math.sin(theta), data.R * Math.cos(theta)], upper = tangent(pin, c, true, sign); //=plain
    const own = data.ends[which], c = turned(own.at, -theta), lies = own.lies - sign * theta; //=drum
    const upper = lies > 0 ? own.normal : tangent(pin, c, true, sign); //=drum
    const over = lies > 0 ? arc([0, 0], upper + sign * lies, upper, data.drum) : []; //=drum
    const on_pulley = k => add(data.axis, turned(points[k], -alpha));
    const reference = tangent(pin, data.axis, false, sign); //=pin
    const onto = p => { const d = add(p, data.exits[which], -1); return Math.atan2(d[1], d[0]) + sign * Math.PI / 2; }; //=sheath
    const reference = onto(data.axis), off = sign > 0 ? 0 : Math.PI; //=sheath
    let first = 0, outermost = -Infinity;
    for (let k = 0; k < n; k++) {
      const outward = sign * nearer(tangent(pin, on_pulley(k), false, sign) - reference); //=pin
      const outward = sign * nearer(onto(on_pulley(k)) - reference); //=sheath
      if (outward > outermost) { outermost = outward; first = k; }
    }
    const wrap = nearer(tangent(pin, on_pulley(first), false, sign) - upper), middle = upper + wrap / 2; //=pin
    const wrap = nearer(off - upper), middle = upper + wrap / 2; //=sheath
    const wound = [], step = sign < 0 ? 1 : n - 1;
    for (let k = first, left = n; left > 0; k = (k + step) % n, left--) { wound.push(on_pulley(k)); if (k === end) break; }
    const lower = [...arc(pin, middle, upper + wrap), ...data.sheaths[which], wound[0]]; //=sheath
    return { upper: [c, ...over, ...arc(pin, upper, middle)], lower, wound }; //=drum+sheath
    return { upper: [c, ...arc(pin, upper, middle)], lower, wound }; //=plain+sheath
    return { upper: [c, ...over, ...arc(pin, upper, middle)], lower: [...arc(pin, middle, upper + wrap), wound[0]], wound }; //=drum+pin
    return { upper: [c, ...arc(pin, upper, middle)], lower: [...arc(pin, middle, upper + wrap), wound[0]], wound }; //=plain+pin
  };

  const svg = (name, parent, attributes) => {
    const element = document.createElementNS(box.querySelector("svg").namespaceURI, name);
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
    return parent.appendChild(element);
  };
  const scenes = [...box.querySelectorAll(".scene")].map(group => {
    const [scale, x, y] = group.dataset.view.split(" ").map(Number), find = name => group.querySelector(name);
    const tendons = [1, 2].map(k => {
      const own = find(".tendon" + k);
      own.replaceChildren();
      own.removeAttribute("style");
      return { upper: svg("path", own, { class: "p" + k }), lower: svg("path", own, { class: "p" + k }), wound: svg("path", own, { class: "p" + k }), off: find(".off-tendon" + k) };
    });
    return { px: p => [x + scale * p[0], y - scale * p[1]], tendons, link: find(".link"), c: find(".at-c"), name: find(".name-c"), pulley: find(".pulley") };
  });

  const largest = Math.max(1e-9, ...[...data.rising, ...data.falling].flatMap(way => [way.upper1, way.lower1, way.upper2, way.lower2].flat()));
  const thickness = tension => tension > 1e-6 ? 1.2 + 7 * tension / largest : 1.2;
  const path_of = points => "M" + points.map(p => p[0].toFixed(2) + " " + p[1].toFixed(2)).join("L");
  const draw_line = (path, points, tension) => {
    path.setAttribute("d", path_of(points));
    path.setAttribute("stroke-width", thickness(tension).toFixed(2));
    path.classList.toggle("slack", !(tension > 1e-6));
  };
  const move = (element, [x, y], names = ["cx", "cy"]) => { element.setAttribute(names[0], x.toFixed(2)); element.setAttribute(names[1], y.toFixed(2)); };
  const draw = (alpha, theta, tensions) => {
    const a = alpha * radian, t = theta * radian, tendons = [0, 1].map(which => tendon_at(which, a, t));
    const c = tendons[0].upper[0];
    for (const scene of scenes) {
      const px = scene.px, [gx, gy] = px(data.axis), at_c = px(c);
      scene.link.setAttribute("d", path_of([px([0, 0]), at_c])); //=plain
      const other = px(tendons[1].upper[0]); //=drum
      scene.link.setAttribute("d", path_of([at_c, px([0, 0]), other])); //=drum
      move(scene.c.parentNode.querySelector(".at-c2"), other); //=drum
      const second = scene.name.parentNode.querySelector(".name-c2"); //=drum
      if (second) move(second, add(other, [15 * Math.sin(t), 4 - 15 * Math.cos(t)]), ["x", "y"]); //=drum
      move(scene.c, at_c);
      move(scene.name, add(at_c, [15 * Math.sin(t), 4 - 15 * Math.cos(t)]), ["x", "y"]);
      scene.pulley.setAttribute("transform", `rotate(${alpha.toFixed(3)} ${gx.toFixed(2)} ${gy.toFixed(2)})`);
      tendons.forEach((tendon, which) => {
        const { upper, lower, wound, off } = scene.tendons[which], [high, low] = tensions[which];
        draw_line(upper, tendon.upper.map(px), high);
        draw_line(lower, tendon.lower.map(px), low);
        draw_line(wound, tendon.wound.map(px), low);
        move(off, px(tendon.wound[0]));
      });
    }
  };

  const words = (value, decimals, unit) => Number.isFinite(value) ? value.toFixed(decimals).replace(/^-0(\.0*)?$/, "0$1").replace("-", "\u2212") + unit : "\u2013";
  const show = (name, text) => { for (const element of box.querySelectorAll(`[data-show=${name}]`)) element.textContent = text; };
  const pair = tensions => tensions.every(t => !(t > 1e-6) && Number.isFinite(t)) ? "slack" : words(tensions[0], 2, "") + " / " + words(tensions[1], 2, " N");
  const mix = (a, b, u) => u ? a + u * (b - a) : a;
  const number_in = id => { const input = box.querySelector("#" + id); return input ? Number(input.value) : 0; };

  const size_of = k => within(data.effects[k].shares.map(share => share.share), number_in("effect" + k));

  // The true joint angle, with its error magnified until it is visible.
  const furthest = data.effects.reduce((most, effect) => most + Math.max(...["rising", "falling"].flatMap(way => effect.shares[2][way].flat()).map(Math.abs)), 0);
  const magnified = [50, 20, 10, 5, 2].find(times => times * furthest < 12) || 1;
  for (const scene of data.effects.length ? scenes : []) {
    scene.really = svg("path", scene.link.parentNode, { class: "really" });
    scene.note = svg("text", scene.link.parentNode.parentNode, { class: "small halo middle" });
  }
  const draw_off = (theta, loaded) => {
    for (const scene of scenes.filter(one => one.really)) {
      const t = (theta + magnified * (loaded - theta)) * radian, c = [data.R * Math.sin(t), data.R * Math.cos(t)]; //=plain
      const t = (theta + magnified * (loaded - theta)) * radian, c = turned(data.ends[0].at, -t); //=drum
      scene.really.setAttribute("d", Number.isFinite(t) ? path_of([scene.px([0, 0]), scene.px(c)]) : "");
      scene.note.textContent = magnified > 1 ? `dashed: ${magnified} times as far off` : "dashed: where it is";
      move(scene.note, scene.px([0, -0.16 * data.R]), ["x", "y"]);
    }
  };
  const show_sizes = () => {
    show("load", words(number_in("load"), 1, " N"));
    box.querySelectorAll(".effect-share").forEach((row, k) => {
      const { i, u } = size_of(k), shares = data.effects[k].shares, names = row.dataset.names.split("|"), units = row.dataset.units.split("|");
      const sizes = names.map((name, n) => (names.length > 1 ? name + " " : "") + words(mix(shares[i].numbers[n] ?? NaN, u ? shares[i + 1].numbers[n] ?? NaN : 0, u), 3, units[n]));
      show("effect" + k, sizes.join(", "));
    });
  };

  let before = 0, rising = true;
  const set = alpha => {
    if (alpha !== before) rising = alpha > before;
    before = alpha;
    const place = place_of(alpha), theta = theta_at(place), ways = rising ? data.rising : data.falling;
    const load = within(data.loads, number_in("load"));
    const mixed = value_of => mix(value_of(load.i), load.u ? value_of(load.i + 1) : 0, load.u);
    const of_way = name => mixed(k => between(ways[k][name], place));
    const tensions = [[of_way("upper1"), of_way("lower1")], [of_way("upper2"), of_way("lower2")]];
    let loaded = of_way("theta");
    data.effects.forEach((effect, k) => {
      const size = size_of(k);
      const off = at => mixed(l => between(effect.shares[at][rising ? "rising" : "falling"][l], place));
      loaded += mix(off(size.i), size.u ? off(size.i + 1) : 0, size.u);
    });
    draw(alpha, theta, tensions);
    draw_off(theta, loaded);
    show("alpha", words(alpha, 1, "°"));
    show("theta", words(theta, 2, "°"));
    show("loaded", words(loaded, 2, "°"));
    show("off", words(loaded - theta, 3, "°"));
    show("slope", words(between(data.slope, place), 4, ""));
    show("radii", words(between(data.r1, place), 2, "") + ", " + words(between(data.r2, place), 2, " mm"));
    show("tendon1", pair(tensions[0]));
    show("tendon2", pair(tensions[1]));
    show("torque", words(of_way("torque"), 1, " N\u00b7mm"));
    show("way", rising ? "α growing" : "α falling");
    slider.setAttribute("aria-valuetext", `α ${words(alpha, 1, " degrees")}, θ ${words(theta, 1, " degrees")}`);
    document.dispatchEvent(new CustomEvent("pulley", { detail: alpha }));
  };

  // From end to end and back, in four seconds each way.
  let running = 0, last = 0;
  const stop = () => { cancelAnimationFrame(running); running = 0; play.textContent = "Play"; play.setAttribute("aria-pressed", "false"); };
  const tick = now => {
    const low = Number(slider.min), high = Number(slider.max), step = (high - low) * Math.min(100, now - last) / 4000;
    last = now;
    let alpha = before + (rising ? step : -step);
    if (alpha >= high) { alpha = high; } else if (alpha <= low) { alpha = low; }
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
  for (const input of box.querySelectorAll("input:not(#alpha)")) input.addEventListener("input", () => { show_sizes(); set(before); });
  for (const part of box.querySelectorAll(".controls, dl")) part.hidden = false;
  show_sizes();
  set(0);
})();

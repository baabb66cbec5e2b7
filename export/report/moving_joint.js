// The moving joint: θ for the slider's α by the target motion, then both tendons as taut strings over pins and pulley, by
// geometry alone (as in export/report/tendon_trace.cpp). Lengths in mm, angles in degrees.
// A line that ends in a mark, such as the one at the end of this line, is kept only if all words of the mark apply to the joint. //=source
// Words: plain (the paper's layout), drum (a drum or separate attachments), pin (tendons from pin to pulley), sheath (tendons //=source
// through sheaths). The word source never applies. See joint_script(). //=source
(() => {
  const box = document.querySelector(".moving");
  if (!box) return;
  const data = JSON.parse(document.getElementById("motion").textContent);
  const slider = box.querySelector("#alpha"), play = box.querySelector(".play");
  const count = data.alpha.length, radian = Math.PI / 180;

  const unit = a => [Math.cos(a), Math.sin(a)];
  const turned = (p, a) => { const c = Math.cos(a), s = Math.sin(a); return [c * p[0] - s * p[1], s * p[0] + c * p[1]]; };
  const add = (p, q, k = 1) => [p[0] + k * q[0], p[1] + k * q[1]];
  // Turns an angle by whole turns, to within half a turn of 0.
  const nearest_to_zero = a => a - 2 * Math.PI * Math.round(a / (2 * Math.PI));

  // Finds the interval of α in the stroke's table: its index i, and the fraction u of it, 0 to 1.
  const interval_at = alpha => {
    let low = 0, high = count - 1;
    while (high - low > 1) { const middle = low + high >> 1; if (data.alpha[middle] <= alpha) low = middle; else high = middle; }
    return { i: low, u: Math.max(0, Math.min(1, (alpha - data.alpha[low]) / (data.alpha[high] - data.alpha[low]))) };
  };
  // Finds the interval of another slider, which has few values. A single value makes no interval.
  const interval_of = (knots, x) => {
    let i = 0;
    while (i < knots.length - 2 && knots[i + 1] < x) i++;
    return knots.length < 2 ? { i: 0, u: 0 } : { i, u: Math.max(0, Math.min(1, (x - knots[i]) / (knots[i + 1] - knots[i]))) };
  };
  // NaN next to an angle without an equilibrium, for which the page has null.
  const interpolated = (values, { i, u }) => values[i] === null || values[i + 1] === null ? NaN : values[i] + u * (values[i + 1] - values[i]);
  // Cubic Hermite interpolation of θ with the slopes dθ/dα. Its error is below the table's rounding.
  const theta_at = ({ i, u }) => {
    const step = data.alpha[i + 1] - data.alpha[i], v = 1 - u;
    return data.theta[i] * v * v * (1 + 2 * u) + data.theta[i + 1] * u * u * (3 - 2 * u) + step * u * v * (data.slope[i] * v - data.slope[i + 1] * u);
  };

  // Direction from the pin's centre to the point where the tangent from `point` touches the pin. `above`: the tangent to the
  // joint, else the one to the pulley. `sign`: +1 or -1, of the tendon's side (mirror_sign() in C++).
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
  // The three segments of a tendon: from its end at the joint to the middle of its arc on the pin, from there to the take-off,
  // and the wound part. `side`: 0 or 1, of tendon 1 or 2. Angles in radians. c: the end at the joint. upper: direction from the
  // pin's centre to the start of the arc on the pin. wrap: angle of that arc, counter-clockwise positive.
  const tendon_curves = (side, alpha, theta) => {
    const { sign, end, points } = data.outlines[side], pin = data.pins[side], n = points.length;
    const c = [data.R * Math.sin(theta), data.R * Math.cos(theta)], upper = tangent(pin, c, true, sign); //=plain
    // drum_angle: angle over which the tendon lies on the drum; negative once it has lifted off. //=drum
    const attached = data.ends[side], c = turned(attached.at, -theta), drum_angle = attached.lies - sign * theta; //=drum
    const upper = drum_angle > 0 ? attached.normal : tangent(pin, c, true, sign); //=drum
    const on_drum = drum_angle > 0 ? arc([0, 0], upper + sign * drum_angle, upper, data.drum) : []; //=drum
    const on_pulley = k => add(data.axis, turned(points[k], -alpha));
    const reference = tangent(pin, data.axis, false, sign); //=pin
    const normal_to = p => { const d = add(p, data.exits[side], -1); return Math.atan2(d[1], d[0]) + sign * Math.PI / 2; }; //=sheath
    // The arc on the pin ends where the tendon is vertical and enters its sheath. //=sheath
    const reference = normal_to(data.axis), into_sheath = sign > 0 ? 0 : Math.PI; //=sheath
    // A taut tendon touches the outline where its normal is turned furthest outward.
    let first = 0, outermost = -Infinity;
    for (let k = 0; k < n; k++) {
      const outward = sign * nearest_to_zero(tangent(pin, on_pulley(k), false, sign) - reference); //=pin
      const outward = sign * nearest_to_zero(normal_to(on_pulley(k)) - reference); //=sheath
      if (outward > outermost) { outermost = outward; first = k; }
    }
    const wrap = nearest_to_zero(tangent(pin, on_pulley(first), false, sign) - upper), middle = upper + wrap / 2; //=pin
    const wrap = nearest_to_zero(into_sheath - upper), middle = upper + wrap / 2; //=sheath
    // From the take-off along the groove to the tie-off, at most once around; a step of n - 1 goes one point back.
    const wound = [], step = sign < 0 ? 1 : n - 1;
    for (let k = first, remaining = n; remaining > 0; k = (k + step) % n, remaining--) { wound.push(on_pulley(k)); if (k === end) break; }
    const lower = [...arc(pin, middle, upper + wrap), ...data.sheaths[side], wound[0]]; //=sheath
    return { upper: [c, ...on_drum, ...arc(pin, upper, middle)], lower, wound }; //=drum+sheath
    return { upper: [c, ...arc(pin, upper, middle)], lower, wound }; //=plain+sheath
    return { upper: [c, ...on_drum, ...arc(pin, upper, middle)], lower: [...arc(pin, middle, upper + wrap), wound[0]], wound }; //=drum+pin
    return { upper: [c, ...arc(pin, upper, middle)], lower: [...arc(pin, middle, upper + wrap), wound[0]], wound }; //=plain+pin
  };

  const svg = (name, parent, attributes) => {
    const element = document.createElementNS(box.querySelector("svg").namespaceURI, name);
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
    return parent.appendChild(element);
  };
  // data-view: px per mm, then px of the joint's axis. See export/report/drawing.cpp.
  const scenes = [...box.querySelectorAll(".scene")].map(group => {
    const [scale, x, y] = group.dataset.view.split(" ").map(Number), find = name => group.querySelector(name);
    const tendons = [1, 2].map(k => {
      const paths = find(".tendon" + k);
      paths.replaceChildren();
      paths.removeAttribute("style");
      return { upper: svg("path", paths, { class: "p" + k }), lower: svg("path", paths, { class: "p" + k }), wound: svg("path", paths, { class: "p" + k }), take_off: find(".off-tendon" + k) };
    });
    return { px: p => [x + scale * p[0], y - scale * p[1]], tendons, link: find(".link"), c: find(".at-c"), name: find(".name-c"), pulley: find(".pulley") };
  });

  const largest_tension = Math.max(1e-9, ...[...data.rising, ...data.falling].flatMap(stroke => [stroke.upper1, stroke.lower1, stroke.upper2, stroke.lower2].flat()));
  const is_taut = tension => tension > 1e-6;  // N
  const thickness = tension => is_taut(tension) ? 1.2 + 7 * tension / largest_tension : 1.2;
  const path_of = points => "M" + points.map(p => p[0].toFixed(2) + " " + p[1].toFixed(2)).join("L");
  const draw_line = (path, points, tension) => {
    path.setAttribute("d", path_of(points));
    path.setAttribute("stroke-width", thickness(tension).toFixed(2));
    path.classList.toggle("slack", !is_taut(tension));
  };
  const move = (element, [x, y], names = ["cx", "cy"]) => { element.setAttribute(names[0], x.toFixed(2)); element.setAttribute(names[1], y.toFixed(2)); };
  // `tensions`: of each tendon, at the joint and at the pulley, N.
  const draw = (alpha, theta, tensions) => {
    const a = alpha * radian, t = theta * radian, tendons = [0, 1].map(side => tendon_curves(side, a, t));
    const c = tendons[0].upper[0];
    for (const scene of scenes) {
      const px = scene.px, [axis_x, axis_y] = px(data.axis), at_c = px(c);
      scene.link.setAttribute("d", path_of([px([0, 0]), at_c])); //=plain
      const other = px(tendons[1].upper[0]); //=drum
      scene.link.setAttribute("d", path_of([at_c, px([0, 0]), other])); //=drum
      move(scene.c.parentNode.querySelector(".at-c2"), other); //=drum
      const second = scene.name.parentNode.querySelector(".name-c2"); //=drum
      if (second) move(second, add(other, [15 * Math.sin(t), 4 - 15 * Math.cos(t)]), ["x", "y"]); //=drum
      move(scene.c, at_c);
      move(scene.name, add(at_c, [15 * Math.sin(t), 4 - 15 * Math.cos(t)]), ["x", "y"]);
      scene.pulley.setAttribute("transform", `rotate(${alpha.toFixed(3)} ${axis_x.toFixed(2)} ${axis_y.toFixed(2)})`);
      tendons.forEach((tendon, side) => {
        const { upper, lower, wound, take_off } = scene.tendons[side], [at_joint, at_pulley] = tensions[side];
        draw_line(upper, tendon.upper.map(px), at_joint);
        draw_line(lower, tendon.lower.map(px), at_pulley);
        draw_line(wound, tendon.wound.map(px), at_pulley);
        move(take_off, px(tendon.wound[0]));
      });
    }
  };

  const number_text = (value, decimals, unit) => Number.isFinite(value) ? value.toFixed(decimals).replace(/^-0(\.0*)?$/, "0$1").replace("-", "\u2212") + unit : "\u2013";
  const show = (name, text) => { for (const element of box.querySelectorAll(`[data-show=${name}]`)) element.textContent = text; };
  const tension_text = tensions => tensions.every(t => !is_taut(t) && Number.isFinite(t)) ? "slack" : number_text(tensions[0], 2, "") + " / " + number_text(tensions[1], 2, " N");
  // At u = 0, b may be missing.
  const mix = (a, b, u) => u ? a + u * (b - a) : a;
  const slider_value = id => { const input = box.querySelector("#" + id); return input ? Number(input.value) : 0; };

  // An effect's share: its size as a fraction of the identified size. The page has the joint at a few shares.
  const share_interval = k => interval_of(data.effects[k].shares.map(share => share.share), slider_value("effect" + k));

  // A dashed link shows the true joint angle, with its error magnified until it is visible. The magnified sum of the largest
  // errors of all identified effects stays below 12°.
  const identified = 2;  // index of share 1 in k_rehearsed_shares
  const largest_error = data.effects.reduce((sum, effect) => sum + Math.max(...["rising", "falling"].flatMap(direction => effect.shares[identified][direction].flat()).map(Math.abs)), 0);
  const magnification = [50, 20, 10, 5, 2].find(times => times * largest_error < 12) || 1;
  for (const scene of data.effects.length ? scenes : []) {
    scene.really = svg("path", scene.link.parentNode, { class: "really" });
    scene.note = svg("text", scene.link.parentNode.parentNode, { class: "small halo middle" });
  }
  const draw_deviation = (theta, loaded) => {
    for (const scene of scenes.filter(scene => scene.really)) {
      const t = (theta + magnification * (loaded - theta)) * radian, c = [data.R * Math.sin(t), data.R * Math.cos(t)]; //=plain
      const t = (theta + magnification * (loaded - theta)) * radian, c = turned(data.ends[0].at, -t); //=drum
      scene.really.setAttribute("d", Number.isFinite(t) ? path_of([scene.px([0, 0]), scene.px(c)]) : "");
      scene.note.textContent = magnification > 1 ? `dashed: ${magnification} times as far off` : "dashed: where it is";
      move(scene.note, scene.px([0, -0.16 * data.R]), ["x", "y"]);
    }
  };
  const show_sizes = () => {
    show("load", number_text(slider_value("load"), 1, " N"));
    box.querySelectorAll(".effect-share").forEach((row, k) => {
      const { i, u } = share_interval(k), shares = data.effects[k].shares, names = row.dataset.names.split("|"), units = row.dataset.units.split("|");
      const sizes = names.map((name, n) => (names.length > 1 ? name + " " : "") + number_text(mix(shares[i].numbers[n] ?? NaN, u ? shares[i + 1].numbers[n] ?? NaN : 0, u), 3, units[n]));
      show("effect" + k, sizes.join(", "));
    });
  };

  let shown_alpha = 0, rising = true;
  const show_at = alpha => {
    if (alpha !== shown_alpha) rising = alpha > shown_alpha;
    shown_alpha = alpha;
    const interval = interval_at(alpha), theta = theta_at(interval), strokes = rising ? data.rising : data.falling;
    const load = interval_of(data.loads, slider_value("load"));
    // `value_at`: the value at the load with an index.
    const over_loads = value_at => mix(value_at(load.i), load.u ? value_at(load.i + 1) : 0, load.u);
    const under_load = name => over_loads(l => interpolated(strokes[l][name], interval));
    const tensions = [[under_load("upper1"), under_load("lower1")], [under_load("upper2"), under_load("lower2")]];
    let loaded = under_load("theta");
    data.effects.forEach((effect, k) => {
      const share = share_interval(k);
      const deviation_at = s => over_loads(l => interpolated(effect.shares[s][rising ? "rising" : "falling"][l], interval));
      loaded += mix(deviation_at(share.i), share.u ? deviation_at(share.i + 1) : 0, share.u);
    });
    draw(alpha, theta, tensions);
    draw_deviation(theta, loaded);
    show("alpha", number_text(alpha, 1, "°"));
    show("theta", number_text(theta, 2, "°"));
    show("loaded", number_text(loaded, 2, "°"));
    show("off", number_text(loaded - theta, 3, "°"));
    show("slope", number_text(interpolated(data.slope, interval), 4, ""));
    show("radii", number_text(interpolated(data.r1, interval), 2, "") + ", " + number_text(interpolated(data.r2, interval), 2, " mm"));
    show("tendon1", tension_text(tensions[0]));
    show("tendon2", tension_text(tensions[1]));
    show("torque", number_text(under_load("torque"), 1, " N\u00b7mm"));
    show("way", rising ? "α growing" : "α falling");
    slider.setAttribute("aria-valuetext", `α ${number_text(alpha, 1, " degrees")}, θ ${number_text(theta, 1, " degrees")}`);
    document.dispatchEvent(new CustomEvent("pulley", { detail: alpha }));
  };

  // Play: from end to end and back, in four seconds each way. A pause of the browser counts as 100 ms at most.
  let frame_request = 0, last_time = 0;
  const stop = () => { cancelAnimationFrame(frame_request); frame_request = 0; play.textContent = "Play"; play.setAttribute("aria-pressed", "false"); };
  const tick = now => {
    const low = Number(slider.min), high = Number(slider.max), step = (high - low) * Math.min(100, now - last_time) / 4000;
    last_time = now;
    let alpha = shown_alpha + (rising ? step : -step);
    if (alpha >= high) { alpha = high; } else if (alpha <= low) { alpha = low; }
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
  for (const input of box.querySelectorAll("input:not(#alpha)")) input.addEventListener("input", () => { show_sizes(); show_at(shown_alpha); });
  for (const part of box.querySelectorAll(".controls, dl")) part.hidden = false;
  show_sizes();
  show_at(0);
})();

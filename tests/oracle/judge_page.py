#!/usr/bin/env python3
"""Chromium judges pages with a moving joint: their scripts and their drawings.

    judge_page.py build/forearm [page.html …]   a folder of `fusee build`, and other pages of the same joint
    judge_page.py build/forearm --self-test     the judge must detect broken pages (also of multi-turn pulleys)
    judge_page.py --narrow page.html …          any pages at 400 and 320 px: nothing cut, no text below 11 px, no broken word
    judge_page.py --still page.html …           pages without scripts: no requests, no overflow, visible pictures

Exit 0: no faults; 1: faults, one line each on stdout; 77: Chromium is not installed.

The page is opened with a script before its own that records errors, and one after them that moves the slider and reads
the result. The requirements:

- The drawn lever has the angle of transmission.csv, and each drawn tendon keeps its length over the stroke.
- The 3-D view is neither blank nor inside out, and turns with the pulley. Without WebGL there is a still picture.
- There are no network requests, and nothing is wider than a phone.
- A frame takes at most 10 ms (sixty a second, on a machine with other load).
- For several turns the take-offs of the tendons lie on the turned spirals of profile.csv, where the normal is
  perpendicular to the line to the guide pin.
"""

import csv
import dataclasses
import html
import json
import math
import pathlib
import shutil
import subprocess
import sys
import tempfile

SKIPPED = 77
MOST_FRAME_MS = 10.0
MOST_BYTES = 1_000_000

BEFORE = """
window.noted = [];
// Chromium paints a page that is hidden at any time.
window.requestAnimationFrame = paint => setTimeout(() => paint(performance.now()), 0);
addEventListener("error", e => noted.push("script error: " + e.message));
addEventListener("unhandledrejection", e => noted.push("script error: " + e.reason));
document.addEventListener("securitypolicyviolation", e => noted.push("asks for " + e.blockedURI));
for (const name of ["error", "warn"]) console[name] = (...words) => noted.push("console: " + words.join(" "));
"""

# The drawing at one α, for a joint seen along its axis.
LEVER = """
  const scene = document.querySelector(".moving .scene"), [scale, x, y] = scene.dataset.view.split(" ").map(Number);
  const long = points => points.reduce((sum, p, k) => k ? sum + Math.hypot(p[0] - points[k - 1][0], p[1] - points[k - 1][1]) : 0, 0) / scale;
  const drawn = () => {
    const lever = path(scene.querySelector(".link")), c = lever.length === 3 ? lever[0] : lever[1];  // A1 O A2, or O C
    return {
      theta: Math.atan2(c[0] - x, y - c[1]) * 180 / Math.PI,
      lever: Math.hypot(c[0] - x, y - c[1]) / scale,
      lengths: [1, 2].map(k => [...scene.querySelectorAll(".tendon" + k + " path")].reduce((sum, p) => sum + long(path(p)), 0)),
      turn: Number(scene.querySelector(".pulley").getAttribute("transform").match(/rotate\\(([-0-9.]+)/)[1]),
    };
  };
"""
# For a multi-turn pulley seen from the side, x right and y up, in mm, scaled by the lines at its lower and
# upper face.
HELIX = """
  const scene = document.querySelector(".helix-scene");
  const [[low, high], [, top]] = scene.querySelector(".dimension").getAttribute("d").slice(1).split("M").map(part => part.split("L").map(p => p.split(" ").map(Number)));
  const axis = (low[0] + high[0]) / 2, scale = (low[1] - top[1]) / HEIGHT;
  const mm = (px, py) => [(px - axis) / scale, (low[1] - py) / scale];
  const drawn = () => ({
    scale,
    takeOffs: [...scene.querySelectorAll(".take-off")].map(off => mm(Number(off.getAttribute("cx")), Number(off.getAttribute("cy")))),
    free: [1, 2].map(k => path([...scene.querySelectorAll(".whole.p" + k)].pop()).map(p => mm(...p))),
  });
"""

AFTER = """
(async () => {
  const found = { noted, places: [], times: [] };
  const slider = document.querySelector("#alpha"), canvas = document.querySelector(".stage canvas");
  const path = element => element.getAttribute("d").slice(1).split("L").map(p => p.split(" ").map(Number));
  DRAWN
  for (const alpha of ALPHAS) {
    slider.value = alpha;
    const start = performance.now();
    slider.dispatchEvent(new Event("input"));
    found.times.push(performance.now() - start);
    found.places.push({ alpha: Number(slider.value), shown: document.querySelector("[data-show=theta]").textContent, ...drawn() });
  }
  const frame = () => new Promise(done => setTimeout(done, 100));
  const gl = canvas && canvas.getContext("webgl2");
  found.webgl = Boolean(gl);
  found.part = Boolean(canvas);
  const look = () => {
    const w = canvas.width, h = canvas.height;
    let pixels;
    if (gl) { pixels = new Uint8Array(4 * w * h); gl.readPixels(0, 0, w, h, gl.RGBA, gl.UNSIGNED_BYTE, pixels); }
    else pixels = canvas.getContext("2d").getImageData(0, 0, w, h).data;
    const ground = [...pixels.slice(0, 4)];
    let part = 0, light = 0, warm = 0, cold = 0, sum = 0;
    for (let i = 0; i < pixels.length; i += 4) {
      if (pixels[i] === ground[0] && pixels[i + 1] === ground[1] && pixels[i + 2] === ground[2]) continue;
      part++; light += (pixels[i] + pixels[i + 1] + pixels[i + 2]) / 3;
      if (pixels[i] > pixels[i + 2] + 30) warm++;
      if (pixels[i + 2] > pixels[i] + 50) cold++;
      sum = (sum * 31 + pixels[i] + i) % 1000000007;
    }
    const all = pixels.length / 4;
    return { part: part / all, light: light / Math.max(1, part), warm: warm / all, cold: cold / all, sum };
  };
  const move = alpha => { slider.value = alpha; slider.dispatchEvent(new Event("input")); };
  if (canvas) {
    move(0); await frame();
    found.home = look();
    move(ALPHAS[ALPHAS.length - 1]); await frame();
    found.end = look();
    if (gl) { document.querySelector("[data-view=side]").click(); await frame(); }
    found.side = look();  // a still picture has one side only
  }
  const effects = [...document.querySelectorAll(".effect-share input")];
  const angle_of = lever => { const end = path(scene.querySelector(lever))[1]; return Math.atan2(end[0] - x, y - end[1]); };
  // Largest angle between the drawn true lever and the declared one, with each effect at 0, 1 and 2 times its size.
  found.deviations = effects.map(input => [0, 1, 2].map(share => {
    for (const other of effects) other.value = 0;
    input.value = share;
    input.dispatchEvent(new Event("input"));
    return Math.max(...[0.3, 0.5, 0.7].flatMap(at => [-1, 1].map(way => {
      const alpha = Number(slider.min) + at * (Number(slider.max) - Number(slider.min));
      move(alpha - way); move(alpha);
      return Math.abs(angle_of(".really") - angle_of(".link"));
    })));
  }));
  found.requests = performance.getEntriesByType("resource").length;
  found.room = innerWidth;
  found.wide = document.documentElement.scrollWidth;
  found.label = document.querySelector("label[for=alpha]") !== null && slider.getAttribute("aria-valuetext") !== null;
  parent.document.body.append(Object.assign(parent.document.createElement("pre"), { id: "found", textContent: JSON.stringify(found) }));
})();
"""


# For a page without motion.
STILL = """
(() => {
  const found = { noted, requests: performance.getEntriesByType("resource").length, room: innerWidth, wide: document.documentElement.scrollWidth };
  found.pictures = [...document.querySelectorAll("svg")].map(svg => ({
    width: svg.getBoundingClientRect().width, drawn: svg.querySelectorAll("path,line,circle").length, named: Boolean(svg.querySelector("title") || svg.getAttribute("aria-label"))}));
  parent.document.body.append(Object.assign(parent.document.createElement("pre"), { id: "found", textContent: JSON.stringify(found) }));
})();
"""


# Any page on a phone: what is cut off, too small to read, or broken.
NARROW = """
(() => {
  const faults = [], say = (what, element) => faults.push(what + ": " + (element.textContent || element.className).trim().replace(/\\s+/g, " ").slice(0, 60));
  for (const details of document.querySelectorAll("details")) details.open = true;
  const seen = element => element.checkVisibility() && element.getClientRects().length > 0;
  if (document.documentElement.scrollWidth > innerWidth) faults.push(document.documentElement.scrollWidth + " px wide in a window of " + innerWidth);
  for (const element of document.querySelectorAll("main *")) {
    if (element.closest("svg") || !seen(element) || element.clientWidth === 1) continue;  // 1 px: for screen readers only
    if (element.scrollWidth > element.clientWidth + 1 && getComputedStyle(element).overflowX !== "visible") say("cut at " + element.clientWidth + " of " + element.scrollWidth + " px, " + element.tagName, element);
    const right = element.getBoundingClientRect().right;
    if (right > innerWidth + 1 && element.parentElement.getBoundingClientRect().right <= innerWidth + 1) say("beyond the right edge, " + element.tagName, element);
  }
  for (const svg of document.querySelectorAll("svg")) {
    if (!seen(svg)) continue;
    const paper = svg.getBoundingClientRect();
    for (const text of svg.querySelectorAll("text")) {
      if (!text.textContent.trim() || !seen(text) || text.ownerSVGElement !== svg) continue;
      const box = text.getBoundingClientRect(), matrix = text.getScreenCTM(), scale = Math.hypot(matrix.a, matrix.b);
      const size = parseFloat(getComputedStyle(text).fontSize) * scale;
      if (size < 10.95) say("text of " + size.toFixed(1) + " px", text);
      const out = Math.max(paper.left - box.left, box.right - paper.right, paper.top - box.top, box.bottom - paper.bottom);
      const clipped = box.right < paper.left || box.left > paper.right || box.bottom < paper.top || box.top > paper.bottom;  // of a detail
      if (out > 8 && !clipped) say("text " + out.toFixed(0) + " px beyond its picture", text);
    }
  }
  // A short word on two lines. Line breaks at blanks, dots, underscores and signs are wanted.
  const walker = document.createTreeWalker(document.querySelector("main"), NodeFilter.SHOW_TEXT);
  for (let node = walker.nextNode(); node; node = walker.nextNode()) {
    if (node.parentElement.closest("svg,script,style") || !seen(node.parentElement)) continue;
    for (const word of node.data.matchAll(/[\\p{L}\\p{N}]+/gu)) {
      if (word[0].length > 14) continue;
      const range = document.createRange();
      range.setStart(node, word.index);
      range.setEnd(node, word.index + word[0].length);
      const tops = new Set([...range.getClientRects()].map(rect => Math.round(rect.top)));
      if (tops.size > 1) say("the word '" + word[0] + "' is broken", node.parentElement);
    }
  }
  parent.document.body.append(Object.assign(parent.document.createElement("pre"), { id: "found", textContent: JSON.stringify({ faults: [...new Set(faults)], noted }) }));
})();
"""


def browser():
    return next((path for path in map(shutil.which, ("chromium", "chromium-browser", "google-chrome")) if path), None)


def script(words):
    return f"<script>//<![CDATA[\n{words}\n//]]></script>"


def seen_in(page, alphas, width, options=(), after=AFTER.replace("DRAWN", LEVER)):
    """The values that `after` found on the page."""
    page = page.replace("<head>", "<head>" + script(BEFORE), 1)
    page = page.replace("</body>", script(after.replace("ALPHAS", json.dumps(alphas))) + "</body>", 1)
    # In a frame, because a window of Chromium is at least 500 px wide.
    frame = f'<!DOCTYPE html><body><iframe width="{width}" height="900" srcdoc="{html.escape(page)}"></iframe></body>'
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder, "page.html")
        file.write_text(frame, encoding="utf-8")
        command = [browser(), "--headless", "--no-sandbox", "--disable-dev-shm-usage", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", f"--user-data-dir={folder}/user",
                   "--virtual-time-budget=20000", "--window-size=1300,1000", *options, "--dump-dom", file.as_uri()]
        text = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, timeout=120, check=False).stdout.decode()
    if '<pre id="found">' not in text:
        return None
    return json.loads(html.unescape(text.split('<pre id="found">')[1].split("</pre>")[0]))


def number_of(words):
    try:
        return float(words.rstrip("°").replace("\u2212", "-"))
    except ValueError:
        return None


def faults_of_words(place, row):
    theta = float(row["theta_deg"])
    if number_of(place["shown"]) is None or abs(number_of(place["shown"]) - theta) > 0.00501:
        yield f"at alpha = {row['alpha_deg']} the page says {place['shown']}, not {theta}"


def faults_of_motion(found, rows, lever):
    """Compares the drawing with the table of another program."""
    for place, row in zip(found["places"], rows):
        alpha, theta = float(row["alpha_deg"]), float(row["theta_deg"])
        yield from faults_of_words(place, row)
        if abs(place["theta"] - theta - lever.angle) > 0.05:
            yield f"at alpha = {alpha} the lever is drawn at {place['theta']:.3f} deg, not {theta + lever.angle}"
        if abs(place["lever"] - lever.length) > 0.003 * lever.length:
            yield f"the lever is drawn {place['lever']:.2f} mm long, not {lever.length}"
        if abs(place["turn"] - alpha) > 0.01:
            yield f"at alpha = {alpha} the pulley is drawn at {place['turn']}"
    for k in (0, 1):
        lengths = [place["lengths"][k] for place in found["places"]]
        if max(lengths) - min(lengths) > 0.004 * lever.length:
            yield f"tendon {k + 1} is drawn from {min(lengths):.2f} to {max(lengths):.2f} mm long over the stroke"


@dataclasses.dataclass
class Helix:
    """A multi-turn pulley: the grooves of profile.csv, and the tendons."""
    height: float   # mm, of the grooves' part
    spirals: list   # of P1 and P2: turn_deg, x_mm, y_mm, z_mm, in order
    pins: list      # in the pulley's plane, mm, joint above
    pin_radius: float  # to the tendon's centre line

    def drawn(self):
        return HELIX.replace("HEIGHT", repr(self.height))

    def lead(self, k):
        first, last = self.spirals[k][0], self.spirals[k][-1]
        return abs((last[3] - first[3]) / (last[0] - first[0])) * 360.0

    def take_off(self, k, z):
        """The point of a groove at a height: turn_deg, x, y."""
        spiral = self.spirals[k]
        for a, b in zip(spiral, spiral[1:]):
            if min(a[3], b[3]) <= z <= max(a[3], b[3]) and a[3] != b[3]:
                share = (z - a[3]) / (b[3] - a[3])
                return [p + share * (q - p) for p, q in zip(a[:3], b[:3])]
        return None

    def faults(self, found, rows):
        for place, row in zip(found["places"], rows):
            alpha = float(row["alpha_deg"])
            yield from faults_of_words(place, row)
            c, s = math.cos(math.radians(alpha)), math.sin(math.radians(alpha))
            for k, (right, z) in enumerate(place["takeOffs"]):
                at = self.take_off(k, z)
                if at is None:
                    yield f"at alpha = {alpha} tendon {k + 1} leaves at the height {z:.2f} mm, where there is no groove"
                    continue
                turn, x, y = at
                x, y = x * c + y * s, y * c - x * s  # the pulley turns clockwise
                normal = math.radians(turn - alpha)
                beside = (self.pins[k][0] - x) * math.cos(normal) + (self.pins[k][1] - y) * math.sin(normal)
                if abs(right - y) > 0.02 * self.pins[k][1]:
                    yield f"at alpha = {alpha} the take-off of tendon {k + 1} is drawn {right:.2f} mm to the right, not {y:.2f}"
                # Drawn heights have a resolution of 0.1 px. In mm over the lead, that is a share of a turn, some degrees. The tangent
                # moves by this angle times the pin's distance.
                tolerance = self.pins[k][1] * 2.0 * math.pi * 0.1 / place["scale"] / self.lead(k)
                if abs(abs(beside) - self.pin_radius) > tolerance:
                    yield f"at alpha = {alpha} tendon {k + 1} would leave to {beside:.2f} mm beside its pin's centre, not {self.pin_radius}"
                (u0, z0), (u1, z1) = place["free"][k]
                rise, slope = math.atan2(z1 - z0, u1 - u0), math.radians(float(row[f"slope{k + 1}_deg"]))
                if abs(rise - slope) > 0.02 + 0.05 * abs(slope):
                    yield f"at alpha = {alpha} tendon {k + 1} is drawn rising by {math.degrees(rise):.2f} deg, not {math.degrees(slope):.2f}"


def faults_of_view(found):
    if not found["part"]:
        return
    home, end = found["home"], found["end"]
    if not 0.05 < home["part"] < 0.8:
        yield f"the part covers {100 * home['part']:.1f} % of the 3-D view"
    if home["light"] < 100:
        yield f"the part is lit from behind: mean light {home['light']:.0f} of 255"
    if found["side"]["warm"] < 0.0005 or found["webgl"] and found["side"]["cold"] < 0.0005:
        yield "the grooves of P1 and P2 are not to be seen"
    if found["webgl"] and home["sum"] == end["sum"]:
        yield "the 3-D part does not turn with the pulley"


# Name, width in px, options of Chromium.
WINDOWS = [("wide", 1200, ()), ("phone", 320, ()), ("no WebGL", 800, ("--disable-3d-apis",))]


def faults_of_effects(found):
    for k, (none, once, twice) in enumerate(found["deviations"]):
        if not none < once < twice:
            yield f"effect {k + 1} turned up to 0, 1 and 2 moves the joint by {none:.4f}, {once:.4f} and {twice:.4f} rad as drawn"


def faults(page, rows, joint, windows=WINDOWS):
    """`joint`: a Lever or a Helix."""
    alphas = [float(row["alpha_deg"]) for row in rows]
    is_helical = isinstance(joint, Helix)
    after = AFTER.replace("DRAWN", joint.drawn() if is_helical else LEVER)
    if len(page.encode()) > MOST_BYTES:
        yield f"{len(page.encode())} bytes"
    for name, width, options in windows:
        found = seen_in(page, alphas, width, options, after)
        if found is None:
            yield f"{name}: the page's scripts did not end"
            continue
        if found["part"] and found["webgl"] == (name == "no WebGL"):
            yield f"{name}: WebGL {found['webgl']}"
        motion = joint.faults(found, rows) if is_helical else faults_of_motion(found, rows, joint)
        observed = [*found["noted"], *motion, *faults_of_view(found), *faults_of_effects(found)]
        if found["requests"]:
            observed.append(f"{found['requests']} requests")
        if found["wide"] > found["room"]:
            observed.append(f"{found['wide']} px wide in a window of {found['room']}")
        if not found["label"]:
            observed.append("the slider has no label for screen readers")
        lower_quartile = sorted(found["times"])[len(found["times"]) // 4]  # slower repaints wait for other load on the machine
        if lower_quartile > MOST_FRAME_MS:
            observed.append(f"a frame takes {lower_quartile:.1f} ms")
        print(f"  {name}: {lower_quartile:.2f} ms a frame" + (f", part on {100 * found['home']['part']:.0f} % of the view" if found["part"] else ""))
        yield from (f"{name}: {fault}" for fault in observed)


def still_faults(page):
    if "<script" in page:
        yield "has a script"
    if len(page.encode()) > MOST_BYTES:
        yield f"{len(page.encode())} bytes"
    # allows the judge's own script
    page = page.replace("default-src 'none'", "default-src 'none'; script-src 'unsafe-inline'", 1)
    for width in (320, 1200):
        found = seen_in(page, [], width, (), STILL)
        if found is None:
            yield f"{width} px: the page was not shown"
            continue
        yield from (f"{width} px: {note}" for note in found["noted"])
        if found["requests"]:
            yield f"{width} px: {found['requests']} requests"
        if found["wide"] > found["room"]:
            yield f"{width} px: {found['wide']} px wide in a window of {found['room']}"
        if not found["pictures"]:
            yield f"{width} px: no picture"
        for picture in found["pictures"]:
            if picture["width"] < 100 or picture["drawn"] < 5 or not picture["named"]:
                yield f"{width} px: a picture that shows little: {picture}"


def narrow_faults(page):
    page = page.replace("default-src 'none'; style-src", "default-src 'none'; script-src 'unsafe-inline'; style-src", 1) if "<script" not in page else page
    for width in (400, 320):
        found = seen_in(page, [], width, (), NARROW)
        if found is None:
            yield f"{width} px: the page was not shown"
            continue
        yield from (f"{width} px: {fault}" for fault in [*found["noted"], *found["faults"]])


@dataclasses.dataclass
class Lever:
    """From the joint's axis to the end of tendon 1: distance, mm, and angle from OC at home, deg, to the right."""
    length: float
    angle: float


def lever_of(mechanism):
    joint, d = mechanism["joint"], mechanism["tendon"]["diameter_mm"]
    across, along = joint.get("attachment1_mm", (0.0, joint["length_mm"]))
    length = math.hypot(across, along)
    if "drum_radius_mm" in joint:  # an attachment on the drum's surface is moved to the circle of the centre lines
        length = max(length, joint["drum_radius_mm"] + 0.5 * d)
    return Lever(length, math.degrees(math.atan2(across, along)))


def table(file):
    with open(file, encoding="utf-8") as lines:
        return list(csv.DictReader(lines))


def helix_of(folder, mechanism, page):
    rows = table(folder / "profile.csv")
    spirals = [[[float(row[name]) for name in ("turn_deg", "x_mm", "y_mm", "z_mm")] for row in rows if row["pulley"] == pulley] for pulley in ("P1", "P2")]
    guides, pulley = mechanism["guides"], mechanism["pulley"]
    pins = [(-guides["EB_mm"], pulley["EF_mm"]), (guides["ED_mm"], pulley["EF_mm"])]
    radius = guides["radius_mm"] + (0.5 * mechanism["tendon"]["diameter_mm"] if guides["radius_mm"] > 0 else 0.0)
    height = json.loads(page.split('id="helix">', 1)[1].split("</script>")[0])["top"]
    return Helix(height, spirals, pins, radius)


def read(folder):
    folder = pathlib.Path(folder)
    rows = table(folder / "transmission.csv")
    rows = rows[:: max(1, len(rows) // 24)]
    page = (folder / "report.html").read_text(encoding="utf-8")
    mechanism = json.loads((folder / "manifest.json").read_text(encoding="utf-8"))["mechanism"]
    return page, rows, helix_of(folder, mechanism, page) if 'id="helix">' in page else lever_of(mechanism)


# Changes that break a page: text, its replacement, and words of the expected fault.
BREAKS = {
    "angle": ("place = place_of(alpha), theta = theta_at(place)", "place = place_of(alpha), theta = 0.9 * theta_at(place)", "the lever is drawn at"),
    "tendon": ("turned(points[k], -alpha)", "turned(points[k], alpha)", "mm long over the stroke"),
    "inside out": ("gl.enable(gl.CULL_FACE);\n", "gl.enable(gl.CULL_FACE); gl.cullFace(gl.FRONT);\n", "lit from behind"),
    "blank": ("paint(body, gl.TRIANGLES, corners);\n    gl.uniform1f", "gl.uniform1f", "grooves of P1"),
    "still": ("spin = e.detail;", "", "does not turn"),
    "error": ("const box = document.querySelector(\".moving\");", "missing_name(); const box = 0;", "missing_name"),
    "request": ("(() => {\n  const stage", "new Image().src = '//example.org/x.png';(() => {\n  const stage", "asks for"),
    "wide": ("<main>", "<main><div style=\"width:2500px\">x</div>", "px wide"),
}
NARROW_BREAKS = {
    "small text": ("max(12px,var(--least))", "8px", "text of"),
    "cut table": ("<main>", "<main><div style=\"overflow-x:auto\"><div style=\"width:900px\">x</div></div>", "cut at"),
    "wide": ("<main>", "<main><div style=\"width:2500px\">x</div>", "px wide"),
    "broken word": ("<main>", "<main><p style=\"width:30px;word-break:break-all\">unbroken</p>", "is broken"),
}
# Breaks of pages without a helix only.
LEVER_ALONE = ("angle", "tendon", "error")
HELIX_BREAKS = {
    "turned back": ("px(row[1] * c - row[0] * s, row[2])", "px(row[1] * c + row[0] * s, row[2])", "to the right, not"),
    "height": ("const z = between(side.z, place), {", "const z = between(side.z, place) + 2, {", "beside its pin"),
    "slope": ("z + slope * (data.pin", "z - slope * (data.pin", "is drawn rising by"),
    "angle": ("number(between(data.theta, place), 2)", "number(0.9 * between(data.theta, place), 2)", "the page says"),
}


def self_test(folder):
    page, rows, joint = read(folder)
    failed = 0
    breaks = {name: fault for name, fault in BREAKS.items() if name not in LEVER_ALONE} | HELIX_BREAKS if isinstance(joint, Helix) else BREAKS
    for name, (old, new, word) in breaks.items():
        assert old in page, f"{name}: the page has no {old!r}"
        seen = list(faults(page.replace(old, new, 1), rows[::6], joint, WINDOWS[:1]))
        if not any(word in fault for fault in seen):
            failed += 1
            print(f"{name}: not detected; found {seen}")
    for name, (old, new, word) in NARROW_BREAKS.items():
        seen = list(narrow_faults(page.replace(old, new, 1)))
        if not any(word in fault for fault in seen):
            failed += 1
            print(f"{name}: not detected; found {seen}")
    return 1 if failed else 0


def main():
    if browser() is None:
        return SKIPPED
    if "--still" in sys.argv:
        pages = [argument for argument in sys.argv[1:] if not argument.startswith("-")]
        found = [f"{page}: {fault}" for page in pages for fault in still_faults(pathlib.Path(page).read_text(encoding="utf-8"))]
        print("\n".join(found))
        return 1 if found else 0
    if "--narrow" in sys.argv:
        pages = [argument for argument in sys.argv[1:] if not argument.startswith("-")]
        found = [f"{page}: {fault}" for page in pages for fault in narrow_faults(pathlib.Path(page).read_text(encoding="utf-8"))]
        print("\n".join(found))
        return 1 if found else 0
    folder, *pages = [argument for argument in sys.argv[1:] if not argument.startswith("-")]
    if "--self-test" in sys.argv:
        return self_test(folder)
    page, rows, joint = read(folder)
    found = [f"{folder}: {fault}" for fault in faults(page, rows, joint)]
    for other in pages:
        found += [f"{other}: {fault}" for fault in faults(pathlib.Path(other).read_text(encoding="utf-8"), rows, joint)]
    print("\n".join(found))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())

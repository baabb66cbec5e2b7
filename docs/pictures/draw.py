"""Draws the SVG pictures of docs/ from what the program computes. docs/update.py runs it; so does a test, which compares.

Two pictures are drawn here (the joint that moves, and the slack of round pulleys); the others are figures of the program's own
pages, taken out with the style that they need.
"""

import bisect
import csv
import json
import math
import re
import subprocess
import tempfile
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2]
STYLE = (SOURCE / "export/report/figure.css").read_text() + (SOURCE / "export/kit/kit.css").read_text()

# Beginning of the title of the report's figure of the whole joint at home.
MECHANISM = "The mechanism at θ = 0.0°, α = 0.0°"
FIGURES = [  # picture, mechanism, page, beginning of the figure's title
    ("finger_joint.svg", "finger", "report.html", MECHANISM),
    ("layout_lever.svg", "forearm", "report.html", MECHANISM),
    ("layout_drum.svg", "finger_mcp", "report.html", MECHANISM),
    ("layout_idlers.svg", "elbow_idlers", "report.html", MECHANISM),
    ("layout_sheath.svg", "wrist_sheath", "report.html", MECHANISM),
    ("finger_kit.svg", "finger", "kit.html", "Encoder"),
    ("finger_radii.svg", "finger", "report.html", "Pitch radii"),
]


def made(program, command, mechanism, folder):
    """The folder of files that `fusee COMMAND` makes of a mechanism of profiles/."""
    out = Path(folder, f"{mechanism}_{command}")
    if not out.exists():
        subprocess.run([program, command, SOURCE / f"profiles/{mechanism}.toml", "-q", "-o", out],
                       check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    return out


# Figures of the program's pages ---------------------------------------------------------------------------------------


def used_style(body):
    """The rules of figure.css and kit.css that name only classes of this figure. Colours follow the reader's light or dark screen."""
    classes = set(re.findall(r'[\w-]+', " ".join(re.findall(r'class="([^"]*)"', body)))) | {"figure"}
    rules = re.findall(r"^(?:\.|@media screen).*?\}$", re.sub(r",\n\s*", ",", STYLE).replace(";\n ", ";"), re.M)
    kept = [rule for rule in rules if set(re.findall(r"\.([a-z][\w-]*)", rule.split("{")[0])) <= classes]
    return "\n".join(kept).replace("display:block;width:100%;height:auto", "background:var(--paper)")


def standalone(figure):
    width, height = re.search(r'viewBox="0 0 ([\d.]+) ([\d.]+)"', figure).groups()
    head = f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" class="figure" viewBox="0 0 {width} {height}" role="img">'
    body = re.sub(r"^<svg[^>]*>", "", figure)
    return f"{head}<style>{used_style(body)}</style>{body}\n"


def figure_of(page, title):
    """The svg element of a page whose title begins with `title`."""
    at = page.index(f"<title>{title}")
    begin, depth = page.rindex("<svg", 0, at), 0
    for tag in re.finditer(r"<svg|</svg>", page[begin:]):
        depth += 1 if tag[0] == "<svg" else -1
        if depth == 0:
            return page[begin:begin + tag.end()]
    raise ValueError(title)


# The joint that moves -------------------------------------------------------------------------------------------------


def unit(angle):
    return math.cos(angle), math.sin(angle)


def turned(point, angle):
    c, s = unit(angle)
    return c * point[0] - s * point[1], s * point[0] + c * point[1]


def plus(point, other, factor=1.0):
    return point[0] + factor * other[0], point[1] + factor * other[1]


def nearest_to_zero(angle):
    """The same direction within half a turn of 0."""
    return angle - 2 * math.pi * round(angle / (2 * math.pi))


def tangent(pin, point, rho, side):
    """Direction from the pin's centre to where the line from a point touches a circle of radius rho about it. side: +1 or -1."""
    d = plus(point, pin, -1)
    return math.atan2(d[1], d[0]) + side * math.acos(rho / math.hypot(*d))


class Joint:
    """The joint of a report: its points, its pitch curves and theta(alpha), as the page's own script has them. mm and deg."""

    def __init__(self, program, mechanism, folder):
        out = made(program, "build", mechanism, folder)
        page = (out / "report.html").read_text()
        self.data = json.loads(re.search(r'id="motion"[^>]*>(.*?)</script>', page, re.S)[1])
        with open(out / "transmission.csv", newline="") as file:
            self.rows = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]

    def theta(self, alpha):
        alphas, thetas = self.data["alpha"], self.data["theta"]
        i = min(max(bisect.bisect(alphas, alpha) - 1, 0), len(alphas) - 2)
        u = (alpha - alphas[i]) / (alphas[i + 1] - alphas[i])
        return thetas[i] + u * (thetas[i + 1] - thetas[i])

    def link_end(self, theta):
        return turned((0, self.data["R"]), -math.radians(theta))

    def mounted(self, which, outline=None):
        """A pitch curve at home, about the pulley's axis. `outline`: a curve in place of that of P1 or P2."""
        return [plus(self.data["axis"], point) for point in outline or self.data["outlines"][which]["points"]]

    def tendon(self, which, alpha, theta, outline=None):
        """C, both tangent points on the pin and the contact on the pulley; whether the tendon wraps the pin counter-clockwise; the wound points."""
        data, own = self.data, self.data["outlines"][which]
        points, sign, pin, rho = outline or own["points"], own["sign"], data["pins"][which], data["rho"]
        tie = own["points"][own["end"]]
        end = min(range(len(points)), key=lambda k: abs(nearest_to_zero(math.atan2(*tie) - math.atan2(*points[k]))))
        c = self.link_end(theta)
        places = [plus(data["axis"], turned(point, -math.radians(alpha))) for point in points]
        reference = tangent(pin, data["axis"], rho, sign)
        first = max(range(len(places)), key=lambda k: sign * nearest_to_zero(tangent(pin, places[k], rho, sign) - reference))
        upper, lower = tangent(pin, c, rho, -sign), tangent(pin, places[first], rho, sign)
        wound, k = [places[first]], first
        while k != end and len(wound) < len(places):
            k = (k - sign) % len(places)
            wound.append(places[k])
        return [c, plus(pin, unit(upper), rho), plus(pin, unit(lower), rho), places[first]], nearest_to_zero(lower - upper) > 0, wound

    def round_slack(self):
        """Slack of tendon 2 (mm) on a round P2 of P1's radius at each row; negative: stretch. 0 at home."""
        rows, slack = self.rows, [0.0]
        for a, b in zip(rows, rows[1:]):
            mean = (a["r2_mm"] + b["r2_mm"]) / 2 - a["r1_mm"]
            slack.append(slack[-1] + math.radians(b["alpha_deg"] - a["alpha_deg"]) * mean)
        k = max(i for i, row in enumerate(rows) if row["alpha_deg"] <= 0)
        share = -rows[k]["alpha_deg"] / (rows[k + 1]["alpha_deg"] - rows[k]["alpha_deg"])
        home = slack[k] + share * (slack[k + 1] - slack[k])
        return [value - home for value in slack]


class Sheet:
    """From mm to the picture's units: y points up in the joint, down in the picture."""

    def __init__(self, scale, x, y):
        self.scale, self.x, self.y = scale, x, y

    def at(self, point):
        return f"{self.x + self.scale * point[0]:.1f} {self.y - self.scale * point[1]:.1f}"

    def line(self, points):
        return "M" + "L".join(self.at(point) for point in points)

    def tendon(self, places, grows, rho):
        c, on, off, last = map(self.at, places)
        return f"M{c}L{on}A{self.scale * rho:.1f} {self.scale * rho:.1f} 0 0 {0 if grows else 1} {off}L{last}"

    def circle(self, centre, radius, name):
        x, y = self.at(centre).split()
        return f'<circle class="{name}" cx="{x}" cy="{y}" r="{radius:.1f}"/>'

    def words(self, point, text, name="halo", dx=0.0, dy=0.0):
        x, y = self.at(point).split()
        return f'<text class="{name}" x="{float(x) + dx:.1f}" y="{float(y) + dy:.1f}">{text}</text>'


PICTURE = """.figure .tendon{stroke-width:3.2}
.figure .t1{stroke:var(--p1)}.figure .t2{stroke:var(--p2)}
.figure .body1{fill:var(--p1);fill-opacity:.18;stroke:var(--p1)}.figure .body2{fill:var(--p2);fill-opacity:.18;stroke:var(--p2)}
.figure .box{fill:var(--body);stroke:var(--line)}
.figure .bone{stroke:var(--ink);stroke-width:12;opacity:.22}"""


def picture(width, height, title, body):
    style = used_style(body) + "\n" + PICTURE
    return (f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" class="figure" viewBox="0 0 {width} {height}" role="img">'
            f"<title>{title}</title><style>{style}</style>{body}</svg>\n")


def thinned(points, count):
    """`count` of the points, evenly spaced, with both ends."""
    return [points[round(i * (len(points) - 1) / (count - 1))] for i in range(count)]


def moving_joint(joint):
    """The joint from one end of its range to the other and back, in 6 s, both tendons on the true pitch curves."""
    data, sheet, steps = joint.data, Sheet(4.6, 180, 172), 16
    low, high = data["alpha"][0], data["alpha"][-1]
    forth = [low + (high - low) * (1 - math.cos(math.pi * i / steps)) / 2 for i in range(steps + 1)]
    alphas = forth + forth[-2::-1]
    timing = 'dur="6s" repeatCount="indefinite"'

    def animated(name, values, more=""):
        return f'<animate attributeName="{name}" {timing} values="{";".join(values)}"/>{more}'

    thetas = [joint.theta(alpha) for alpha in alphas]
    axis = sheet.at(data["axis"])
    home = steps // 2
    parts = []
    bone = [sheet.line([(0, 0), joint.link_end(theta)]) for theta in thetas]
    parts.append(f'<path class="bone" d="{bone[home]}">{animated("d", bone)}</path>')
    bodies = "".join(f'<path class="body{which + 1}" d="{sheet.line(thinned(joint.mounted(which), 61))}Z"/>' for which in (0, 1))
    mark = f'<path class="axis-line" d="{sheet.line([data["axis"], plus(data["axis"], (0, 12))])}"/>'
    turns = ";".join(f"{alpha:.1f} {axis}" for alpha in alphas)
    parts.append(f'<g>{bodies}{mark}<animateTransform attributeName="transform" type="rotate" {timing} values="{turns}"/></g>')
    for pin in data["pins"]:
        parts.append(sheet.circle(pin, sheet.scale * data["rho"] - 1.6, "metal"))
    parts += [sheet.circle((0, 0), 6, "metal"), sheet.circle(data["axis"], 5, "metal")]
    for which in (0, 1):
        frames = [joint.tendon(which, alpha, theta) for alpha, theta in zip(alphas, thetas)]
        free = [sheet.tendon(places, grows, data["rho"]) for places, grows, _ in frames]
        wound = [sheet.line(thinned(points, 17)) for _, _, points in frames]
        for values in (free, wound):
            parts.append(f'<path class="tendon t{which + 1}" d="{values[home]}">{animated("d", values)}</path>')
    ends = [sheet.at(joint.link_end(theta)).split() for theta in thetas]
    parts.append(f'<circle class="take-off" cx="{ends[home][0]}" cy="{ends[home][1]}" r="4">' +
                 animated("cx", [end[0] for end in ends]) + animated("cy", [end[1] for end in ends]) + "</circle>")
    parts += [sheet.words((0, 0), "joint", dx=11, dy=5), sheet.words(data["axis"], "motor", dx=48, dy=5),
              sheet.words(data["pins"][0], "tendon 1", "halo end", dx=-14, dy=5), sheet.words(data["pins"][1], "tendon 2", dx=14, dy=5)]
    return picture(360, 410, "A finger's joint moves: both tendons stay taut on the pulleys that fusee made", "".join(parts))


def sagging(sheet, start, end, extra, outward):
    """A line from start to end that is longer by extra mm than the straight one: a parabola to the side named outward."""
    d = plus(end, start, -1)
    length = math.hypot(*d)
    side = (outward * -d[1] / length, outward * d[0] / length)

    def control(depth):
        return plus(plus(start, d, 0.5), side, depth)

    def curve(depth):
        points = [plus(plus((0, 0), start, (1 - t) ** 2), plus(plus((0, 0), control(depth), 2 * t * (1 - t)), end, t * t)) for t in (i / 200 for i in range(201))]
        return sum(math.dist(p, q) for p, q in zip(points, points[1:]))

    low, high = 0.0, length
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if curve(middle) < length + extra else (low, middle)
    return f"M{sheet.at(start)}Q{sheet.at(control(low))} {sheet.at(end)}"


def slack_picture(joint):
    """The finger at the upper end of its range: on two equal round pulleys, and on the pair that fusee made."""
    data = joint.data
    slack = joint.round_slack()
    worst = max(range(len(slack)), key=lambda i: slack[i])
    row = joint.rows[worst]
    alpha, theta, radius = row["alpha_deg"], row["theta_deg"], row["r1_mm"]
    circle = [(radius * math.cos(math.radians(2 * k)), radius * math.sin(math.radians(2 * k))) for k in range(180)]
    parts = []
    for panel, outline in enumerate((circle, None)):
        sheet = Sheet(4.6, 165 + 360 * panel, 160)
        parts.append(sheet.words((0, 0), ("Two equal round pulleys", "The pair that fusee makes")[panel], "heading middle", dy=-138))
        axis = sheet.at(data["axis"])
        outlines = [joint.mounted(which, outline) for which in (0, 1)]
        parts.append(f'<path class="bone" d="{sheet.line([(0, 0), joint.link_end(theta)])}"/>')
        parts.append(f'<g transform="rotate({alpha:.1f} {axis})">' + "".join(
            f'<path class="body{which + 1}" d="{sheet.line(thinned(outlines[which], 61))}Z"/>' for which in (0, 1)) + "</g>")
        for pin in data["pins"]:
            parts.append(sheet.circle(pin, sheet.scale * data["rho"] - 1.6, "metal"))
        parts += [sheet.circle((0, 0), 6, "metal"), sheet.circle(data["axis"], 5, "metal")]
        for which in (0, 1):
            places, grows, wound = joint.tendon(which, alpha, theta, outline)
            loose = panel == 0 and which == 1
            path = sheet.tendon(places, grows, data["rho"])
            if loose:
                path = path[:path.rindex("L")] + sagging(sheet, places[2], places[3], slack[worst], 1)
            parts.append(f'<path class="tendon t{which + 1}" d="{path}"/><path class="tendon t{which + 1}" d="{sheet.line(thinned(wound, 17))}"/>')
        parts.append(sheet.circle(joint.link_end(theta), 4, "take-off"))
        note = f"tendon 2: {slack[worst]:.1f} mm slack" if panel == 0 else "both tendons taut"
        parts.append(sheet.words(data["axis"], note, "halo middle", dy=64))
    return picture(700, 420, f"A finger bent by {theta:.0f}°: round pulleys leave {slack[worst]:.1f} mm of slack, shaped ones none", "".join(parts))


# The modules ----------------------------------------------------------------------------------------------------------

MODULES = {
    "The joint": {"base": "files, units, checks", "mechanism": "the file and its keys", "transmission": "θ(α), paths, arms",
                  "profile": "pitch curves", "helix": "spirals", "joint": "elastic, with friction"},
    "Questions": {"analysis": "forces and errors", "optimize": "better numbers", "paper": "the paper, computed"},
    "Measured data": {"measurement": "runs from CSV", "plan": "which runs", "calibration": "which causes", "correction": "the corrected file"},
    "The part": {"solid": "mesh, one turn", "helical_solid": "mesh, several turns", "kit": "test rig", "model": "for simulators"},
    "Files, commands": {"export": "a function a format", "pipeline": "the verbs", "python": "from Python", "cli": "from a shell"},
}


def module_order():
    """The modules in the order in which they may include each other, as the top CMakeLists.txt has them."""
    text = (SOURCE / "CMakeLists.txt").read_text()
    lines = re.search(r"#\s+(base <- (?:.|\n#)*)", text)[1]
    return re.findall(r"[a-z_]+", lines)


def modules():
    drawn = [name for row in MODULES.values() for name in row]
    if drawn != module_order():
        raise ValueError(f"docs/pictures/draw.py draws {drawn}, CMakeLists.txt has {module_order()}")
    parts = []
    for line, (title, row) in enumerate(MODULES.items()):
        y = 12 + 76 * line
        parts.append(f'<text class="heading end" x="128" y="{y + 30}">{title}</text>')
        for place, (name, about) in enumerate(row.items()):
            x = 142 + 148 * place
            parts.append(f'<rect class="box" x="{x}" y="{y}" width="138" height="50" rx="6"/><text class="heading middle" x="{x + 69}" y="{y + 21}">{name}</text>'
                         f'<text class="soft middle" x="{x + 69}" y="{y + 39}">{about}</text>')
    parts.append('<text class="soft" x="142" y="408">A module includes only modules above it, and to its left.</text>')
    return picture(1040, 420, "The modules of fusee, in the order in which they may include each other", "".join(parts))


def pictures(program):
    """Name and text of every SVG picture of docs/pictures."""
    with tempfile.TemporaryDirectory() as folder:
        texts = {}
        for name, mechanism, page, title in FIGURES:
            out = made(program, "kit" if page == "kit.html" else "build", mechanism, folder)
            texts[name] = standalone(figure_of((out / page).read_text(), title))
        finger = Joint(program, "finger", folder)
        texts["joint.svg"] = moving_joint(finger)
        texts["slack.svg"] = slack_picture(finger)
        texts["modules.svg"] = modules()
        return texts

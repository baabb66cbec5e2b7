"""`fusee calibrate` from the user's view: input, refusals, files and messages."""

import csv
import html.parser
import json
import math
import os
import re
import signal
import subprocess
import time
import unittest

import harness

OUTPUTS = {"calibration.json", "corrected.toml", "compensation.csv", "report.html", "manifest.json"}
RIG = harness.SOURCE / "tests/data/rig"
# Keys of the document for every verdict.
KEYS = {
    "": {"schema", "verdict", "effects", "noise_floor_deg", "before", "after", "held_out", "unexplained_rms_deg", "detectable", "next", "iso230", "correctable"},
    "before": {"rms_deg", "max_deg", "held_out_rms_deg"},
    "after": {"rms_deg", "max_deg", "held_out_rms_deg"},
    "held_out": {"factors", "runs"},
    "iso230": {"before", "after"},
    "iso230.before": {"A_deg", "R_deg", "B_deg", "E_deg", "M_deg"},
    "iso230.after": {"A_deg", "R_deg", "B_deg", "E_deg", "M_deg"},
    "correctable": {"by_pulley_rms_deg", "by_table_rms_deg"},
}
EFFECT_KEYS = {"name", "group", "place", "parameters", "rms_drop_deg"}
VERDICTS = {"not_testable", "not_repeatable", "unexplained", "confounded", "explained", "no_effect"}

RATIO = 'schema = 1\nname = "joint"  # mine\n[transmission]\nkind = "ratio"\nratio = 4.0\n'


def run_csv(lash=0.0, strokes=8, rows=60, seed=1):
    """A joint with play of `lash` deg of alpha and a little repeatable noise."""
    lines = ["alpha_deg,theta_deg"]
    pulley, state = -40.0, seed
    for i in range(strokes * rows + 1):
        share = i % (2 * rows) / rows
        alpha = -40 + 80 * (share if share <= 1 else 2 - share)
        pulley = min(max(pulley, alpha - lash / 2), alpha + lash / 2)
        state = (1103515245 * state + 12345) % 2**31  # the generator of ANSI C
        lines.append(f"{alpha:.4f},{pulley / 4 + 0.02 * (state / 2**31 - 0.5):.5f}")
    return "\n".join(lines) + "\n"


class Calibrate(harness.Scratch):
    def setUp(self):
        super().setUp()
        (self.folder / "joint.toml").write_text(RATIO)
        for i in range(1, 4):
            (self.folder / f"run_{i}.csv").write_text(run_csv(lash=4.0, seed=i))

    def test_writes_files_and_document(self):
        document = self.expect_json("calibrate joint.toml run_1.csv run_2.csv run_3.csv -o out", 0)
        files = self.files("out")
        self.assertEqual(set(files), {"calibration.json", "corrected.toml", "compensation.csv", "report.html", "manifest.json"})
        written = json.loads(files["calibration.json"])
        for key, value in written.items():
            self.assertEqual(document[key], value, key)
        self.assertIn("backlash", [name for effect in written["effects"] for name in effect["group"]])
        self.assertIn(b"# mine", files["corrected.toml"])
        self.assertNotIn(b"http://", files["report.html"].replace(b"http://www.w3.org", b""))
        rows = list(csv.DictReader(files["compensation.csv"].decode().splitlines()))
        self.assertEqual(list(rows[0]), ["theta_deg", "alpha_up_deg", "alpha_down_deg"])
        for row in rows:
            self.assertTrue(all(math.isfinite(float(value)) for value in row.values()))
        middle = rows[len(rows) // 2]
        self.assertAlmostEqual(float(middle["alpha_up_deg"]) - float(middle["alpha_down_deg"]), 4.0, delta=0.3)  # the play

    def assert_numbers(self, value, where):
        """Rejects null, text, switches and infinite numbers."""
        self.assertIsInstance(value, (int, float), where)
        self.assertNotIsInstance(value, bool, where)
        self.assertTrue(math.isfinite(value), where)

    def assert_document(self, document, verdicts):
        self.assertIn(document["verdict"], verdicts)
        self.assertIn(document["verdict"], VERDICTS)
        for path, keys in KEYS.items():
            table = document
            for step in path.split(".") if path else []:
                table = table[step]
            self.assertLessEqual(keys, set(table), path)
            for key in keys:
                if key.endswith("_deg"):
                    self.assert_numbers(table[key], f"{path}.{key}")
        for effect in document["effects"]:
            self.assertLessEqual(EFFECT_KEYS, set(effect))
            self.assertIn(effect["name"], effect["group"])
            self.assert_numbers(effect["rms_drop_deg"], effect["name"])
            self.assertTrue(effect["parameters"])
            for name, parameter in effect["parameters"].items():
                for number in [parameter["value"], *parameter["ci95"]]:
                    self.assert_numbers(number, f"{effect['name']}.{name}")
                self.assertLessEqual(parameter["ci95"][0], parameter["ci95"][1], name)
        for detectable in document["detectable"]:
            self.assertEqual(set(detectable), {"name", "smallest_deg"})
            self.assert_numbers(detectable["smallest_deg"], detectable["name"])
        for measurement in document["next"]:
            self.assertTrue(measurement["kind"] and measurement["text"])
            self.assertEqual("file" in measurement, measurement["kind"] in ("run", "turn_sensor"), measurement)
            self.assert_numbers(measurement["minutes"], measurement["text"])
            self.assertTrue(all(isinstance(name, str) for name in measurement["separates"]))
        for texts in [document["held_out"]["factors"], document["held_out"]["runs"], document["null_combinations"]]:
            self.assertTrue(all(isinstance(text, str) and text for text in texts))
        self.assertTrue(document["summary"].strip())

    def test_document_has_every_key(self):
        (self.folder / "still.csv").write_text("alpha_deg,theta_deg\n" + "1,2\n" * 50)
        (self.folder / "none.csv").write_text(run_csv())
        cases = [("joint.toml run_1.csv run_2.csv run_3.csv", {"explained", "confounded"}),
                 ("joint.toml none.csv", {"no_effect"}),
                 ("joint.toml still.csv", {"not_testable"}),
                 (f"{RIG}/e_one_sweep_only/spec.toml {RIG}/e_one_sweep_only/run_1.csv", {"confounded"})]
        for arguments, verdicts in cases:
            with self.subTest(arguments):
                self.assert_document(self.expect_json(f"calibrate {arguments} --dry-run", 0), verdicts)

    def test_is_reproducible(self):
        self.expect("calibrate joint.toml run_1.csv run_2.csv -o one", 0)
        os.environ["TZ"] = "Pacific/Chatham"
        self.expect("calibrate joint.toml run_1.csv run_2.csv -o two", 0)
        self.assertEqual(self.files("one"), self.files("two"))

    def test_page_is_self_contained(self):
        class Page(html.parser.HTMLParser):
            VOID = {"meta", "br"}

            def __init__(self):
                super().__init__()
                self.open, self.ids, self.words = [], [], ""

            def handle_starttag(self, tag, attributes):
                for name, value in attributes:
                    assert name not in ("src", "href", "srcset", "onload"), f"{tag} {name}={value}"
                    if name == "id":
                        self.ids.append(value)
                if tag not in self.VOID:
                    self.open.append(tag)

            def handle_startendtag(self, tag, attributes):
                pass

            def handle_endtag(self, tag):
                assert self.open.pop() == tag, tag

            def handle_data(self, data):
                if self.open and self.open[-1] not in ("style", "script"):
                    self.words += data

        (self.folder / "joint.toml").write_text(RATIO.replace('"joint"', '"<b>&joint"'))
        self.expect("calibrate joint.toml run_1.csv run_2.csv run_3.csv -o out", 0)
        text = (self.folder / "out/report.html").read_text()
        page = Page()
        page.feed(text)
        self.assertEqual(page.open, [])
        self.assertEqual(page.ids, ["causes", "verdict", "actions", "numbers", "effects", "residuals", "unexplained", "figures", "evidence", "detectable", "data"])
        self.assertIn("<b>&joint", page.words)
        self.assertIn("✓ backlash", page.words)
        self.assertNotRegex(page.words, r"\b(nan|inf|null)\b")
        self.assertNotRegex(text, r"@import|url\(|https?://(?!www\.w3\.org)")
        # Plots before and after have one axis: the same range for each run.
        axes = re.findall(r"<title>(Before|After)</title>.*?data-plot=|data-plot=\"([^\"]*)\"[^>]*><title>(?:Before|After)</title>", text)
        ranges = {tuple(values.split()[-2:]) for _, values in axes if values}
        self.assertEqual(len(ranges), 1, ranges)

    def test_shows_untestable_data(self):
        (self.folder / "still.csv").write_text("alpha_deg,theta_deg\n" + "1,2\n" * 50)
        self.expect("calibrate joint.toml still.csv -o out", 0, "not_testable.*alpha does not change.*Measure next")
        page = self.files("out")["report.html"].decode()
        self.assertRegex(page, "(?s)Why nothing can be concluded.*alpha does not change.*What was logged.*<svg")

    def test_default_folder_is_rewritten(self):
        self.expect("calibrate joint.toml run_1.csv run_2.csv", 0, "joint_calibration")
        self.expect("calibrate joint.toml run_1.csv run_2.csv", 0)
        (self.folder / "out/joint_calibration/report.html").write_text("mine")
        self.expect("calibrate joint.toml run_1.csv run_2.csv", 6, err="report.html")

    def test_summary_fits_terminal(self):
        for more in ["", "-v"]:
            text = self.expect(f"calibrate joint.toml run_1.csv run_2.csv --dry-run {more}", 0, "before +after.*Effects.*backlash.*Correction").stdout.decode()
            self.assertLessEqual(max(len(line) for line in text.splitlines()), 80)
            self.assertRegex(text, r"(?s)Would be written \(--dry-run\).*corrected\.toml +\d+ B.*in out/joint_calibration")
            self.assertEqual(bool(re.search(r"^Tried +odds$", text, re.M)), more == "-v")
        self.assertFalse((self.folder / "out").exists())

    def test_progress_follows_options(self):
        line = "calibrate joint.toml run_1.csv run_2.csv --dry-run"
        self.assertEqual(self.expect(line, 0).stderr.count(b"#"), 0)
        self.assertEqual(self.expect(line + " -q", 0).stderr, b"")
        verbose = self.expect(line + " -v", 0, err=r"reading the runs.*fusee: \d+ %, .*computing the correction")
        self.assertNotIn(b"#", verbose.stderr)
        try:
            ours, theirs = os.openpty()
        except OSError as error:
            self.skipTest(f"no terminal to be had: {error}")
        process = subprocess.Popen([harness.PROGRAM, *line.split()], cwd=self.folder, env=harness.ENVIRONMENT, stdout=subprocess.DEVNULL, stderr=theirs)
        os.close(theirs)
        shown = b""
        try:
            while part := os.read(ours, 4096):
                shown += part
        except OSError:
            pass  # the other end was closed
        os.close(ours)
        process.wait(timeout=60)
        self.assertRegex(shown, rb"\r\x1b\[K\[#+\.*\] \d+ %")
        after = re.sub(rb"\x1b\[[\d;]*m|\r", b"", shown.rpartition(b"\r\x1b[K")[2])
        self.assertEqual(after, self.expect(line, 0).stderr)

    def test_repeated_notes_are_merged(self):
        for i in range(1, 6):
            text = run_csv(seed=i).splitlines()
            (self.folder / f"mid_{i}.csv").write_text("\n".join([text[0], *text[20:]]) + "\n")
        line = "calibrate joint.toml mid_1.csv mid_2.csv mid_3.csv mid_4.csv mid_5.csv --dry-run"
        self.assertEqual(self.expect(line, 0, err="mid_2.csv: .*and 3 more like this").stderr.count(b"first stroke"), 2)
        self.assertEqual(self.expect(line + " -v", 0).stderr.count(b"first stroke"), 5)
        self.assertEqual(sum("first stroke" in note for note in self.expect_json(line, 0)["notes"]), 5)

    def test_corrected_file_has_settings(self):
        self.expect("calibrate joint.toml run_1.csv run_2.csv --set transmission.ratio=4.02 -o out", 0, err="includes the values of --set")
        self.assertRegex(self.files("out")["corrected.toml"], rb"ratio = 4\.02")
        self.expect("calibrate out/corrected.toml run_1.csv --dry-run", 0)

    def test_options_choose_runs_and_columns(self):
        document = self.expect_json("calibrate joint.toml run_1.csv run_2.csv --hold-out run_3.csv --dry-run", 0)
        self.assertEqual(document["held_out"]["runs"], ["run_3.csv"])
        (self.folder / "other.csv").write_text(run_csv().replace("alpha_deg", "left"))
        self.expect("calibrate joint.toml other.csv", 3, err="other.csv:1:1: error: there is no column alpha_deg")
        self.expect("calibrate joint.toml other.csv --column alpha=left --dry-run", 0)
        (self.folder / "other.csv").write_text(run_csv().replace("alpha_deg,theta_deg", "encoder,pot"))
        self.expect("calibrate joint.toml other.csv", 3, err="add --column alpha=encoder --column theta=pot if these are")
        self.expect("calibrate joint.toml other.csv --column alpha=encoder --column theta=pot --dry-run", 0)
        self.expect("calibrate joint.toml other.csv --column alfa=motor", 2, err="did you mean 'alpha'")
        self.expect("calibrate joint.toml other.csv --column motor", 2, err="role=name")

    def test_note_about_a_log_begins_with_its_name(self):
        (self.folder / "other.csv").write_text(run_csv().replace("alpha_deg", "motor"))
        for words in ("calibrate joint.toml other.csv --dry-run", "simulate joint.toml other.csv -o shown.csv"):
            self.expect(words, 0, err=r"(?m)^other.csv: note: alpha: taken from the column \"motor\"")
            self.assertNotIn("fusee: note: other.csv", self.fusee(words + " --force").stderr.decode())

    def test_units_and_counts_agree(self):
        """One motion in degrees, radians and encoder counts gives the same backlash."""
        rows = [line.split(",") for line in run_csv(lash=4.0).splitlines()[1:]]

        def log(name, header, alpha, theta):
            lines = [header, *(f"{20 * i},{alpha(float(a))},{theta(float(t))}" for i, (a, t) in enumerate(rows))]
            (self.folder / name).write_text("\n".join(lines) + "\n")

        def lash(arguments):
            document = self.expect_json(f"calibrate joint.toml {arguments} --dry-run --no-audit", 0)
            backlash = next(effect for effect in document["effects"] if effect["name"] == "backlash")
            return next(iter(backlash["parameters"].values()))["value"]

        log("deg.csv", "Time[ms],alpha_deg,theta_deg", lambda a: f"{a:.4f}", lambda t: f"{t:.5f}")
        log("rad.csv", "t,motor,joint [mrad]", lambda a: f"{math.radians(a):.7f}", lambda t: f"{1000 * math.radians(t):.6f}")
        log("counts.csv", "time_ms,alpha,theta", lambda a: round(100 + a / 360 * 65536) % 65536, lambda t: round(7 - t / 360 * 65536) % 65536)
        expected = lash("deg.csv")
        self.assertAlmostEqual(expected, 4.0, delta=0.1)
        rad = "rad.csv --column time=t --unit time=ms --column alpha=motor --unit alpha=rad --column 'theta=joint [mrad]'"
        self.assertAlmostEqual(lash(rad), expected, delta=1e-3)
        counts = "counts.csv --ticks-per-turn alpha=65536 --zero-ticks alpha=100 --ticks-per-turn theta=-65536 --zero-ticks theta=7"
        self.assertAlmostEqual(lash(counts), expected, delta=0.01)
        self.expect(f"calibrate joint.toml {counts} --dry-run --no-audit", 0, err="alpha in counts of 65536 a turn, 100 at home; .*time in ms")
        log("home.csv", "time_ms,alpha_deg,theta_rad", lambda a: f"{a + 200:.4f}", lambda t: f"{math.radians(t) - 2.5:.7f}")
        home = "home.csv --home-reading alpha=200 --home-reading theta=-2.5"
        self.assertAlmostEqual(lash(home), expected, delta=1e-3)
        self.expect(f"calibrate joint.toml {home} --dry-run --no-audit", 0, err="alpha: the sensor reads 200 deg at home; theta: the sensor reads -2.5 rad at home")
        self.expect("calibrate joint.toml rad.csv --column alpha=motor --column time=t --column 'theta=joint [mrad]'", 3, err="as s, the rows are 20 s apart")

    def test_caliper_reading_decides(self):
        """The sample's pulleys are 1.2 % too small. Measured to 0.2 %, no other effect can take over half of that."""
        profiles = harness.SOURCE / "profiles"
        runs = " ".join(str(run) for run in sorted((profiles / "measured").glob("forearm_*.csv")))
        line = f"calibrate {profiles / 'forearm.toml'} {runs} --no-audit --dry-run"
        groups = [effect["group"] for effect in self.expect_json(line, 0)["effects"]]
        self.assertGreater(len(groups[0]), 1)
        read = self.expect_json(line + " --set 'prior.pulley_scale=[0.988, 0.002]'", 0)
        self.assertEqual([effect["group"] for effect in read["effects"]], [["pulley_scale"]])
        self.assertEqual(read["verdict"], "explained")

    def test_rejects_reading_options(self):
        for option, message in (("--unit time=furlong", "units: s, ms, us"), ("--unit tim=ms", "did you mean 'time'"), ("--unit ms", "role=value"),
                             ("--ticks-per-turn load=4096", "no role 'load'"), ("--ticks-per-turn alpha=many", "'many' is none"),
                             ("--ticks-per-turn alpha=1", "2 or more"), ("--zero-ticks theta=2048 --unit theta=rad", "give --ticks-per-turn theta=N, or"),
                             ("--home-reading load=3", "no role 'load'"), ("--home-reading theta=153,2", "'153,2' is none"),
                             ("--zero-ticks theta=3 --ticks-per-turn theta=9 --home-reading theta=4", "are the same reading")):  # fmt: skip
            self.expect(f"calibrate joint.toml run_1.csv {option}", 2, err=message)

    def test_rejects_unreadable_runs(self):
        self.expect("calibrate joint.toml", 2, err="needs RUN.csv")
        self.expect("calibrate joint.toml nothing.csv", 3, err="No such file")
        (self.folder / "text.csv").write_text("alpha_deg,theta_deg\n1,2\n3,four\n")
        self.expect("calibrate joint.toml text.csv", 3, err='text.csv:3:3: error: theta_deg: "four" is not a number')
        (self.folder / "still.csv").write_text("alpha_deg,theta_deg\n" + "1,2\n" * 50)
        document = self.expect_json("calibrate joint.toml still.csv --dry-run", 0)
        self.assertEqual(document["verdict"], "not_testable")
        self.assertRegex(document["not_testable"][0], "alpha does not change")


class Correction(harness.Scratch):
    """From measured runs to a feasible pulley."""

    def calibrate(self, name):
        folder = RIG / name
        runs = " ".join(str(path) for path in sorted(folder.glob("run_*.csv")))
        return self.expect_json(f"calibrate {folder}/spec.toml {runs} -o out", 0)

    def test_corrected_pulley_passes_checks(self):
        document = self.calibrate("e_one_sweep_only")
        self.assertGreater(document["correctable"]["by_pulley_rms_deg"], 0.3)
        self.assertIn("p1_round", document["correctable"])
        self.expect("build out/corrected.toml --dry-run", 0)


class ForeignFiles(harness.Scratch):
    LINE = "calibrate joint.toml run.csv"

    def setUp(self):
        super().setUp()
        (self.folder / "joint.toml").write_text(RATIO)
        (self.folder / "run.csv").write_text(run_csv(lash=4.0))

    def test_require_force(self):
        (self.folder / "mine").mkdir()
        (self.folder / "mine/report.html").write_text("a week of work")
        self.expect(f"{self.LINE} -o mine", 6, "^$", "fusee did not write: report.html.*--force")
        self.expect(f"{self.LINE} -o mine --dry-run", 6, "^$", "report.html")
        self.assertEqual(self.files("mine"), {"report.html": b"a week of work"})
        self.expect(f"{self.LINE} -o mine --force", 0)
        self.assertEqual(set(self.files("mine")), OUTPUTS)

    def test_unwritable_place_is_reported(self):
        self.expect(f"{self.LINE} -o /proc/fusee", 6, "^$", "/proc")

    @unittest.skipIf(os.geteuid() == 0, "root may write anywhere")
    def test_unwritable_folder_is_reported(self):
        (self.folder / "locked").mkdir(mode=0o500)
        self.expect(f"{self.LINE} -o locked/here", 6, "^$", "locked")

    def test_interrupt_keeps_earlier_files(self):
        self.expect(f"{self.LINE} -o out", 0)
        earlier = self.files("out")
        (self.folder / "run.csv").write_text(run_csv(lash=3.0))
        self.expect(f"{self.LINE} -o later", 0)
        later = self.files("later")
        for number in [signal.SIGINT, signal.SIGTERM]:
            for delay in [0.005, 0.02, 0.05, 0.1]:
                process = subprocess.Popen([harness.PROGRAM, *self.LINE.split(), "-o", "out", "--json"], cwd=self.folder, env=harness.ENVIRONMENT,
                                           stdout=subprocess.PIPE, stderr=subprocess.PIPE)
                time.sleep(delay)
                process.send_signal(number)
                out, _ = process.communicate(timeout=60)
                self.assertIn(process.returncode, (0, 130, -number))
                if process.returncode == 130:
                    self.assertEqual(json.loads(out)["exit"], 130)
                self.assertEqual(self.files("out"), later if process.returncode == 0 else earlier)
                if process.returncode == 0:
                    earlier = later


if __name__ == "__main__":
    harness.main()

"""The table of `fusee analyze`: equal numbers on the terminal, in CSV and in JSON, and never NaN or infinity."""

import csv
import io
import json
import math
import re
import xml.etree.ElementTree

import harness

# Rough pins, rubber, no tension, loads in both directions, a hanging link, other laws.
DIFFICULT_OPTIONS = [
    "",
    "--set load.tip_force_N=10",
    "--set load.tip_force_N=-10 --set guides.friction=0.5",
    "--set load.mass_kg=1 --set load.lever_mm=80 --set load.tilt_deg=90",
    "--set tendon.pretension_N=0 --set load.torque_Nmm=500",
    "--set tendon.modulus_MPa=1000 --set tendon.pretension_N=50 --set guides.friction=2",
    "--set guides.radius_mm=0 --set pulley.method=paper --set load.tip_force_N=5",
    "--set pulley.law=linear --set pulley.ratio=3.2 --set joint.range_deg=[-25,25] --set load.tip_force_N=5",
]


def in_six_digits(value):
    """The value with its numbers as manifests have them."""
    if isinstance(value, dict):
        return {key: in_six_digits(part) for key, part in value.items()}
    if isinstance(value, list):
        return [in_six_digits(part) for part in value]
    return float(f"{value:.6g}") if isinstance(value, float) else value


class Analyze(harness.Scratch):
    def rows(self, arguments):
        return list(csv.DictReader(io.StringIO(self.expect(f"analyze arm.toml --csv {arguments}", 0).stdout.decode())))

    def test_all_numbers_are_finite(self):
        for options in DIFFICULT_OPTIONS:
            with self.subTest(options):
                rows = self.rows(f"{options} --samples 10 --steps 20")
                self.assertEqual(len({row["alpha_deg"] for row in rows}), len(rows))
                for row in rows:
                    for name, value in row.items():
                        if name.endswith(("status", "pin1", "pin2")):
                            self.assertIn(value, ["held", "loose", "stick", "slip_up", "slip_down", "slack"])
                        else:
                            self.assertTrue(math.isfinite(float(value)), f"{name}: {value}")

    def test_cells_without_equilibrium_are_empty(self):
        options = "--set tendon.modulus_MPa=30 --set load.tip_force_N=300 --samples 10"
        text = self.expect(f"analyze arm.toml --csv {options}", 5, "no_equilibrium,,,", "past its dead centre at alpha").stdout.decode()
        self.assertNotIn("nan", text)
        self.assertNotIn("inf", text)
        rows = self.expect_json(f"analyze arm.toml {options}", 5)["rows"]
        self.assertTrue(any(row["rising_theta_deg"] is None for row in rows))

    def test_csv_and_json_agree(self):
        arguments = "--set load.tip_force_N=10 --samples 10"
        document = self.expect_json(f"analyze arm.toml {arguments}", 0)
        rows = self.rows(arguments)
        self.assertEqual([list(row) for row in rows], [list(row) for row in document["rows"]])
        for ours, other in zip(rows, document["rows"]):
            for name, value in other.items():
                if not isinstance(value, str):
                    self.assertEqual(float(ours[name]), value, name)
        self.assertEqual(document["summary"]["largest_tension"]["tendon"], 2)
        self.assertEqual(document["tolerances"][-1]["key"], "all")

    def test_nearly_constant_torque_looks_constant(self):
        """The plot of the motor torque has the wanted torque, and an axis that does not magnify friction."""
        (self.folder / "gravity.toml").write_bytes(self.fusee("new gravity_arm").stdout)
        self.expect("analyze gravity.toml --samples 10 -o gravity.svg", 0)
        plot = re.search(r"Motor torque<.*?Joint angle", (self.folder / "gravity.svg").read_text(), re.S)[0]
        self.assertIn(">wanted<", plot)
        self.expect("analyze arm.toml --samples 10 -o arm.svg", 0)
        self.assertNotIn(">wanted<", (self.folder / "arm.svg").read_text())

    def test_build_summary_agrees_with_analysis(self):
        """The summary, banner and manifest of build have the figures of analyze, to every printed digit."""
        for options in ("--set load.tip_force_N=10", "--set load.tip_force_N=-12 --set guides.friction=0.3", "--set tendon.pretension_N=40",
                       "--set load.torque_Nmm=700 --set motor.travel_deg=180 --set motor.stall_torque_Nmm=300"):
            with self.subTest(options):
                document = self.expect_json(f"analyze arm.toml --samples 10 {options}", 0)
                summary, motor = document["summary"], document.get("motor")
                built = self.expect_json(f"build arm.toml --force -o out/arm {options}", 0)
                manifest = json.loads((self.folder / "out/arm/manifest.json").read_bytes())
                for load in (built["under_load"], manifest["under_load"]):
                    figures = [load[key] for key in ("max_theta_error_deg", "max_theta_error_at_alpha_deg", "slack1", "slack2", "taut_pretension_N",
                                                     "safety_factor")]
                    self.assertEqual(in_six_digits(figures),
                                     in_six_digits([summary["theta_error"]["value_deg"], summary["theta_error"]["alpha_deg"],
                                                    summary["slack1_alpha_deg"], summary["slack2_alpha_deg"], summary["taut_pretension_N"],
                                                    summary["safety_factor"]]))
                self.assertEqual(in_six_digits(built.get("motor")), in_six_digits(motor))
                self.assertEqual(in_six_digits(manifest.get("motor")), in_six_digits(motor))
                text = self.expect(f"build arm.toml --dry-run {options}", 0).stdout.decode()
                error = re.search(r"theta up to ([\d.e-]+) deg off, alpha = (-?[\d.]+) deg", text)
                self.assertEqual(error[1], f"{summary['theta_error']['value_deg']:.3g}")
                self.assertEqual(error[2], f"{summary['theta_error']['alpha_deg']:.1f}")
                self.assertIn(f"safety factor {summary['safety_factor']:.3g}", text)
                if summary["taut_pretension_N"]:
                    self.assertIn(f"tendon.pretension_N >= {summary['taut_pretension_N']:.3g} keeps it taut", text)
                else:
                    self.assertNotIn("slack", text)
                if motor:
                    self.assertIn(f"travel {motor['travel']['needed_deg']:.4g} of 180 deg", text)
                    self.assertIn(f"torque {motor['torque']['needed_Nmm']:.4g} of 300 Nmm", text)
                banner = re.search(r'class="verdict.*?</p>', (self.folder / "out/arm/report.html").read_text(), re.S)[0]
                self.assertIn(f"{summary['theta_error']['value_deg']:.3g}", banner)

    def test_advice_stands_in_cell_of_slack_tendon(self):
        self.expect("analyze arm.toml -o slack.html --samples 10 --set load.tip_force_N=10", 0)
        cells = re.findall(r"<dt>(.*?)</dt><dd>(.*?)</dd>", (self.folder / "slack.html").read_text(), re.S)
        cells = {title: text for title, text in cells}
        self.assertIn("pretension_N", cells["Tendon 1 slack"])
        self.assertIn("over the whole range", cells["Tendon 1 slack"])
        self.assertNotIn("pretension_N", cells["Tendon 2 slack"])

    def test_motor_is_compared(self):
        short = "--set motor.travel_deg=180"
        self.expect(f"analyze arm.toml --samples 10 {short}", 0, r"motor +travel 238\.\d of 180 deg.*suitable: .* \(margin [\d.]+\)",
                    "warning: the motor turns 180 deg, and the range requires 238\\.\\d deg.*try pulley\\.r1_mm = [\\d.]+ to [\\d.]+ \\(now 16\\).*suitable: ")
        self.expect(f"analyze arm.toml --samples 10 {short} --set motor.enforce=true", 4, "Summary", "error: the motor turns 180 deg")
        self.expect("analyze arm.toml --samples 10 --set motor.model=MG996R --set motor.speed_rpm=60 --set motor.travel_deg=300", 0,
                    "MG996R: travel .*joint turns at .* deg/s under the load",
                    "^--set motor.model=MG996R: warning: the motor MG996R does not fit the bore: .*\n  hint: try body.bore = \"horn\" .*\n$")

    def test_strict_turns_warnings_into_failure(self):
        warned = "--set motor.travel_deg=180"
        for command in ("analyze arm.toml --samples 10 -o a.csv", "build arm.toml -o parts"):
            with self.subTest(command):
                self.expect(f"{command} --strict --force", 0)
                self.expect(f"{command} --strict --force {warned}", 5, ".", "exit code 5 because of 1 warning")
                self.assertEqual(self.expect_json(f"{command} --strict --force {warned}", 5)["ok"], False)
                self.expect(f"{command} --force {warned}", 0)
        self.assertTrue((self.folder / "parts/manifest.json").exists())
        (self.folder / "inch.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n")
        self.expect("check inch.obj", 0, "valid", "inches")
        self.expect("check inch.obj --strict", 5, "valid", "because of 1 warning")

    def test_files_are_complete_and_protected(self):
        self.expect("analyze arm.toml -o stroke.csv --samples 10", 0)
        self.assertEqual((self.folder / "stroke.csv").read_text(), self.fusee("analyze arm.toml --csv --samples 10").stdout.decode())
        self.expect("analyze arm.toml -o stroke.csv --samples 10", 6, "^$", "stroke.csv")
        self.expect("analyze arm.toml -o stroke.csv --samples 10 --force", 0)
        self.expect("analyze arm.toml -o stroke.json --samples 10", 0)
        self.expect("analyze arm.toml -o arm.html --samples 10", 0)
        self.assertIn("<h2>The joint moves</h2>", (self.folder / "arm.html").read_text())
        self.assertEqual(json.loads((self.folder / "stroke.json").read_text()), self.expect_json("analyze arm.toml --samples 10", 0)["rows"])

    def test_ending_selects_format(self):
        self.expect("analyze arm.toml -o plots.svg --samples 10", 0)
        picture = (self.folder / "plots.svg").read_text()
        self.assertEqual(xml.etree.ElementTree.fromstring(picture).tag, "{http://www.w3.org/2000/svg}svg")
        for words in ("Motor torque", "Stiffness about the joint", "pulley angle"):
            self.assertIn(words, picture)
        for ending, start in ((".png", b"\x89PNG\r\n\x1a\n"), (".PDF", b"%PDF-")):
            done = self.fusee(f"analyze arm.toml -o plots{ending} --samples 10")
            if b"librsvg" in done.stderr:
                self.assertEqual(done.returncode, 3)
                self.assertFalse((self.folder / f"plots{ending}").exists())
                continue
            self.assertEqual(done.returncode, 0, done.stderr)
            bytes_of = (self.folder / f"plots{ending}").read_bytes()
            self.assertTrue(bytes_of.startswith(start))
            self.assertGreater(len(bytes_of), 10000)
        for name in ("plots.txt", "plots.svgz", "plots"):
            self.expect(f"analyze arm.toml -o {name}", 2, "^$", name)
            self.assertFalse((self.folder / name).exists())

    def test_is_reproducible(self):
        self.assertEqual(self.fusee("analyze arm.toml").stdout, self.fusee("analyze arm.toml").stdout)

    def test_fits_terminal(self):
        for options in DIFFICULT_OPTIONS + ["--set load.tip_force_N=500 --set joint.length_mm=1000 --set guides.EB_mm=500 --set guides.ED_mm=500 "
                                 "--set guides.OE_mm=-400 --set pulley.EF_mm=800 --set pulley.r1_mm=160 --set tendon.diameter_mm=5"]:
            for line in self.fusee(f"analyze arm.toml --samples 10 {options}").stdout.decode().splitlines():
                self.assertLessEqual(len(line), 80, f"{options}: {line}")


if __name__ == "__main__":
    harness.main()

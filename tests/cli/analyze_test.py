"""The table of `fusee analyze`: equal numbers on the terminal, in CSV and in JSON, and never NaN or infinity."""

import csv
import io
import json
import math
import xml.etree.ElementTree

import harness

# Difficult inputs: rough pins, rubber, no tension, loads in both directions, a hanging link, other laws.
STRAINS = [
    "",
    "--set load.tip_force_N=10",
    "--set load.tip_force_N=-10 --set guides.friction=0.5",
    "--set load.mass_kg=1 --set load.lever_mm=80 --set load.tilt_deg=90",
    "--set tendon.pretension_N=0 --set load.torque_Nmm=500",
    "--set tendon.modulus_MPa=1000 --set tendon.pretension_N=50 --set guides.friction=2",
    "--set guides.radius_mm=0 --set pulley.method=paper --set load.tip_force_N=5",
    "--set pulley.law=linear --set pulley.ratio=3.2 --set joint.range_deg=[-25,25] --set load.tip_force_N=5",
]


class Analyze(harness.Scratch):
    def rows(self, arguments):
        return list(csv.DictReader(io.StringIO(self.expect(f"analyze arm.toml --csv {arguments}", 0).stdout.decode())))

    def test_all_numbers_are_finite(self):
        for strain in STRAINS:
            with self.subTest(strain):
                rows = self.rows(f"{strain} --samples 10 --steps 20")
                self.assertEqual(len({row["alpha_deg"] for row in rows}), len(rows))
                for row in rows:
                    for name, value in row.items():
                        if name.endswith(("status", "pin1", "pin2")):
                            self.assertIn(value, ["held", "loose", "stick", "slip_up", "slip_down", "slack"])
                        else:
                            self.assertTrue(math.isfinite(float(value)), f"{name}: {value}")

    def test_cells_without_equilibrium_are_empty(self):
        strain = "--set tendon.modulus_MPa=30 --set load.tip_force_N=300 --samples 10"
        text = self.expect(f"analyze arm.toml --csv {strain}", 5, "no_equilibrium,,,", "past its dead centre at alpha").stdout.decode()
        self.assertNotIn("nan", text)
        self.assertNotIn("inf", text)
        rows = self.expect_json(f"analyze arm.toml {strain}", 5)["rows"]
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
        for strain in STRAINS + ["--set load.tip_force_N=500 --set joint.length_mm=1000 --set guides.EB_mm=500 --set guides.ED_mm=500 "
                                 "--set guides.OE_mm=-400 --set pulley.EF_mm=800 --set pulley.r1_mm=160 --set tendon.diameter_mm=5"]:
            for line in self.fusee(f"analyze arm.toml --samples 10 {strain}").stdout.decode().splitlines():
                self.assertLessEqual(len(line), 80, f"{strain}: {line}")


if __name__ == "__main__":
    harness.main()

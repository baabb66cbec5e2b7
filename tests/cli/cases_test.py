"""One case a line: arguments, exit code, patterns for stdout and stderr. Each also runs with --json."""

import harness

# A rectangle of 1500 by 40.
DXF = "0\nSECTION\n2\nENTITIES\n0\nLWPOLYLINE\n8\nCUT\n90\n4\n70\n1\n10\n0\n20\n0\n10\n1500\n20\n0\n10\n1500\n20\n40\n10\n0\n20\n40\n0\nENDSEC\n0\nEOF\n"
# Files that the cases use in addition to arm.toml.
FILES = {
    "empty.toml": b"",
    "binary.toml": bytes(range(256)) * 40,
    "broken.toml": b"schema = 1\n[joint\n",
    "unknown.toml": b"schema = 1\n[joint]\nlenght_mm = 100\n",
    "many.toml": b"schema = 1\n[joint]\nlength_mm = -1\nrange_deg = 3\n[guides]\nEB_mm = \"wide\"\n[pulley]\nlaw = \"lineal\"\n[tendon]\ndiameter_mm = nan\n",
    "inch.toml": b"""schema = 1
units = "inch"
[joint]
length_mm = 3.5
range_deg = [-30, 30]
[guides]
EB_mm = 1.75
ED_mm = "1 3/4 in"
OE_mm = -1.4
radius_mm = "2 mm"
[pulley]
EF_mm = 2.8
r1_mm = 0.56
[tendon]
diameter_mm = "1 mm"
""",
    "empty.stl": b"",
    "short.stl": b"\0" * 84 + b"\x10",
    "text.stl": b"this is no mesh at all\n",
    "empty.dxf": b"",
    "text.dxf": b"this is no drawing\n",
    "contours.dxf": DXF.encode(),
    "triangle.obj": b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
}
OPTIMIZE = """arm.toml --set optimize.variables='["guides.ED_mm"]' --set optimize.lower='[40]' --set optimize.upper='[60]' """
OPTIMIZE_OTHER = """optimize arm.toml --set optimize.variables='["%s"]' --set optimize.lower='[0]' --set optimize.upper='[1]'"""

ALL_COMMANDS = "new.*explain.*analyze.*build.*check.*rewind.*optimize.*reproduce.*calibrate.*compare.*plan.*simulate.*replay"

CASES = [
    # Help.
    ("--help", 0, ALL_COMMANDS, "^$"),
    ("", 0, ALL_COMMANDS + ".*'fusee build arm.toml' makes the pulley", "^$"),
    ("help", 0, ALL_COMMANDS, "^$"),
    ("help build", 0, "usage: fusee build SPEC.*examples:", "^$"),
    ("help bild", 2, "^$", "unknown command 'bild'.*did you mean 'fusee build'"),
    ("-h", 0, ALL_COMMANDS, "^$"),
    ("--version", 0, r"^fusee \d+\.\d+\.\d+\n$", "^$"),
    ("build --version", 0, "^fusee ", "^$"),
    ("build --help", 0, "usage: fusee build SPEC.*examples:", "^$"),
    ("--help build", 0, "usage: fusee build SPEC", "^$"),
    ("new -h", 0, "usage: fusee new", "^$"),
    ("explain --help", 0, "usage: fusee explain", "^$"),
    ("check --help", 0, "usage: fusee check FILE", "^$"),
    ("rewind --help", 0, "usage: fusee rewind SPEC FILE", "^$"),
    ("replay --help", 0, "usage: fusee replay FILE.*--out DIR", "^$"),
    ("optimize --help", 0, "usage: fusee optimize SPEC.*--then OBJECTIVE", "^$"),
    ("reproduce --help", 0, "usage: fusee reproduce.*--out DIR", "^$"),
    # Inches: what advice says can be typed into the file.
    ("build inch.toml --dry-run", 0, "r1 +from 0.56 to 0.56 in\n", ".*"),
    ("build arm.toml --dry-run --set body.set_screw=M6 --set body.hub_diameter_mm=10", 4, "^$", "note: besides this, no change of a single number"),
    ("build arm.toml --dry-run --set material.shrinkage_percent=1.5", 0, "in the mesh ⌀ .* mm high: 1.52 % larger, for the shrinkage of the print", ".*"),
    ("build inch.toml --dry-run --set pulley.r1_mm=0.05", 4, "^$", "try pulley.r1_mm = 0\\.[0-9]+ or more \\(now 0.05\\)"),
    ("build inch.toml --dry-run --set pulley.r1_mm='1/2 in' --set pulley.EF_mm='7 cm'", 0, "r1 +from 0.5 to 0.5 in\n", ".*"),
    ("build arm.toml --dry-run --set pulley.r1_mm='5/8 in'", 0, "r1 +from 15.875 to 15.875 mm", "^$"),
    ("build arm.toml --dry-run --set pulley.r1_mm=0.63in --set units=centimetre", 3, "^$", "units = \"centimetre\" is not known.*\"mm\" or \"inch\""),
    ("build inch.toml --dry-run --set 'pulley.r1_mm=0.6 kg'", 3, "^$", "must be a number in inches.*3 1/2 in"),
    ("new paper_optimum --set units=inch --set joint.length_mm=3.5", 0, "\nunits = \"inch\"\n.*\nlength_mm = 3.5\n", "^$"),
    # Optimisation.
    ("optimize arm.toml", 3, "^$", "has no \\[optimize\\] variables.*for example"),
    (f"optimize {OPTIMIZE}", 0, "no design is below", ""),
    (f"optimize {OPTIMIZE} --method genetic", 2, "^$", "--method must be ga, certified or pareto"),
    (f"optimize {OPTIMIZE} --then footprnt", 2, "^$", "did you mean footprint"),
    (f"optimize {OPTIMIZE} --method pareto", 3, "^$", "a front needs two or three objectives"),
    (f"optimize {OPTIMIZE} --set optimize.objective=max_tenson", 3, "^$", 'did you mean "max_tension"'),
    (f"optimize {OPTIMIZE} --set optimize.lower='[70]'", 3, "^$", "crossed"),
    (OPTIMIZE_OTHER % "guides.EDD_mm", 3, "^$", "did you mean guides.ED_mm"),
    (OPTIMIZE_OTHER % "cut.kerf_mm", 3, "^$", "cut.kerf_mm has no effect on max_tension"),
    (f'''optimize {OPTIMIZE} --set optimize.constraints='["guides.ED_mm < 3"]' ''', 3, "^$", "character 14.*write <= or >="),
    (f'''optimize {OPTIMIZE} --set optimize.constraints='["guides.ED_mm >= 300"]' ''', 4, "^$", "no design of the box is feasible.*a constraint is violated.*widen"),
    (f"optimize {OPTIMIZE} --set optimize.objective=min_bend --method certified", 3, "^$", "cannot be certified.*certified: max_tension"),
    # Wrong usage.
    ("bild arm.toml", 2, "^$", "unknown command 'bild'.*fusee build"),
    ("zzzzzzzzzz", 2, "^$", "unknown command.*fusee --help"),
    ("build", 2, "^$", "'build' needs SPEC.*usage: fusee build SPEC"),
    ("build arm.toml more.toml", 2, "^$", "'more.toml' is one argument too many"),
    ("rewind arm.toml", 2, "^$", "'rewind' needs FILE"),
    ("check", 2, "^$", "'check' needs FILE"),
    ("build ''", 2, "^$", "SPEC is empty"),
    ("build arm.toml --tolerence-mm 0.1", 2, "^$", "unknown option '--tolerence-mm'.*'--tolerance-mm'"),
    ("build arm.toml -x", 2, "^$", "unknown option '-x'"),
    ("build arm.toml --tolerance-mm", 2, "^$", "--tolerance-mm needs a value"),
    ("build arm.toml -o", 2, "^$", "--out needs a value"),
    ("build arm.toml -o ''", 2, "^$", "--out needs a value"),
    ("build arm.toml -o --force", 2, "^$", "--out needs a value"),
    ("build arm.toml -o a -o b", 2, "^$", "--out is given 2 times"),
    ("build arm.toml --force=yes", 2, "^$", "--force is a switch and takes no value"),
    ("build arm.toml --tolerance-mm 0", 2, "^$", "from 0.0005 to 1 mm; '0' is not"),
    ("build arm.toml --tolerance-mm -1", 2, "^$", "from 0.0005 to 1 mm; '-1' is not"),
    ("build arm.toml --tolerance-mm nan", 2, "^$", "'nan' is not"),
    ("build arm.toml --tolerance-mm 1e999", 2, "^$", "'1e999' is not"),
    ("build arm.toml --tolerance-mm 0,01", 2, "^$", "'0,01' is not"),
    ("analyze arm.toml --steps 10.7", 2, "^$", "--steps must be a whole number; '10.7' is not"),
    ("build arm.toml --max-slack-mm inf", 2, "^$", "'inf' is not"),
    ("build arm.toml --max-theta-error-deg x", 2, "^$", "'x' is not"),
    ("build arm.toml --dxf r13", 2, "^$", "--dxf must be ac1015 or r12"),
    ("build arm.toml --set r1", 2, "^$", "--set takes table.key=value.*for example"),
    ("build arm.toml --set =3", 2, "^$", "--set takes table.key=value"),
    # Options may stand before the command, after it, or after its arguments.
    ("--dry-run build arm.toml", 0, "arm\n", "^$"),
    ("build --dry-run arm.toml", 0, "arm\n", "^$"),
    ("-o parts --set pulley.r1_mm=15.5 --dry-run build arm.toml", 0, r"r1 +from 15\.500 to 15\.500 mm", "^$"),
    ("build arm.toml --dry-run --set pulley.r1_mm=15 --set pulley.r1_mm=15.5", 0, r"r1 +from 15\.500", "^$"),
    ("build --dry-run -- arm.toml", 0, "arm\n", "^$"),
    ("-qv build arm.toml --dry-run", 0, "arm\n", "^$"),
    # Bad mechanism files: exit 3, all errors at once, where, and what to change.
    ("build missing.toml", 3, "^$", "missing.toml: error: .*No such file"),
    ("build .", 3, "^$", "is a directory"),
    ("build empty.toml", 3, "^$", "empty.toml"),
    ("build binary.toml", 3, "^$", "binary.toml"),
    ("build broken.toml", 3, "^$", "broken.toml:2:.*saw the end of the line\n"),
    ("build arm.toml --dry-run --set pulley.r1_mm=60", 4, "^$", "arm.toml: note: try pulley.r1_mm = "),
    ("build unknown.toml", 3, "^$", "unknown.toml:3:1: .*lenght_mm.*length_mm"),
    ("build many.toml", 3, "^$", "many.toml:3:.*many.toml:4:.*many.toml:6:.*many.toml:8:.*linear.*many.toml:10:"),
    ("build /dev/zero", 3, "^$", "is not a regular file"),
    ("build arm.toml --set pulley.r1=15", 3, "^$", "unknown key pulley.r1.*r1_mm"),
    ("build arm.toml --set pully.r1_mm=15", 3, "^$", "pulley"),
    ("build arm.toml --set pulley.r1_mm=nan", 3, "^$", "r1_mm"),
    ("build arm.toml --set pulley.r1_mm=inf", 3, "^$", "r1_mm"),
    ("build arm.toml --set pulley.r1_mm=-3", 3, "^$", "r1_mm"),
    ("build arm.toml --set pulley.r1_mm=wide", 3, "^$", "r1_mm"),
    ("build arm.toml --set joint.range_deg=[30,-30]", 3, "^$", "range_deg"),
    ("build arm.toml --set joint.range_deg=[1,2,3]", 3, "^$", "range_deg"),
    ("build arm.toml --set pulley.law=linear", 3, "^$", "ratio"),
    ("build arm.toml --set pulley.law=table --set pulley.table=none.csv", 3, "^$", "none.csv"),
    ("build arm.toml --set pulley.law=torque", 3, "^$", "requires a wanted torque.*motor_torque_Nmm"),
    ("build arm.toml --set pulley.law=torque --set pulley.torque_table=none.csv", 3, "^$", "none.csv"),
    ("rewind missing.toml triangle.obj", 3, "^$", "missing.toml"),
    # Infeasible designs: exit 4, place, reason and advice.
    ("build arm.toml --set pulley.r1_mm=60", 4, "^$", "error: .*try "),
    ("build arm.toml --set pulley.law=torque --set pulley.motor_torque_Nmm=-300 --set load.torque_Nmm=900", 4, "^$",
     r"error: .*900 N·mm against \+θ at θ = .*the wanted torque of the motor is -300 N·mm.*try pulley\.motor_torque_Nmm"),
    ("build arm.toml --set joint.range_deg=[-80,80]", 4, "^$", "error: "),
    ("build arm.toml --set body.bore_diameter_mm=60", 4, "^$", "error: .*bore"),
    # Forces.
    ("analyze arm.toml", 0, "Geometry.*Forces.*Compliance.*largest tension.*Error budget.*Tolerances.*all ", "^$"),
    ("analyze arm.toml --set load.tip_force_N=10", 0, "tendon 1 slack.*tendon.pretension_N >= ", "^$"),
    ("analyze arm.toml --csv", 0, "^alpha_deg,theta_deg,r1_mm,r2_mm,.*rising_T2_N", "^$"),
    ("analyze arm.toml -o stroke.csv --dry-run", 0, "Summary", "^$"),
    ("analyze arm.toml --steps 1", 2, "^$", "from 2 to 2000"),
    ("analyze arm.toml --samples many", 2, "^$", "'many' is not"),
    ("analyze missing.toml", 3, "^$", "missing.toml"),
    ("analyze arm.toml --set load.mass_kg=-1", 3, "^$", "mass_kg"),
    ("analyze arm.toml --set tendon.pretension_N=0", 0, "Summary", "warning: both tendons are slack over the whole range: nothing holds.*pretension_N >="),
    ("analyze arm.toml --set joint.range_deg=[-30,60]", 4, "^$", "dead centre.*at θ = 53.58°, α = 199°.*try "),
    ("analyze arm.toml --set tendon.modulus_MPa=30 --set load.tip_force_N=300", 5, "Summary", "past its dead centre at alpha = "),
    ("analyze arm.toml --set load.tip_force_N=900", 5, "Summary", "the tendon breaks at alpha = .*hmpe-1.0"),
    ("analyze arm.toml --set tendon.strength_N=20 --set load.tip_force_N=20", 5, "Summary", "the tendon breaks at alpha = .*tendon.strength_N"),
    # Bad parts.
    ("check missing.stl", 3, "^$", "missing.stl"),
    ("check .", 3, "^$", "is a directory"),
    ("check empty.stl", 3, "^$", "empty.stl"),
    ("check short.stl", 3, "^$", "short.stl"),
    ("check text.stl", 3, "^$", "text.stl"),
    ("check empty.dxf", 3, "^$", "empty.dxf"),
    ("check text.dxf", 3, "^$", "text.dxf"),
    ("check arm.toml", 3, "^$", "arm.toml"),
    ("check triangle.obj", 5, r"size 1 × 1 × 0 mm, no volume: the mesh is not closed.*FAILED", "looks like inches \\(× 25.4 = 25.4 × 25.4 × 0 mm\\) or metres.*check '.*' failed"),
    ("check contours.dxf", 0, r"size 1500 × 40 mm, 1 closed path, marks included\n", r"looks like millimetres read as inches \(÷ 25.4 = 59.06 × 1.575 mm\)"),
    ("rewind arm.toml triangle.obj", 3, "^$", "triangle.obj.*groove"),
    ("rewind arm.toml missing.stl", 3, "^$", "missing.stl"),
    ("replay missing.zip", 3, "^$", "missing.zip"),
    ("replay arm.toml", 3, "^$", "arm.toml: error: expected a bundle of fusee"),
    ("replay empty.stl", 3, "^$", "empty.stl: error: .*this is not a bundle of fusee"),
    ("replay arm.toml -o .", 3, "^$", "expected a bundle"),
    # Templates and keys.
    ("new", 0, "paper_optimum", "^$"),
    ("new paper_optimum", 0, r"^#.*schema = 1.*\[joint\]", "^$"),
    ("new paper_optimum --set pulley.r1_mm=15.25", 0, "r1_mm = 15.25", ""),
    ("new paper_optimun", 3, "^$", "paper_optimum"),
    ("explain", 0, "length_mm.*EF_mm", "^$"),
    ("explain pulley.r1_mm", 0, "mm", "^$"),
    ("explain pulley", 0, "EF_mm.*r1_mm", "^$"),
    ("explain pulley.r1_m", 3, "^$", "r1_mm"),
    ("explain Dyneema", 3, "^$", "the word occurs in fusee explain tendon\\.diameter_mm"),
    ("explain xyzzy", 3, "^$", "fusee explain lists all keys"),
    ("compare", 2, "^$", "usage: fusee compare SPEC --before FILE... --after FILE..."),
    ("explain --schema", 0, "\"\\$schema\"", "^$"),
]


class Cases(harness.Scratch):
    def setUp(self):
        super().setUp()
        for name, content in FILES.items():
            (self.folder / name).write_bytes(content)

    def test_every_case(self):
        before = sorted(self.folder.rglob("*"))
        for arguments, code, out, err in CASES:
            with self.subTest(arguments):
                self.expect(arguments, code, out, err)
                self.expect_json(arguments, code)
        self.assertEqual(sorted(self.folder.rglob("*")), before, "a case left something behind")

    def test_rejects_huge_file_at_once(self):
        with open(self.folder / "huge.toml", "wb") as huge:
            huge.truncate(100 << 20)
        self.expect("build huge.toml", 3, "^$", "huge.toml: error: .*larger")


if __name__ == "__main__":
    harness.main()

"""--bundle and replay: a bundle has exactly the files that the run read, and its replay gives the same result."""

import hashlib
import json
import os
import re
import shutil
import subprocess
import time
import unittest
import warnings
import zipfile

import harness

TABLE = "alpha_deg,theta_deg\n" + "".join(f"{2 * angle},{angle}\n" for angle in range(-40, 41, 2))


class Packed(harness.Scratch):
    def pack(self, words, code, bundle="bug.zip", cwd=None):
        """Runs with --bundle; returns the process and the index of the bundle."""
        done = harness.fusee([*words, "--bundle", str(self.folder / bundle)], cwd or self.folder)
        self.assertEqual(done.returncode, code, done.stderr.decode())
        with zipfile.ZipFile(self.folder / bundle) as archive:
            return done, json.loads(archive.read("bundle.json"))

    def replay(self, code=0, bundle="bug.zip", options=()):
        elsewhere = self.folder / "elsewhere"
        elsewhere.mkdir(exist_ok=True)
        shutil.copy(self.folder / bundle, elsewhere / bundle)
        done = harness.fusee(["replay", bundle, *options], elsewhere)
        self.assertEqual(done.returncode, code, done.stdout.decode() + done.stderr.decode())
        return done

    def runs(self):
        self.expect("plan arm.toml -q", 0)
        self.expect("simulate arm.toml out/arm_plan/run_1.csv -o run.csv --noise-deg 0.02 -q", 0)

    def edit(self, bundle, change, add=()):
        with zipfile.ZipFile(self.folder / bundle) as archive:
            entries = {name: archive.read(name) for name in archive.namelist()}
        index = json.loads(entries["bundle.json"])
        change(index)
        entries["bundle.json"] = json.dumps(index).encode()
        with warnings.catch_warnings(), zipfile.ZipFile(self.folder / bundle, "w") as archive:
            warnings.simplefilter("ignore")  # duplicate names
            for name, content in [*entries.items(), *add]:
                archive.writestr(name, content)


class Bundles(Packed):
    def test_replays_every_command(self):
        self.build("p")
        self.runs()
        (self.folder / "law.csv").write_text(TABLE)
        (self.folder / "broken.toml").write_text("schema = 1\n[joint\n")
        box = ["--set", 'optimize.variables=["guides.ED_mm"]', "--set", "optimize.lower=[40]", "--set", "optimize.upper=[60]"]
        cases = [
            (["build", "arm.toml"], 0, ["arm.toml"]),
            (["build", "arm.toml", "--dry-run", "--json"], 0, ["arm.toml"]),
            (["build", "arm.toml", "--set", "pulley.r1_mm=60"], 4, ["arm.toml"]),
            (["build", "arm.toml", "--set", "pulley.law=table", "--set", "pulley.table=law.csv", "--dry-run"], None, ["arm.toml", "law.csv"]),
            (["build", "broken.toml"], 3, ["broken.toml"]),
            (["build", "missing.toml"], 3, []),
            (["build", "arm.toml", "--tolerence-mm", "1"], 2, []),
            (["bild", "arm.toml"], 2, []),
            (["check", "p/pulley.stl"], 0, ["p/pulley.stl"]),
            (["check", "arm.toml"], 3, ["arm.toml"]),
            (["check", "."], 3, []),
            (["check", ".."], 3, []),
            (["rewind", "arm.toml", "p/profile.dxf", "--json"], 0, ["arm.toml", "p/profile.dxf"]),
            (["rewind", "arm.toml", "p/pulley.stl", "--max-theta-error-deg", "1e-9"], 5, ["arm.toml", "p/pulley.stl"]),
            (["analyze", "arm.toml", "-o", "stroke.csv"], 0, ["arm.toml"]),
            (["optimize", "arm.toml", *box, "-o", "new.toml"], 0, ["arm.toml"]),
            (["optimize", "arm.toml"], 3, ["arm.toml"]),
            (["plan", "arm.toml", "--minutes", "2"], 0, ["arm.toml"]),
            (["simulate", "arm.toml", "run.csv", "-o", "shown.csv"], 0, ["arm.toml", "run.csv"]),
            (["calibrate", "arm.toml", "run.csv", "--no-audit"], 0, ["arm.toml", "run.csv"]),
            (["calibrate", "arm.toml", "none.csv"], 3, ["arm.toml"]),
            (["reproduce", "-o", "paper"], 0, []),
            (["new", "forearm"], 0, []),
            (["explain", "pulley.r1_mm"], 0, []),
        ]
        for words, code, read in cases:
            with self.subTest(words):
                done, index = self.pack(words, code if code is not None else self.fusee(words).returncode)
                self.assertEqual(index["exit"], done.returncode)
                self.assertEqual([file["path"] for file in index["files"] if "failure" not in file], read)
                if words != ["check", ".."]:
                    self.assertEqual(index["command"], words)
                self.assertIn("the same", self.replay().stdout.decode())

    def test_has_input_and_no_local_names(self):
        secret = self.folder / "of-anna" / "deep"
        secret.mkdir(parents=True)
        spec = (self.folder / "arm.toml").read_text().replace("[pulley]", '[pulley]\nlaw = "table"\ntable = "../law.csv"')
        (secret / "arm.toml").write_text(spec)
        (secret / "unread.toml").write_text(spec)
        (secret.parent / "law.csv").write_text(TABLE)
        work = self.folder / "work"
        work.mkdir()
        for words in [["build", str(secret / "arm.toml"), "-o", str(secret.parent / "made")],
                      ["build", "../of-anna/deep/arm.toml", f"--out={secret.parent}/made"],
                      ["analyze", str(secret / "arm.toml"), "-o", str(secret.parent / "no.such" / "x.csv")],
                      ["check", str(secret)],
                      ["build", str(secret / "arm.toml"), "-o", str(secret / "arm.toml")],
                      ["build", str(secret / "arm.toml"), "--set", f"pulley.table={secret.parent}/law.csv", "--dry-run"]]:
            with self.subTest(words):
                (self.folder / "bug.zip").unlink(missing_ok=True)
                code = harness.fusee([*words, "--bundle", str(self.folder / "bug.zip")], work).returncode
                with zipfile.ZipFile(self.folder / "bug.zip") as archive:
                    content = b"".join(archive.read(name) for name in archive.namelist()) + "".join(archive.namelist()).encode()
                    files = {name: archive.read(name) for name in archive.namelist() if name.startswith("files/")}
                for name in [self.folder.name, "of-anna", "unread"]:
                    self.assertNotIn(name.encode(), content)
                allowed = {spec.encode(), TABLE.encode()}
                self.assertLessEqual(set(files.values()), allowed)
                if code != 6:  # existing output files are not packed
                    self.replay()

    def test_finds_table_with_absolute_path(self):
        place = self.folder / "tables"
        place.mkdir()
        (place / "law.csv").write_text(TABLE)
        spec = (self.folder / "arm.toml").read_text().replace("[pulley]", f'[pulley]\nlaw = "table"\ntable = "{place}/law.csv"')
        (self.folder / "arm.toml").write_text(spec)
        self.pack(["analyze", "arm.toml"], 0)
        shutil.rmtree(place)
        self.replay()

    def test_distinguishes_files_of_one_name(self):
        self.runs()
        for folder in ["a", "b"]:
            (self.folder / folder).mkdir()
        rows = (self.folder / "run.csv").read_text().splitlines(True)
        (self.folder / "a/run.csv").write_text("".join(rows[:len(rows) // 2]))
        (self.folder / "b/run.csv").write_text("".join(rows[:1] + rows[len(rows) // 2:]))
        self.pack(["calibrate", "arm.toml", "a/run.csv", "b/run.csv", "--no-audit", "--dry-run"], 0)
        self.replay()

    def test_is_reproducible(self):
        self.pack(["build", "arm.toml"], 0, "one.zip")
        os.environ["TZ"] = "Pacific/Chatham"
        self.pack(["build", "arm.toml"], 0, "two.zip")
        self.assertEqual((self.folder / "one.zip").read_bytes(), (self.folder / "two.zip").read_bytes())

    def test_recreates_existing_outputs(self):
        (self.folder / "out/arm").mkdir(parents=True)
        (self.folder / "out/arm/pulley.stl").write_text("mine")
        (self.folder / "stroke.csv").write_text("mine")
        (self.folder / "new.csv").mkdir()
        for words in [["build", "arm.toml"], ["analyze", "arm.toml", "-o", "stroke.csv"], ["analyze", "arm.toml", "-o", "new.csv"],
                      ["analyze", "arm.toml", "-o", str(self.folder / "stroke.csv")]]:
            with self.subTest(words):
                self.pack(words, 6)
                self.replay()
                with zipfile.ZipFile(self.folder / "bug.zip") as archive:
                    self.assertNotIn("mine", archive.read("bundle.json").decode())

    def test_reports_differences(self):
        self.pack(["build", "arm.toml", "--dry-run"], 0)
        self.edit("bug.zip", lambda index: index.update(exit=4, version="0.0.9"))
        done = self.replay(5)
        self.assertRegex(done.stdout.decode(), "differs +exit code\n +then +4\n +now +0")
        self.assertIn("the bundle was made by fusee 0.0.9", done.stderr.decode())

    def test_keeps_files_in_given_folder(self):
        self.pack(["build", "arm.toml", "-o", "made"], 0)
        made = self.files("made")
        self.replay(options=["-o", "again"])
        again = self.folder / "elsewhere/again"
        self.assertEqual(sorted(path.name for path in again.iterdir()), ["arm.toml", "made"])
        self.assertEqual({path.name: path.read_bytes() for path in (again / "made").iterdir()}, made)
        self.replay(6, options=["-o", "again"])
        self.assertEqual(sorted(path.name for path in (self.folder / "elsewhere").iterdir()), ["again", "bug.zip"])

    def test_does_not_overwrite_other_files(self):
        before = (self.folder / "arm.toml").read_bytes()
        (self.folder / "other.zip").write_bytes(b"PK\3\4 another zip")
        for name in ["arm.toml", "other.zip", "."]:
            self.expect(f"build arm.toml --dry-run --bundle {name}", 6, "^$", "exists and is not a bundle")
        self.expect("build arm.toml --dry-run --force --bundle arm.toml", 6, "", "is one of the input files")
        self.assertEqual((self.folder / "arm.toml").read_bytes(), before)
        self.expect("build arm.toml --dry-run --force --bundle other.zip", 0)
        self.expect("build arm.toml --dry-run --bundle other.zip", 0)
        self.expect("build arm.toml --bundle", 2, "^$", "--bundle needs a value")
        self.expect("build arm.toml --bundle=", 2, "^$", "--bundle needs a value")
        self.expect("build arm.toml --dry-run --bundle /proc/bug.zip", 6, "", "bug.zip|/proc")

    def test_document_names_bundle(self):
        document = self.expect_json("analyze arm.toml --bundle bug.zip", 0)
        self.assertEqual(document["bundle"], "bug.zip")
        document = self.expect_json("replay bug.zip", 0)
        self.assertTrue(document["same"])
        self.assertEqual(document["replayed"], ["analyze", "arm.toml", "--json"])

    def test_packs_pipe(self):
        self.runs()
        done = subprocess.run(["bash", "-c", "fusee simulate arm.toml <(cat run.csv) --bundle bug.zip"], cwd=self.folder, env=harness.ENVIRONMENT, capture_output=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.replay()

    def test_replays_output_in_working_folder(self):
        for words in [["build", "arm.toml", "-o", "."], ["build", "arm.toml", "--out=./"], ["plan", "arm.toml", "-o", "."]]:
            with self.subTest(words):
                self.pack(words, 0)
                begin = time.monotonic()
                self.assertIn("the same", self.replay().stdout.decode())
                self.assertLess(time.monotonic() - begin, 40)  # waiting for its own lock would take 60 s

    def test_works_without_working_folder(self):
        secret = self.folder / "of-anna"
        secret.mkdir()
        shutil.copy(self.folder / "arm.toml", secret)
        for words, code in [(f"build {secret}/arm.toml -o {secret}/made", 0), (f"check {secret}/made/pulley.stl", 0), ("build arm.toml", 3)]:
            with self.subTest(words):
                (self.folder / "bug.zip").unlink(missing_ok=True)
                line = f"mkdir gone && cd gone && rmdir ../gone && fusee {words} --bundle {self.folder}/bug.zip"
                done = subprocess.run(["bash", "-c", line], cwd=self.folder, env=harness.ENVIRONMENT, capture_output=True)
                self.assertEqual(done.returncode, code, done.stderr)
                with zipfile.ZipFile(self.folder / "bug.zip") as archive:
                    content = b"".join(archive.read(name) for name in archive.namelist() if name != "files/outside/arm.toml")
                    content += "".join(archive.namelist()).encode()
                for name in ["of-anna", self.folder.name, "gone"]:
                    self.assertNotIn(name.encode(), content)
                self.assertIn("the same", self.replay().stdout.decode())

    def test_accepts_names_of_any_bytes(self):
        self.runs()
        for i, name in enumerate([b"\xff.csv", b"\xfe.csv", b"a\x1b[2Jb.csv", b".hidden.csv", b"x:\\y.csv", "größe\u202e.csv".encode()]):
            shutil.copy(self.folder / "run.csv", os.path.join(os.fsencode(self.folder), name))
            with self.subTest(name):
                self.pack([b"simulate", b"arm.toml", name, b"-o", b"shown.csv", b"--force"], 0, f"{i}.zip")
                self.assertIn("the same", self.replay(bundle=f"{i}.zip").stdout.decode())
        rows = (self.folder / "run.csv").read_bytes().splitlines(True)
        for name, part in ((b"\xffa.csv", rows[:len(rows) // 2]), (b"\xfeb.csv", rows[:1] + rows[len(rows) // 2:])):
            with open(os.path.join(os.fsencode(self.folder), name), "wb") as run:
                run.write(b"".join(part))
        both = [b"calibrate", b"arm.toml", b"\xffa.csv", b"\xfeb.csv", b"--no-audit", b"-o", b"o\xff\x1b[2J"]
        self.pack(both, 0, "both.zip")
        made = os.path.join(os.fsencode(self.folder), b"o\xff\x1b[2J")
        for file in os.listdir(made):
            with open(os.path.join(made, file), "rb") as output:
                output.read().decode()  # pages must be UTF-8, too
        self.assertIn("the same", self.replay(bundle="both.zip").stdout.decode())
        self.pack([*both, b"--json", b"--force"], 0, "json.zip")
        self.assertIn("the same", self.replay(bundle="json.zip").stdout.decode())
        shutil.copy(self.folder / "arm.toml", os.path.join(os.fsencode(self.folder), b"\xff.toml"))
        self.pack([b"build", b"\xff.toml", b"-o", b".made\xff"], 0, "spec.zip")
        self.assertIn("the same", self.replay(bundle="spec.zip").stdout.decode())

    def test_rejects_questions(self):
        done, index = self.pack(["new", "--ask"], 2)
        self.assertIn("which a bundle cannot record", done.stderr.decode())
        for words in (["new", "--ask"], ["new", "--ask", "--set", "joint.length_mm=50"]):
            self.edit("bug.zip", lambda index: index.update(command=words))
            read, write = os.pipe()  # a reader of this pipe would wait forever
            self.addCleanup(os.close, write)
            done = harness.fusee(["replay", "bug.zip"], self.folder, stdin=read, timeout=20)
            os.close(read)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            self.assertNotRegex(done.stderr.decode(), r"1/\d")  # no question was asked

    @unittest.skipUnless(shutil.which("strace"), "strace is not installed")
    def test_packs_every_opened_file(self):
        self.runs()
        trace = self.folder / "trace"
        subprocess.run(["strace", "-f", "-e", "trace=open,openat", "-o", trace, harness.PROGRAM, "calibrate", "arm.toml", "run.csv", "--no-audit", "--bundle", "bug.zip"],
                       cwd=self.folder, env=harness.ENVIRONMENT, capture_output=True, check=True)
        opened = set(re.findall(r'open(?:at)?\([^"]*"([^"]+)", O_RDONLY[^)]*\) = \d', trace.read_text()))
        inputs = {name for name in opened if not name.startswith(("/lib", "/usr", "/etc", "/proc", "/sys", "/dev")) and os.path.isfile(self.folder / name)}
        with zipfile.ZipFile(self.folder / "bug.zip") as archive:
            packed = {name[6:] for name in archive.namelist() if name.startswith("files/")}
        self.assertEqual({os.path.relpath(name, self.folder) if os.path.isabs(name) else name for name in inputs} - {"bug.zip"} - self.outputs("out/arm_calibration"), packed)

    def outputs(self, folder):
        return {f"{folder}/{name}" for name in os.listdir(self.folder / folder)}


class Hostile(Packed):
    """A bundle from strangers reads nothing on this machine and writes nothing outside of its folder."""

    def setUp(self):
        super().setUp()
        self.pack(["check", "arm.toml"], 3)

    def refuse(self, code, words):
        done = self.replay(code)
        self.assertRegex(done.stderr.decode(), words)
        self.assertEqual([path.name for path in (self.folder / "elsewhere").iterdir()], ["bug.zip"])

    def test_rejects_names_outside(self):
        for name in ["../evil", "/tmp/evil", "files/../../evil", "files/./evil", "files//evil", "files\\evil", "c:evil", "files/", "files/a\nb"]:
            with self.subTest(name):
                self.setUp()
                self.edit("bug.zip", lambda index: None, [(name, "x")])
                self.refuse(3, "bug.zip: error: .*(leads out of the bundle, or is hidden|is a link, a folder)")

    def test_rejects_unlisted_entries(self):
        self.edit("bug.zip", lambda index: None, [("files/more.toml", "x")])
        self.refuse(3, "files/more.toml: is not listed")
        self.setUp()
        self.edit("bug.zip", lambda index: None, [("files/arm.toml", "x")])
        self.refuse(3, "files/arm.toml: occurs twice|sha256")
        self.setUp()
        self.edit("bug.zip", lambda index: index["files"].append(index["files"][0]))
        self.refuse(3, r"files\[1\].path is not in the bundle, or listed twice")

    def test_rejects_links(self):
        link = zipfile.ZipInfo("files/link")
        link.create_system, link.external_attr = 3, 0o120777 << 16
        self.edit("bug.zip", lambda index: None, [(link, "/etc/passwd")])
        self.refuse(3, "files/link: is not a regular file")

    def test_rejects_bombs(self):
        with zipfile.ZipFile(self.folder / "bug.zip", "a", zipfile.ZIP_DEFLATED) as archive:
            with archive.open("files/bomb", "w") as bomb:
                for _ in range(600):
                    bomb.write(b"\0" * (1 << 20))
        self.refuse(3, "files/bomb: unpacks to too much; a bundle may have 512 MiB")

    def test_rejects_other_files(self):
        (self.folder / "bug.zip").write_bytes(b"no zip")
        self.refuse(3, "expected a bundle of fusee")
        with zipfile.ZipFile(self.folder / "bug.zip", "w") as archive:
            archive.writestr("3D/model", "x")
        self.refuse(3, "this is not a bundle of fusee")
        self.setUp()
        self.edit("bug.zip", lambda index: index.update(schema=2))
        self.refuse(3, "schema is not 1")
        self.setUp()
        self.edit("bug.zip", lambda index: index.update(command="build"))
        self.refuse(3, "command is not a list")

    def test_writes_nothing_outside(self):
        outside = self.folder / "outside-of-it"
        for words in [["build", "arm.toml", "-o", str(outside), "--force"], ["build", "arm.toml", "-o", "../../outside-of-it"],
                      ["analyze", "arm.toml", "-o", f"{outside}.csv"], ["build", "arm.toml", f"-o{outside}"]]:
            with self.subTest(words):
                self.edit("bug.zip", lambda index: index.update(command=words, exit=0))
                self.refuse(5, "differs")
                self.assertIn("is outside of the folder", self.replay(5).stdout.decode())
                self.assertFalse(outside.exists() or outside.with_suffix(".csv").exists())

    def test_reads_nothing_of_this_machine(self):
        self.edit("bug.zip", lambda index: index.update(command=["check", str(self.folder / "other.toml")], exit=0))
        self.assertIn("it is not in the bundle", self.replay(5).stdout.decode())

    def test_rejects_nested_replay(self):
        self.edit("bug.zip", lambda index: index.update(command=["replay", "arm.toml"]))
        self.refuse(3, "contains a run of 'fusee replay'")


    def test_prints_no_control_codes(self):
        evil = "a\x1b[2J\x1b]52;c;aGk=\x07\x9b31m\u202eb\r\x7f"
        self.edit("bug.zip", lambda index: index.update(
            version=evil, built_with=evil, runs_on=evil, command=["explain", evil, "'; touch /tmp/x; '"], exit=0,
            messages=[{"severity": "error", "file": evil, "line": 1, "column": 1, "message": evil, "hint": evil}],
            files=[{"path": evil, "failure": {"severity": "error", "file": "", "line": 0, "column": 0, "message": evil, "hint": ""}}],
            outputs=[{"path": evil, "bytes": 1, "sha256": evil}]))
        with zipfile.ZipFile(self.folder / "bug.zip", "r") as archive:
            index = archive.read("bundle.json")
        with zipfile.ZipFile(self.folder / "bug.zip", "w") as archive:
            archive.writestr("bundle.json", index)
            archive.writestr("stdout.txt", evil.encode() + b"\xff\xc2")
        for options in ([], ["-v"], ["--json"]):
            done = self.replay(5, options=options)
            for stream in (done.stdout, done.stderr):
                self.assertIsNone(UNFIT.search(stream.decode()), stream)
        self.assertIn("'\\'';", self.replay(5).stdout.decode())  # quoted for a shell
        json.loads(self.replay(5, options=["--json"]).stdout)

    def test_survives_hostile_bundles(self):
        """Each ends in seconds with a valid exit code, leaves no file, and prints no terminal control code."""
        temporary = self.folder / "temporary"
        temporary.mkdir()
        original = (self.folder / "bug.zip").read_bytes()
        for name, (edit, entries) in hostile(self.folder).items():
            with self.subTest(name):
                (self.folder / "bug.zip").write_bytes(original)
                self.edit("bug.zip", edit, entries)
                before = self.tree()
                for options in ([], ["-o", "kept"]):
                    done = harness.fusee(["replay", "bug.zip", *options], self.folder, stdin=subprocess.DEVNULL, timeout=60,
                                         env={**harness.ENVIRONMENT, "TMPDIR": str(temporary)})
                    self.assertIn(done.returncode, (0, 3, 5), done.stderr)
                    for stream in (done.stdout, done.stderr):
                        self.assertIsNone(UNFIT.search(stream.decode()), stream)
                    if (self.folder / "kept").exists():
                        for path in (self.folder / "kept").rglob("*"):
                            self.assertFalse(path.is_symlink())
                        shutil.rmtree(self.folder / "kept")
                    self.assertEqual(self.tree(), before)

    def tree(self):
        return {str(path): path.read_bytes() if path.is_file() else None for path in self.folder.rglob("*")}


UNFIT = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069\u200e\u200f\u061c\u2028\u2029]")


def hostile(folder):
    """Name → change of bundle.json, and further entries of the zip."""
    nothing = lambda index: None

    def listed(path, content="x"):
        """An entry with a correct index."""
        digest = hashlib.sha256(content.encode()).hexdigest()
        return (lambda index: index["files"].append({"path": path, "bytes": len(content), "sha256": digest})), [("files/" + path, content)]

    def command(*words):
        return (lambda index: index.update(command=list(words), exit=0)), []

    def in_the_way(*paths):
        return (lambda index: index.update(in_the_way=list(paths))), []

    def set_to(key, value):
        return (lambda index: index.update({key: value})), []

    def link(name, target):
        info = zipfile.ZipInfo(name)
        info.create_system, info.external_attr = 3, 0o120777 << 16
        return nothing, [(info, target)]

    victim = str(folder / "arm.toml")
    journal = json.dumps({"tool": "fusee", "outputs": [], "withdrawn": ["../arm.toml", victim]})
    failure = {"severity": "error", "file": "", "line": 0, "column": 0, "message": "x", "hint": ""}
    return {
        "slip": listed("../../evil"), "slip in the middle": listed("a/../../evil"), "absolute": listed(victim), "home": listed("~/evil"),
        "backslash": listed("..\\evil"), "drive": listed("c:/evil"), "stream": listed("arm.toml:x"), "empty part": listed("a//b"),
        "journal": listed(".fusee-3999999-x/.publishing", journal), "journal below": listed("out/.fusee-3999999-x/.publishing", journal),
        "hidden": listed(".bashrc"), "control": listed("a\x1b[2Jb"), "C1": listed("a\x9bb"), "direction": listed("a\u202eb"), "line": listed("a\nb"),
        "long": listed("a" * 1001), "long part": listed("a" * 300), "deep": listed("a/" * 499 + "b"), "no character": listed("a\ufffeb"),
        "case": ((lambda index: [listed(name)[0](index) for name in ("A.csv", "a.csv")]), listed("A.csv")[1] + listed("a.csv")[1]),
        "file and folder": ((lambda index: [listed(name)[0](index) for name in ("d", "d/e")]), listed("d")[1] + listed("d/e")[1]),
        "twice": (nothing, [("stdout.txt", "x")]), "unlisted": (nothing, [("files/unlisted", "x")]), "folder": (nothing, [("files/d/", "")]),
        "link out": link("files/link", "/etc"), "link as stdout": link("files/arm.toml", "/etc/passwd"),
        "many entries": (nothing, [(f"files/{i}", "") for i in range(10 ** 5)]),
        "in the way: out": in_the_way("../evil"), "in the way: absolute": in_the_way(str(folder / "evil")), "in the way: hidden": in_the_way(".fusee-1-x/"),
        "in the way: many": in_the_way(*(f"{i}/" for i in range(200_000))), "in the way: deep": in_the_way(*(f"{i}/" + "a/" * 480 for i in range(100))),
        "in the way: its own file": in_the_way("arm.toml", "arm.toml/"), "in the way: control": in_the_way("a\x1b[2J"),
        "in the way: no text": set_to("in_the_way", [1]),
        "writes outside": command("build", "arm.toml", "-o", str(folder / "evil")), "writes above": command("build", "arm.toml", "-o", ".."),
        "writes over it": command("analyze", "arm.toml", "-o", "../../../../evil.csv", "--force"),
        "packs": command("build", "arm.toml", "--bundle", str(folder / "evil.zip")), "replays": command("replay", "bug.zip"),
        "replays behind": command("--force", "--", "replay", "arm.toml"), "reads": command("check", "/etc/passwd"), "reads stdin": command("check", "/dev/stdin"),
        "asks": command("new", "--ask"), "no words": command(), "odd words": command("\x1b[2J", "\u202e", "\x00"),
        "long words": command("build", "x" * 10 ** 6), "many words": command(*["build"] * 10 ** 5),
        "exit": set_to("exit", 2 ** 70), "exit as text": set_to("exit", "\x1b[2J"), "nested": set_to("messages", [[[[[[[[[[1]]]]]]]]]]),
        "messages": set_to("messages", [failure] * 10 ** 4), "numbers": set_to("junk", list(range(10 ** 6))),
        "size": ((lambda index: index["files"].append({"path": "huge", "bytes": 2 ** 62, "sha256": "0"})), [("files/huge", "x")]),
        "failure twice": ((lambda index: index["files"].extend([{"path": "../../evil", "failure": failure}] * 3)), []),
    }


if __name__ == "__main__":
    harness.main()

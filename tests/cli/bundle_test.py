"""--bundle and replay: whatever a run read is in one file, nothing else is, and it runs again as it ran."""

import json
import os
import re
import shutil
import subprocess
import unittest
import warnings
import zipfile

import harness

TABLE = "alpha_deg,theta_deg\n" + "".join(f"{2 * angle},{angle}\n" for angle in range(-40, 41, 2))


class Packed(harness.Scratch):
    def pack(self, words, code, bundle="bug.zip", cwd=None):
        """What a run with --bundle left: its process, and the index of the bundle."""
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
            warnings.simplefilter("ignore")  # of names that stand twice
            for name, content in [*entries.items(), *add]:
                archive.writestr(name, content)


class Bundles(Packed):
    def test_every_command_ends_as_it_did(self):
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

    def test_holds_what_was_read_and_no_names_of_this_machine(self):
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
                    told = b"".join(archive.read(name) for name in archive.namelist()) + "".join(archive.namelist()).encode()
                    files = {name: archive.read(name) for name in archive.namelist() if name.startswith("files/")}
                for name in [self.folder.name, "of-anna", "unread"]:
                    self.assertNotIn(name.encode(), told)
                allowed = {spec.encode(), TABLE.encode()}
                self.assertLessEqual(set(files.values()), allowed)
                if code != 6:  # what stood where the outputs went is not packed
                    self.replay()

    def test_a_table_with_an_absolute_path_is_found(self):
        place = self.folder / "tables"
        place.mkdir()
        (place / "law.csv").write_text(TABLE)
        spec = (self.folder / "arm.toml").read_text().replace("[pulley]", f'[pulley]\nlaw = "table"\ntable = "{place}/law.csv"')
        (self.folder / "arm.toml").write_text(spec)
        self.pack(["analyze", "arm.toml"], 0)
        shutil.rmtree(place)
        self.replay()

    def test_two_files_of_one_name(self):
        self.runs()
        for folder in ["a", "b"]:
            (self.folder / folder).mkdir()
        rows = (self.folder / "run.csv").read_text().splitlines(True)
        (self.folder / "a/run.csv").write_text("".join(rows[:len(rows) // 2]))
        (self.folder / "b/run.csv").write_text("".join(rows[:1] + rows[len(rows) // 2:]))
        self.pack(["calibrate", "arm.toml", "a/run.csv", "b/run.csv", "--no-audit", "--dry-run"], 0)
        self.replay()

    def test_same_run_same_bytes(self):
        self.pack(["build", "arm.toml"], 0, "one.zip")
        os.environ["TZ"] = "Pacific/Chatham"
        self.pack(["build", "arm.toml"], 0, "two.zip")
        self.assertEqual((self.folder / "one.zip").read_bytes(), (self.folder / "two.zip").read_bytes())

    def test_what_was_in_the_way_is_again(self):
        (self.folder / "out/arm").mkdir(parents=True)
        (self.folder / "out/arm/pulley.stl").write_text("mine")
        (self.folder / "stroke.csv").write_text("mine")
        (self.folder / "new").mkdir()
        for words in [["build", "arm.toml"], ["analyze", "arm.toml", "-o", "stroke.csv"], ["analyze", "arm.toml", "-o", "new"],
                      ["analyze", "arm.toml", "-o", str(self.folder / "stroke.csv")]]:
            with self.subTest(words):
                self.pack(words, 6)
                self.replay()
                with zipfile.ZipFile(self.folder / "bug.zip") as archive:
                    self.assertNotIn("mine", archive.read("bundle.json").decode())

    def test_says_what_differs(self):
        self.pack(["build", "arm.toml", "--dry-run"], 0)
        self.edit("bug.zip", lambda index: index.update(exit=4, version="0.0.9"))
        done = self.replay(5)
        self.assertRegex(done.stdout.decode(), "differs +exit code\n +then +4\n +now +0")
        self.assertIn("the bundle is of fusee 0.0.9", done.stderr.decode())

    def test_leaves_everything_where_it_is_asked_to(self):
        self.pack(["build", "arm.toml", "-o", "made"], 0)
        made = self.files("made")
        self.replay(options=["-o", "again"])
        again = self.folder / "elsewhere/again"
        self.assertEqual(sorted(path.name for path in again.iterdir()), ["arm.toml", "made"])
        self.assertEqual({path.name: path.read_bytes() for path in (again / "made").iterdir()}, made)
        self.replay(6, options=["-o", "again"])
        self.assertEqual(sorted(path.name for path in (self.folder / "elsewhere").iterdir()), ["again", "bug.zip"])

    def test_is_not_written_over_what_is_no_bundle(self):
        before = (self.folder / "arm.toml").read_bytes()
        (self.folder / "other.zip").write_bytes(b"PK\3\4 another zip")
        for name in ["arm.toml", "other.zip", "."]:
            self.expect(f"build arm.toml --dry-run --bundle {name}", 6, "^$", "exists and is no bundle")
        self.expect("build arm.toml --dry-run --force --bundle arm.toml", 6, "", "is one of the files that were read")
        self.assertEqual((self.folder / "arm.toml").read_bytes(), before)
        self.expect("build arm.toml --dry-run --force --bundle other.zip", 0)
        self.expect("build arm.toml --dry-run --bundle other.zip", 0)
        self.expect("build arm.toml --bundle", 2, "^$", "--bundle needs a value")
        self.expect("build arm.toml --bundle=", 2, "^$", "--bundle needs a value")
        self.expect("build arm.toml --dry-run --bundle /proc/bug.zip", 6, "", "bug.zip|/proc")

    def test_document_names_it(self):
        document = self.expect_json("analyze arm.toml --bundle bug.zip", 0)
        self.assertEqual(document["bundle"], "bug.zip")
        document = self.expect_json("replay bug.zip", 0)
        self.assertTrue(document["same"])
        self.assertEqual(document["replayed"], ["analyze", "arm.toml", "--json"])

    def test_a_pipe_is_packed_too(self):
        self.runs()
        done = subprocess.run(["bash", "-c", "fusee simulate arm.toml <(cat run.csv) --bundle bug.zip"], cwd=self.folder, env=harness.ENVIRONMENT, capture_output=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.replay()

    @unittest.skipUnless(shutil.which("strace"), "strace is not installed")
    def test_packs_every_file_that_was_opened(self):
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
    """A bundle from anybody reads nothing here, and writes nothing outside of its folder."""

    def setUp(self):
        super().setUp()
        self.pack(["check", "arm.toml"], 3)

    def refuse(self, code, words):
        done = self.replay(code)
        self.assertRegex(done.stderr.decode(), words)
        self.assertEqual([path.name for path in (self.folder / "elsewhere").iterdir()], ["bug.zip"])

    def test_names_that_lead_out(self):
        for name in ["../evil", "/tmp/evil", "files/../../evil", "files/./evil", "files//evil", "files\\evil", "c:evil", "files/", "files/a\nb"]:
            with self.subTest(name):
                self.setUp()
                self.edit("bug.zip", lambda index: None, [(name, "x")])
                self.refuse(3, "bug.zip: error: .*(leads out of the bundle|is a link, a folder)")

    def test_entries_that_are_not_listed_or_twice(self):
        self.edit("bug.zip", lambda index: None, [("files/more.toml", "x")])
        self.refuse(3, "files/more.toml: is not listed")
        self.setUp()
        self.edit("bug.zip", lambda index: None, [("files/arm.toml", "x")])
        self.refuse(3, "files/arm.toml: stands twice|sha256")
        self.setUp()
        self.edit("bug.zip", lambda index: index["files"].append(index["files"][0]))
        self.refuse(3, r"files\[1\].path is not in the bundle, or listed twice")

    def test_links(self):
        link = zipfile.ZipInfo("files/link")
        link.create_system, link.external_attr = 3, 0o120777 << 16
        self.edit("bug.zip", lambda index: None, [(link, "/etc/passwd")])
        self.refuse(3, "files/link: is a link")

    def test_bombs(self):
        with zipfile.ZipFile(self.folder / "bug.zip", "a", zipfile.ZIP_DEFLATED) as archive:
            with archive.open("files/bomb", "w") as bomb:
                for _ in range(600):
                    bomb.write(b"\0" * (1 << 20))
        self.refuse(3, "files/bomb: unpacks to too much; a bundle may have 512 MiB")

    def test_other_zips_and_other_bytes(self):
        (self.folder / "bug.zip").write_bytes(b"no zip")
        self.refuse(3, "expected a bundle of fusee")
        with zipfile.ZipFile(self.folder / "bug.zip", "w") as archive:
            archive.writestr("3D/model", "x")
        self.refuse(3, "it is no bundle of fusee")
        self.setUp()
        self.edit("bug.zip", lambda index: index.update(schema=2))
        self.refuse(3, "schema is not 1")
        self.setUp()
        self.edit("bug.zip", lambda index: index.update(command="build"))
        self.refuse(3, "command is not a list")

    def test_writes_nothing_outside(self):
        outside = self.folder / "outside-of-it"
        for words in [["build", "arm.toml", "-o", str(outside), "--force"], ["build", "arm.toml", "-o", "../../outside-of-it"],
                      ["analyze", "arm.toml", "-o", str(outside)], ["build", "arm.toml", f"-o{outside}"]]:
            with self.subTest(words):
                self.edit("bug.zip", lambda index: index.update(command=words, exit=0))
                self.refuse(5, "differs")
                self.assertIn("lies outside of the folder", self.replay(5).stdout.decode())
                self.assertFalse(outside.exists())

    def test_reads_nothing_of_this_machine(self):
        self.edit("bug.zip", lambda index: index.update(command=["check", str(self.folder / "arm.toml")], exit=0))
        self.assertIn("it is not in the bundle", self.replay(5).stdout.decode())

    def test_a_replay_is_not_replayed(self):
        self.edit("bug.zip", lambda index: index.update(command=["replay", "arm.toml"]))
        self.refuse(3, "holds a run of 'fusee replay'")


if __name__ == "__main__":
    harness.main()

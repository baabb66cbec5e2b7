"""Completion, tested in the shells; manual pages; the overview of `fusee` alone."""

import hashlib
import json
import shutil
import subprocess
import unittest

import harness


def commands():
    text = subprocess.run([harness.PROGRAM, "--help"], capture_output=True, check=True).stdout.decode()
    return [line.split()[0] for line in text.split("commands:\n")[1].split("\n\n")[0].splitlines()]


class Candidates(harness.Scratch):
    def offered(self, line):
        return [word.split("\t")[0] for word in self.fusee(["completion", "candidates", line]).stdout.decode().splitlines()]

    def test_offers_commands(self):
        self.assertEqual(self.offered("fusee "), commands())
        self.assertEqual(self.offered("fusee bu"), ["build"])
        self.assertEqual(self.offered("fusee -q bu"), ["build"])
        self.assertEqual(self.offered("fus"), [])
        self.assertEqual(self.offered("fusee nonsense "), [])

    def test_offers_options_of_command(self):
        self.assertEqual(self.offered("fusee build --d"), ["--dxf", "--dry-run"])
        self.assertNotIn("--dxf", self.offered("fusee check -"))

    def test_offers_words_of_option(self):
        self.assertEqual(self.offered("fusee build arm.toml --dxf "), ["ac1015", "r12"])
        self.assertEqual(self.offered("fusee optimize --method p"), ["pareto"])
        self.assertEqual(self.offered("fusee build --out "), [":files"])

    def test_offers_keys_and_values(self):
        self.assertEqual(self.offered("fusee build --set pulley.r1"), [":open", "pulley.r1_mm="])
        self.assertEqual(self.offered("fusee build arm.toml --set pulley.law=c"), ["pulley.law=compensate"])
        self.assertEqual(self.offered("fusee build --set 'pulley.law=c"), ["pulley.law=compensate"])
        self.assertEqual(self.offered("fusee explain joint.le"), ["joint.length_mm"])

    def test_offers_arguments_by_position(self):
        self.assertEqual(self.offered("fusee build "), [":files.toml"])
        self.assertEqual(self.offered("fusee build arm.toml "), [])
        self.assertEqual(self.offered("fusee calibrate --hold-out a.csv arm.toml b.csv "), [":files.csv"])
        self.assertEqual(self.offered("fusee compare arm.toml --before a.csv "), [":files"])
        self.assertIn("forearm", self.offered("fusee new "))
        self.assertEqual(self.offered("fusee completion "), ["bash", "zsh", "fish"])

    def test_explains_words(self):
        document = json.loads(self.fusee(["completion", "candidates", "fusee new grip", "--json"]).stdout)
        self.assertEqual([one["word"] for one in document["candidates"]], ["gripper"])
        self.assertTrue(document["candidates"][0]["meaning"])

    def test_survives_any_line(self):
        for line in ["", " ", "'", "\\", "fusee \"", "fusee --set", "fusee " + "x " * 5000, "fusee build \\\\\\", "fusee é\t\x01"]:
            self.fusee(["completion", "candidates", line] if line else ["completion", "candidates"])

    def test_rejects_other_shell(self):
        self.expect("completion tcsh", 2, err="bash, zsh, fish")


class Shells(harness.Scratch):
    def setUp(self):
        super().setUp()
        (self.folder / "notes.txt").write_text("")
        (self.folder / "bin").mkdir()
        (self.folder / "bin/fusee").symlink_to(harness.PROGRAM)
        self.environment = {**harness.ENVIRONMENT, "PATH": f"{self.folder}/bin:/usr/bin:/bin", "HOME": str(self.folder)}

    def run_in(self, shell, script):
        done = subprocess.run([shell, "-c", script], cwd=self.folder, env=self.environment, capture_output=True, timeout=60)
        self.assertEqual(done.stderr.decode(), "")
        return done.stdout.decode().split("\n")[:-1]

    def in_bash(self, *words):
        line = " ".join(words)
        # bash also breaks words at "=".
        broken = [part for word in words for part in (word.replace("=", "\n=\n").split("\n") if "=" in word else [word])]
        quoted = " ".join(f"'{part}'" for part in broken)
        return self.run_in("bash", f"source <(fusee completion bash); compopt() {{ :; }}; COMP_WORDS=({quoted}) COMP_CWORD={len(broken) - 1} COMP_LINE='{line}' COMP_POINT={len(line)};"
                           '_fusee fusee; printf "%s\\n" "${COMPREPLY[@]}"')

    def test_bash_completes_words(self):
        self.assertEqual(self.in_bash("fusee", "bu"), ["build"])
        self.assertEqual(self.in_bash("fusee", "build", "a"), ["arm.toml"])
        self.assertEqual(self.in_bash("fusee", "build", "n"), [""])
        self.assertEqual(self.in_bash("fusee", "build", "--set", "pulley.law=co"), ["compensate"])
        self.assertEqual(self.in_bash("fusee", "build", "--set", "pulley.r1"), ["pulley.r1_mm="])

    @unittest.skipUnless(shutil.which("fish"), "fish is not installed")
    def test_fish_completes_words(self):
        def offered(line):
            return [word.split("\t")[0] for word in self.run_in("fish", f"fusee completion fish | source; complete -C '{line}'")]
        self.assertEqual(offered("fusee bu"), ["build"])
        self.assertEqual(offered("fusee build arm"), ["arm.toml"])
        self.assertEqual(offered("fusee build --set pulley.law=co"), ["pulley.law=compensate"])

    @unittest.skipUnless(shutil.which("zsh"), "zsh is not installed")
    def test_zsh_completes_words(self):
        # zsh's widgets exist only in a terminal, so functions of the same names record their arguments.
        def offered(*words):
            quoted = " ".join(f"'{word}'" for word in words)
            return self.run_in("zsh", "compdef() { :; }; _describe() { shift; print -l -- ${(P)1}; }; _files() { print -- files $2; }; source <(fusee completion zsh);"
                               f"words=({quoted}) CURRENT={len(words)}; _fusee")
        self.assertEqual([word.split(":")[0] for word in offered("fusee", "bu")], ["build"])
        self.assertEqual(offered("fusee", "build", "a"), ["files *.toml(-.)"])
        self.assertEqual(offered("fusee", "build", "--set", "pulley.law=co"), ["pulley.law=compensate"])


class Manual(harness.Scratch):
    def test_troff_reads_every_page(self):
        for command in ["", *commands()]:
            page = self.fusee(["manual", command] if command else ["manual"]).stdout
            self.assertTrue(page.startswith(b".TH FUSEE"))
            if shutil.which("groff"):
                done = subprocess.run(["groff", "-man", "-ww", "-Kutf8", "-Tutf8", "-z"], input=page, capture_output=True, check=True)
                self.assertEqual(done.stderr.decode(), "", command)

    def test_build_writes_all_pages(self):
        listed = (harness.SOURCE / "src/cli/CMakeLists.txt").read_text().split("set(FUSEE_COMMANDS ")[1].split(")")[0].split()
        self.assertEqual(sorted(commands()), listed)

    def test_rejects_unknown_command(self):
        self.expect("manual biuld", 2, err="did you mean 'fusee build'")


class Bytes(harness.Scratch):
    """Completions and manual pages are installed, so their bytes must not depend on the compiler."""

    pinned = harness.SOURCE / "tests/cli/shared_words.sha256"

    def test_match_pins(self):
        made = {f"completion.{shell}": ["completion", shell] for shell in ["bash", "zsh", "fish"]}
        made |= {"-".join(["fusee", *words]) + ".1": ["manual", *words] for words in [[], *([one] for one in commands())]}
        now = "".join(f"{hashlib.sha256(self.fusee(line).stdout).hexdigest()}  {name}\n" for name, line in sorted(made.items()))
        self.assertEqual(self.pinned.read_text(), now, f"where the change is meant, this is the new {self.pinned.name}:\n{now}")


class Alone(harness.Scratch):
    def test_suggests_next_command(self):
        self.expect("", 0, "fusee build arm.toml.* makes the pulley", "^$")
        (self.folder / "arm.toml").unlink()
        (self.folder / "other.toml").write_text("[project]\n")
        self.expect("", 0, "Begin with .fusee new forearm > arm.toml", "^$")


if __name__ == "__main__":
    harness.main()

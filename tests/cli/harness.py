"""Runs the program like a user, in a scratch folder. Called as: SCRIPT PROGRAM SOURCE_FOLDER."""

import hashlib
import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROGRAM, SOURCE = (Path(argument).resolve() for argument in sys.argv[1:3])
ENVIRONMENT = {**{k: v for k, v in os.environ.items() if k != "NO_COLOR"}, "PATH": f"{PROGRAM.parent}:{os.environ['PATH']}", "LC_ALL": "C"}


def fusee(arguments, folder, **options):
    """The finished process of `fusee ARGUMENTS` (a string as in a shell, or a list)."""
    words = shlex.split(arguments) if isinstance(arguments, str) else arguments
    options = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "env": ENVIRONMENT, "timeout": 120, **options}
    return subprocess.run([PROGRAM, *words], cwd=folder, **options)


class Content(bytes):
    """Content of a file. Failures show its hash, because unittest's difference of two meshes takes hours."""

    def __repr__(self):
        return f"<{len(self)} bytes, {hashlib.sha256(self).hexdigest()[:12]}>"


class Scratch(unittest.TestCase):
    """Each test has its own folder with arm.toml, a small feasible mechanism."""

    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="fusee-cli-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        shutil.copy(SOURCE / "tests/cli/arm.toml", self.folder)

    def fusee(self, arguments, **options):
        return fusee(arguments, self.folder, **options)

    def expect(self, arguments, code, out="", err=""):
        """The finished process. Its exit code and patterns on stdout and stderr are checked."""
        done = self.fusee(arguments)
        shown = f"fusee {arguments}\n{done.stdout.decode(errors='replace')}\n{done.stderr.decode(errors='replace')}"
        self.assertEqual(done.returncode, code, shown)
        self.assertRegex(done.stdout.decode(), re.compile(out, re.S), shown)
        self.assertRegex(done.stderr.decode(), re.compile(err, re.S), shown)
        return done

    def expect_json(self, arguments, code):
        """The document of `fusee ARGUMENTS --json`."""
        words = shlex.split(arguments) if isinstance(arguments, str) else arguments
        at = words.index("--") if "--" in words else len(words)
        done = self.fusee([*words[:at], "--json", *words[at:]])
        document = json.loads(done.stdout)
        self.assertEqual(done.returncode, code, done.stdout)
        self.assertEqual((document["schema"], document["exit"], document["ok"]), (1, code, code == 0), arguments)
        for error in document["errors"]:
            self.assertEqual(set(error), {"file", "line", "column", "message", "hint"})
        if code != 0:
            self.assertTrue(document["errors"], arguments)
        return document

    def build(self, folder="out/arm", arguments=""):
        """The finished process of a build, and the content of its files."""
        self.expect(f"build arm.toml -o {folder} {arguments}", 0)
        return self.files(folder)

    def files(self, folder):
        """Content by name, including subfolders such as "next/bench.html"."""
        top = self.folder / folder
        return {path.relative_to(top).as_posix(): Content(path.read_bytes()) for path in sorted(top.rglob("*")) if path.is_file()}


def main():
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])

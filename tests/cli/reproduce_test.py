"""fusee reproduce: docs/background/paper.md is current, figures and numbers are complete, a second run gives the same bytes."""

import csv
import json
import math
import unittest
import xml.etree.ElementTree

import harness


class Reproduce(harness.Scratch):
    def test_page_is_current_and_figures_complete(self):
        done = self.fusee("reproduce --json -o paper")
        self.assertEqual(done.returncode, 0, done.stderr.decode())
        answer = json.loads(done.stdout)
        folder = self.folder / "paper"
        self.assertEqual((folder / "paper.md").read_text(), (harness.SOURCE / "docs/background/paper.md").read_text(),
                         "docs/background/paper.md lags behind: copy what 'fusee reproduce -o DIR' writes")
        self.assertEqual(sorted(answer["outputs"]), sorted(path.name for path in folder.iterdir()))
        for number in [4, 5, 7, 8, 9, 10, 11, 13]:
            name = folder / f"fig_{number:02d}"
            xml.etree.ElementTree.parse(name.with_suffix(".svg"))
            rows = list(csv.reader(name.with_suffix(".csv").read_text().splitlines()))
            self.assertGreater(len(rows), 50)
            for row in rows[1:]:
                self.assertEqual(len(row), len(rows[0]))
                self.assertTrue(all(math.isfinite(float(cell)) for cell in row))
        first = {path.name: path.read_bytes() for path in folder.iterdir()}
        self.assertEqual(self.fusee("reproduce -q -o paper").returncode, 0)  # its own files may be replaced
        self.assertEqual(first, {path.name: path.read_bytes() for path in folder.iterdir()})
        (folder / "paper.md").write_text("mine now")
        self.assertEqual(self.fusee("reproduce -o paper").returncode, 6)
        self.assertEqual((folder / "paper.md").read_text(), "mine now")


if __name__ == "__main__":
    harness.main()

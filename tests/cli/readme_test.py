"""Each command of README.md and docs/ runs as printed, in order, in a copy of profiles/ and docs/, and prints the shown output. Generated pages
and pictures are up to date.

.ci/run runs the two commands that install packages and compile in a fresh clone; here the program under test takes their place.
"""

import re
import sys
import unittest

import harness

sys.path.insert(0, str(harness.SOURCE / "docs"))
sys.dont_write_bytecode = True
import update  # noqa: E402

RENEW = "renew it: docs/update.py build/release/fusee"


class Readme(unittest.TestCase):
    def test_starts_with_the_setup_commands(self):
        blocks = re.findall(r"^```sh\n(.*?)^```", (harness.SOURCE / "README.md").read_text(), re.M | re.S)
        first, second = "".join(blocks).splitlines()[:2]
        self.assertRegex(first, r"^\.ci/setup && .*build/release/fusee build profiles/paper_optimum\.toml$")
        self.assertRegex(second, r"^\.ci/setup tests && ")


class Pages(unittest.TestCase):
    def test_commands_print_shown_output(self):
        self.assertGreater(len(update.PAGES), 20)
        for page in update.PAGES:
            with self.subTest(page), update.Bench(harness.PROGRAM) as bench:
                failed = []
                self.assertEqual((harness.SOURCE / page).read_text(), update.rewritten(page, bench, failed), RENEW)
                self.assertEqual(failed, [])

    def test_generated_pages_are_current(self):
        made = update.run_pages(harness.PROGRAM)
        for path, text in made.items():
            with self.subTest(path):
                self.assertEqual((harness.SOURCE / path).read_text(), text, RENEW)
        pictures = {f"docs/pictures/{path.name}" for path in (harness.SOURCE / "docs/pictures").glob("*.svg")}
        self.assertEqual(pictures, {path for path in made if path.endswith(".svg")})

    def test_slack_matches_picture(self):
        words = re.search(r"leave ([\d.]+ mm) of slack", (harness.SOURCE / "docs/pictures/slack.svg").read_text())[1]
        self.assertIn(words, (harness.SOURCE / "README.md").read_text()[:400])


class Shortened(unittest.TestCase):
    PRINTED = ["one", "two", "three", "four"]

    def test_compares_whole_output_without_ellipsis(self):
        self.assertEqual(update.shortened(self.PRINTED, ["one"]), self.PRINTED)

    def test_ellipsis_keeps_number_of_lines(self):
        self.assertEqual(update.shortened(self.PRINTED, ["1", "…", "4"]), ["one", "…", "four"])
        self.assertEqual(update.shortened(self.PRINTED, ["1", "…"]), ["one", "…"])

    def test_ellipsis_for_nothing_is_dropped(self):
        self.assertEqual(update.shortened(["one"], ["1", "…", "4"]), ["one"])


if __name__ == "__main__":
    harness.main()

"""Consistency of pages: valid links, a short README, up-to-date generated pages."""

import json
import re
import subprocess
import sys
import unittest

import harness

sys.path.insert(0, str(harness.SOURCE / "docs"))
sys.dont_write_bytecode = True
import update  # noqa: E402

FOLDERS = ["docs", "profiles", "src", "export", "include", "tests", ".github", ".ci"]


def files(*endings):
    found = [path for folder in FOLDERS for path in (harness.SOURCE / folder).rglob("*") if path.suffix in endings]
    return [*found, *(path for path in harness.SOURCE.glob("*") if path.suffix in endings)]


def without_code(text):
    return re.sub(r"`[^`\n]*`", "", re.sub(r"^```.*?^```", "", text, flags=re.M | re.S))


def anchors(path):
    """The anchors of a page's headings, in GitHub's form."""
    titles = re.findall(r"^#+ (.*)$", re.sub(r"^```.*?^```", "", path.read_text(), flags=re.M | re.S), re.M)
    return {re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-") for title in titles}


def links(path):
    """Each relative link of a page, with its file and anchor."""
    for target in re.findall(r"\]\(\s*([^)\s]+)\s*\)", without_code(path.read_text())):
        if "://" not in target:
            file, _, place = target.partition("#")
            yield target, (path.parent / file).resolve() if file else path, place


class Examples(unittest.TestCase):
    def test_find_their_files(self):
        for page in files(".md"):
            with self.subTest(str(page.relative_to(harness.SOURCE))):
                self.assertNotIn("No such file", page.read_text())


class Links(unittest.TestCase):
    def test_have_valid_targets(self):
        pages = files(".md")
        self.assertGreater(len(pages), 30)
        for page in pages:
            for target, file, place in links(page):
                with self.subTest(f"{page.relative_to(harness.SOURCE)}: {target}"):
                    self.assertTrue(file.exists(), "no such file")
                    self.assertTrue(not place or place in anchors(file), "no such heading")

    def test_reach_every_page_of_docs(self):
        reached, ahead = set(), [harness.SOURCE / "docs/README.md"]
        while ahead:
            page = ahead.pop()
            if page not in reached and page.suffix == ".md":
                reached.add(page)
                ahead += [file for _, file, _ in links(page)]
        self.assertEqual({str(path) for path in (harness.SOURCE / "docs").rglob("*.md")} - {str(page) for page in reached}, set())

    def test_show_every_picture(self):
        text = "".join(path.read_text() for path in files(".md"))
        for picture in [*(harness.SOURCE / "docs/pictures").glob("*.svg"), *(harness.SOURCE / "profiles/pictures").glob("*.png")]:
            self.assertIn(f"pictures/{picture.name})", text)


class References(unittest.TestCase):
    """Comments and pages cite only documents of the repository."""

    def test_cite_existing_documents(self):
        names = {path.name for path in files(".md")} | {"FILE.md"}
        for path in files(".md", ".h", ".cpp", ".py", ".js", ".cmake", ".txt", ".toml"):
            place = str(path.relative_to(harness.SOURCE))
            if place == "tests/cli/docs_test.py":
                continue
            text = path.read_text(errors="replace")
            with self.subTest(place):
                self.assertEqual(set(re.findall(r"[\w-]+\.md\b", text)) - names, set())
                self.assertEqual(re.findall(r"[A-Z]{4,} §\d", text), [])


class Readme(unittest.TestCase):
    LINES = (harness.SOURCE / "README.md").read_text().splitlines()

    def test_has_at_most_150_lines(self):
        self.assertLessEqual(len(self.LINES), 150)

    def test_shows_the_second_command_within_two_screens(self):
        self.assertLess(self.LINES.index(next(line for line in self.LINES if line.startswith(".ci/setup tests"))), 60)

    def test_has_no_paragraph_above_five_lines(self):
        for paragraph in without_code("\n".join(self.LINES)).split("\n\n"):
            lines = [line for line in paragraph.splitlines() if line and not line.startswith(("|", "- ", "  "))]
            self.assertLessEqual(len(lines), 5, paragraph)


class Pages(unittest.TestCase):
    def test_generated_pages_are_current(self):
        for path, text in update.quick_pages(harness.PROGRAM).items():
            with self.subTest(path):
                self.assertEqual((harness.SOURCE / path).read_text(), text, "renew it: docs/update.py build/release/fusee")

    def test_show_the_consumer_program(self):
        program = (harness.SOURCE / "tests/consumer/project/consumer.cpp").read_text()
        self.assertLessEqual(len([line for line in program.splitlines() if line]), 10)
        self.assertIn(f"```cpp\n{program}```\n", (harness.SOURCE / "docs/reference/library.md").read_text())

    def test_name_every_output_file(self):
        listed = "".join(re.findall(r"^\| (.*?) \|", (harness.SOURCE / "docs/reference/outputs.md").read_text(), re.M))
        built = subprocess.run([harness.PROGRAM, "build", harness.SOURCE / "profiles/forearm.toml", "--dry-run", "--json"],
                               capture_output=True, check=True).stdout
        for output in json.loads(built)["outputs"]:
            self.assertIn(f"`{output['file']}`", listed)


if __name__ == "__main__":
    harness.main()

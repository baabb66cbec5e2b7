"""Refuses words that make comments, test titles and pages hard to read. words_test.py SOURCE_FOLDER [PATH...] prints every place."""

import re
import subprocess
import sys
import unittest
from pathlib import Path

# Modules whose words are not revised yet.
PENDING = ()
# Pages that the program writes.
GENERATED = ("docs/reference/commands.md", "docs/reference/keys.md", "docs/reference/catalogue.md", "docs/reference/columns.md",
             "docs/reference/json.md", "docs/background/paper.md")
# This file quotes what it refuses; a corpus and pictures have no comments of ours.
EXEMPT = ("tests/pipeline/words_test.py", "tests/fuzz/corpus/", "docs/pictures/", "profiles/pictures/", "src/base/musl/")

MOST_WORDS_IN_SENTENCE = 25
MOST_WORDS_IN_TITLE = 8
MOST_COLUMNS = 120
#: Lines of pages that may be longer: rows of tables, pictures, and commands with their messages.
LONG_LINE = re.compile(r"\||!\[|fusee |.*(error|warning|note|hint): |PYTHONPATH")

FIRST = re.compile(r"(What|Of|The same|Where|Whether)\b|…|\.\.\.")
#: Expression → what to write instead.
REPLACED = {
    r"nameless|without a name|ha(?:s|ve) no name": "unmodelled",
    r"what is left|what stays": "residual, remainder",
    r"gives? way": "compliance, is compliant",
    r"foretold|foretell(?:s|ing)?": "predicted",
    r"culprits?|blame[ds]?|falsely blamed": "attributed cause, false positive",
    r"how sure|surer": "uncertainty",
    r"may as well be": "equally likely",
    r"tells? \w+ from|tells? apart": "distinguishes, resolved",
    r"would be possible with": "try KEY = VALUE or less (now VALUE)",
    r"it takes \d": "at least … is required",
    r"as it lies|as they lie": "print orientation, present position",
    r"makings": "full builds",
    r"test model": "test rig",
    r"nobody|somebody": "name the person or the thing",
    r"mouths?|gables?|keels?|roofs?": "channel entry, overhang support cone",
    r"slips? of (?:a|the) (?:file|log|data)": "likely input error",
    r"needed law": "compensating law",
    r"ways? of printing": "print orientation",
    r"undersides?": "downward face",
    r"withheld": "held-out",
    r"rareness": "log prior odds, penalty",
    r"declared law": "target motion",
    r"islands": "unsupported regions",
    r"plainly": "without discrepancy",
    r"told": "reported, given",
    r"doubts?|doubtful|doubted": "absence probability, plausibility warning, uncertain",
}
#: Identifiers and file names that were replaced → what they are now. Keys of JSON documents keep their names: in quotes.
RENAMED = {
    r"as_it_is|AsItIs": "identified_joint",
    r"tied_at(?!_deg)|tied_words": "assembly_angle",
    r"fusee_room|FUSEE_ROOMS|ROOMS|cmake_rooms|rooms_test": "module",
    r"doubts_test": "plausibility_warnings",
    r"UndoneSlips|slips_words": "input errors",
    r"\w*[Bb]lamed?(?!_)\w*|[a-z_]+_blamed?": "false_positives, attributed cause",
    r"DeclaredLaw|declared_law|needed_law": "TargetMotion, compensating law",
    r"Climb\w+|climb(?:s|ing)?_\w+": "helical",
    r"\w*Foretell\w*": "predicts",
}
# Options keep their names: --most-blamed.
WORDS = {re.compile(rf"(?<!-)\b(?:{expression})\b", re.I): instead for expression, instead in REPLACED.items()}
NAMES = {re.compile(rf"(?<![\"\w-])(?:{expression})(?![\"\w])"): instead for expression, instead in RENAMED.items()}
ANY_NAME = re.compile("|".join(rf"(?<![\"\w-])(?:{expression})(?![\"\w])" for expression in RENAMED))
ANY_WORD = re.compile("|".join(rf"(?<!-)\b(?:{expression})\b" for expression in REPLACED), re.I)

#: Their digits depend on the machine.
ELEMENTARY = re.compile(r"std::(a?(?:sin|cos|tan)h?|atan2|exp|log|log1p|log10|pow|hypot)\b")
#: The standard leaves their numbers to each library.
DISTRIBUTION = re.compile(r"std::(\w+_distribution|shuffle|sample|generate_canonical|default_random_engine)\b")
COMPUTING = ("src/", "export/", "include/")

CPP_COMMENT = re.compile(r"\s*//[/!]?(?!<)\s?(.*)")
CPP_TEXT = re.compile(r'//.*|"(?:[^"\\]|\\.)*"')
SCRIPT_COMMENT = re.compile(r"\s*#(?!!)\s?(.*)")
CPP_TITLE = re.compile(r"TEST(?:_F|_P)?\((\w+), (\w+)\)")
PY_TITLE = re.compile(r"\s*def test_(\w+)\(")
DOCSTRING = re.compile(r'\s*[rf]?"""(.*)')


def words_in(text):
    """(rule, instead) of each refused expression in a text."""
    if not ANY_WORD.search(text):
        return
    for pattern, instead in WORDS.items():
        for match in pattern.finditer(text):
            yield f"'{match[0]}'", instead


def names_in(line):
    """(rule, instead) of each replaced name in a line of code, or in a path."""
    if not ANY_NAME.search(line):
        return
    for pattern, instead in NAMES.items():
        for match in pattern.finditer(line):
            yield f"'{match[0]}'", instead


def first_word_of(text):
    match = FIRST.match(text)
    if match:
        yield f"begins with '{match[0]}'", "a complete sentence with the subject first"


def title_faults(title, words):
    if "_" in title and title[0].islower() and not title.startswith("test_"):
        yield f"title {title} is in snake_case", "CamelCase"
    if words[0] in ("What", "Where", "Whether", "Of", "That", "what", "where", "whether", "of", "that"):
        yield f"title {title} begins with '{words[0]}'", "what fails when the test fails, subject or verb first"
    if len(words) > MOST_WORDS_IN_TITLE:
        yield f"title {title} has {len(words)} words", f"at most {MOST_WORDS_IN_TITLE}"


def cpp_faults(lines):
    was_comment = False
    for number, line in enumerate(lines, 1):
        comment = CPP_COMMENT.match(line) if "//" in line else None
        if comment and not was_comment:
            yield from ((number, *fault) for fault in first_word_of(comment[1]))
        was_comment = comment is not None
        if comment:
            yield from ((number, *fault) for fault in words_in(comment[1]))
        elif ANY_WORD.search(line):
            yield from ((number, *fault) for text in CPP_TEXT.findall(line) for fault in words_in(text))
        yield from ((number, *fault) for fault in names_in(line))
        title = CPP_TITLE.match(line)
        if title:
            words = re.findall(r"[A-Z][a-z0-9]*|[A-Z]+(?![a-z])", title[2])
            yield from ((number, *fault) for fault in title_faults(title[2], words or [title[2]]))


def header_faults(lines):
    if lines and not lines[0].startswith("/// \\file"):
        yield 1, "begins without '/// \\file'", "'/// \\file' and what the header is for"
    elif len(lines) > 1 and not lines[1].startswith("///"):
        yield 2, "'/// \\file' says nothing", "what the header is for"
    yield from cpp_faults(lines)


def script_faults(lines):
    was_comment = False
    for number, line in enumerate(lines, 1):
        comment = SCRIPT_COMMENT.match(line)
        if comment and not was_comment:
            yield from ((number, *fault) for fault in first_word_of(comment[1].lstrip(": ")))
        was_comment = comment is not None
        docstring = DOCSTRING.match(line)
        if docstring:
            yield from ((number, *fault) for fault in first_word_of(docstring[1]))
        if ANY_WORD.search(line):
            yield from ((number, *fault) for fault in words_in(line))
        yield from ((number, *fault) for fault in names_in(line))
        title = PY_TITLE.match(line)
        if title:
            yield from ((number, *fault) for fault in title_faults("test_" + title[1], title[1].split("_")))


def page_faults(lines):
    """Rules of Markdown: line length, words, and sentences of paragraphs, items and cells."""
    sentence, start, is_code = "", 1, False

    def ended():
        words = len(sentence.split())
        if words > MOST_WORDS_IN_SENTENCE:
            yield start, f"sentence of {words} words: {sentence.strip()[:60]} …", f"at most {MOST_WORDS_IN_SENTENCE}; split it"

    for number, line in enumerate(lines, 1):
        if len(line) > MOST_COLUMNS and not LONG_LINE.match(line):
            yield number, f"line of {len(line)} columns", f"at most {MOST_COLUMNS}"
        if line.startswith("```"):
            is_code = not is_code
        if is_code or line.startswith(("```", "<!--", "![")):
            yield from ended()
            sentence, start = "", number + 1
            continue
        text = re.sub(r"\]\([^)]*\)", "]", re.sub(r"`[^`]*`", "x", line))
        yield from ((number, *fault) for fault in words_in(text))
        if not text.strip() or re.match(r"\s*(\||#|-|\*|\d+\.|>)", text):
            yield from ended()
            sentence, start = "", number
        for part in re.split(r"((?<=[.!?:;])\s|\|)", text + " "):
            if part.strip() and part != "|":
                if not sentence.strip():
                    start = number
                sentence += " " + part
            elif part:
                yield from ended()
                sentence = ""
        if re.search(r"[.!?:;]$", text):
            yield from ended()
            sentence = ""
    yield from ended()


KINDS = {".cpp": cpp_faults, ".h": header_faults, ".py": script_faults, ".pyi": script_faults, ".txt": script_faults, ".cmake": script_faults,
         "": script_faults, ".md": page_faults}


def elementary_faults(lines):
    for number, line in enumerate(lines, 1):
        for match in ELEMENTARY.finditer(line):
            yield number, f"'{match[0]}' differs between machines", f"elementary::{match[1]}"
        if "std::stod(" in line:
            yield number, "'std::stod' reads the decimal point of the locale", "number_of"
        for match in DISTRIBUTION.finditer(line.partition("//")[0]):
            yield number, f"'{match[0]}' differs between standard libraries", "NormalNumbers, or a share of the generator's bits"


def tracked(root, under):
    """The files that git tracks; None without git or outside of a repository."""
    try:
        listed = subprocess.run(["git", "-C", root, "ls-files", *under], capture_output=True, text=True)
    except FileNotFoundError:
        return None
    return listed.stdout.splitlines() if listed.returncode == 0 else None


def files(root, under=()):
    names = tracked(root, under)
    if names is None:  # an archive
        names = [str(path.relative_to(root)) for top in root.iterdir() if top.name != "build" for path in (top.rglob("*") if top.is_dir() else [top]) if path.is_file()]
    for name in names:
        path = Path(name)
        if name.startswith((*PENDING, *EXEMPT)) or name in GENERATED or path.suffix not in KINDS:
            continue
        if path.suffix == ".txt" and path.name != "CMakeLists.txt" or path.suffix == "" and path.parent.name != ".ci":
            continue
        yield name


def faults(root, under=()):
    """A line for each refused place: file, line, rule, and what to write instead."""
    found = []
    for name in files(root, under):
        lines = (root / name).read_text(errors="replace").splitlines()
        found += [f"{name}: {rule}; write: {instead}" for rule, instead in names_in(name.replace("/", " ").replace(".", " "))]
        found += [f"{name}:{number}: {rule}; write: {instead}" for number, rule, instead in KINDS[Path(name).suffix](lines)]
        if name.startswith(COMPUTING):
            found += [f"{name}:{number}: {rule}; write: {instead}" for number, rule, instead in elementary_faults(lines)]
    return found


class Words(unittest.TestCase):
    ROOT = Path(__file__).resolve().parents[2]

    def test_sources_and_pages_follow_the_rules(self):
        found = faults(self.ROOT)
        self.assertEqual(found, [], f"{len(found)} places:\n" + "\n".join(found[:100]))

    def refused(self, kind, text):
        return [(number, rule) for number, rule, _ in KINDS[kind](text.splitlines())]

    def test_detects_comments(self):
        self.assertEqual(self.refused(".h", "/// \\file A.\n/// What is left of it.\nint b;\n"), [(2, "'What is left'")])
        self.assertEqual(self.refused(".h", "#pragma once\n// What is left of it.\n"), [(1, "begins without '/// \\file'"), (2, "begins with 'What'"), (2, "'What is left'")])
        self.assertEqual(self.refused(".cpp", "// A fact.\n// Of two lines.\nf();  // it gives way\n"), [(3, "'gives way'")])
        self.assertEqual(self.refused(".cpp", 'throw Error("nobody knows");  // fine\n'), [(1, "'nobody'")])
        self.assertEqual(self.refused(".py", "# Where it is\n"), [(1, "begins with 'Where'")])
        self.assertEqual(self.refused(".py", 'def f():\n    """Whether it is."""\n'), [(2, "begins with 'Whether'")])

    def test_detects_renamed(self):
        self.assertEqual(self.refused(".cpp", "auto a = joint::as_it_is(b);\n"), [(1, "'as_it_is'")])
        self.assertEqual(self.refused(".cpp", 'json["joint"] = "as_it_is";  // a key keeps its name\n'), [])
        self.assertEqual(self.refused(".txt", "fusee_room(base ROOMS a)\n"), [(1, "'fusee_room'"), (1, "'ROOMS'")])
        self.assertEqual([rule for rule, _ in names_in("tests pipeline doubts_test cpp")], ["'doubts_test'"])

    def test_detects_functions_of_the_machine(self):
        self.assertEqual([number for number, _, _ in elementary_faults(["elementary::sin(x);", "y = std::atan2(a, b) + std::sqrt(c);"])], [2])
        self.assertEqual([number for number, _, _ in elementary_faults(["number_of(text);", "std::atanh(x);", "std::stod(text);"])], [2, 3])
        self.assertEqual([number for number, _, _ in elementary_faults(["std::mt19937_64 bits(1);", "std::normal_distribution<double> normal;", "std::shuffle(a, b, bits);  // std::sample"])], [2, 3])

    def test_detects_titles(self):
        self.assertEqual(len(self.refused(".cpp", "TEST(Part, WhatIsMade) {\n")), 1)
        self.assertEqual(len(self.refused(".cpp", "TEST(Part, IsMadeOfOneTwoThreeFourFiveSixSeven) {\n")), 1)
        self.assertEqual(len(self.refused(".cpp", "TEST(Part, passes_checks) {\n")), 1)
        self.assertEqual(self.refused(".cpp", "TEST(Part, PassesChecks) {\n"), [])
        self.assertEqual(len(self.refused(".py", "    def test_what_is_made(self):\n")), 1)

    def test_detects_long_sentences(self):
        self.assertEqual([number for number, _ in self.refused(".md", "Short.\n\n" + "word " * 15 + "\n" + "word " * 16 + "\n")], [3])
        self.assertEqual([number for number, _ in self.refused(".md", "| x | " + "word " * 26 + "|\n")], [1])
        self.assertEqual(self.refused(".md", "```\n" + "word " * 16 + "\n" + "word " * 15 + "\n```\n- " + "word " * 20 + ".\n- " + "word " * 20 + ".\n"), [])
        self.assertEqual(len(self.refused(".md", "x" * 121 + "\n")), 1)
        self.assertEqual(len(self.refused(".md", "```\n" + "x" * 121 + "\n```\n")), 1)


if __name__ == "__main__":
    if len(sys.argv) > 1:
        print("\n".join(faults(Path(sys.argv[1]).resolve(), sys.argv[2:])))
    else:
        unittest.main()

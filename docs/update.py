#!/usr/bin/env python3
"""Rewrites what README.md and docs/ show of the program: outputs of commands, pages of reference, pictures.

    docs/update.py build/release/fusee

A test compares the same texts with what stands in the repository. In a page

- a ```sh block holds commands that have to succeed, one a line;
- a ```console block holds commands after "$ ", each with all that it prints. One line "…" may stand for lines left out:
  as many are kept before and after it as there were.

All blocks of a page run in order, in one copy of profiles/ and docs/ of its own, with `fusee` on the PATH and at build/release/fusee.
"""

import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import textwrap
import tomllib
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(SOURCE / "docs/pictures"))
sys.dont_write_bytecode = True
import draw  # noqa: E402

# Pages whose commands are run. Those of python.md need Python's module: tests/python/pages_test.py runs them.
PAGES = ["README.md", *sorted(str(path.relative_to(SOURCE)) for path in (SOURCE / "docs").rglob("*.md") if path.name != "python.md")]
LEFT_OUT = "…"

# Pages that are run ---------------------------------------------------------------------------------------------------


def commands_of(kind, lines):
    """Commands of a block, each with the lines that are shown below it."""
    if kind == "sh":
        joined = "\n".join(lines).replace("\\\n", " ").splitlines()
        return [(line, []) for line in joined if line and not line.startswith("#")]
    commands = []
    for line in lines:
        if line.startswith("$ "):
            commands.append((line[2:], []))
        else:
            commands[-1][1].append(line)
    return commands


def shortened(printed, shown):
    """The printed text, without the lines that "…" replaces in the shown text."""
    if LEFT_OUT not in shown:
        return printed
    before = shown.index(LEFT_OUT)
    after = len(shown) - before - 1
    if len(printed) < before + after:
        return printed
    return [*printed[:before], LEFT_OUT, *printed[len(printed) - after:]]


class Bench:
    """A folder in which a page's commands run."""

    def __init__(self, program):
        self.folder = Path(tempfile.mkdtemp(prefix="fusee-docs-"))
        (self.folder / "build/release").mkdir(parents=True)
        (self.folder / "build/release/fusee").symlink_to(Path(program).resolve())
        for name in ("profiles", "docs"):
            shutil.copytree(SOURCE / name, self.folder / name)
        self.environment = {**{key: value for key, value in os.environ.items() if key != "NO_COLOR"}, "LC_ALL": "C.UTF-8",
                            "PATH": f"{self.folder}/build/release:{os.environ['PATH']}"}

    def __enter__(self):
        return self

    def __exit__(self, *_):
        shutil.rmtree(self.folder, ignore_errors=True)

    def run(self, command):
        """Exit code and lines of stdout and stderr together."""
        done = subprocess.run(["bash", "-c", command], cwd=self.folder, env=self.environment, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, timeout=240)
        return done.returncode, done.stdout.decode().splitlines()


def runnable(command):
    """The command without steps that install or compile. None if nothing remains, or if it needs data outside the repository."""
    if "$FUSEE_DAVINCI_JAW" in command and "FUSEE_DAVINCI_JAW" not in os.environ:
        return None
    if ".ci/setup" in command or "cmake" in command:
        command = command.split("&&")[-1].strip()
        return command if "fusee " in command else None
    return command


def rewritten(page, bench, failed):
    """The page with the present outputs of its commands. Failed commands of sh blocks are appended to `failed`, with their output."""
    def block(match):
        kind, shown_again = match[1], []
        for command, shown in commands_of(kind, match[2].splitlines()):
            run = runnable(command)
            code, printed = bench.run(run) if run else (0, [])
            if kind == "sh" and code != 0:
                failed.append(command + "\n" + "\n".join(printed))
            shown_again += [f"$ {command}", *shortened(printed, shown)]
        return match[0] if kind == "sh" else "```console\n" + "".join(line + "\n" for line in shown_again) + "```"
    return re.sub(r"^```(sh|console)\n(.*?)^```", block, (SOURCE / page).read_text(), flags=re.M | re.S)


# Pages of reference ---------------------------------------------------------------------------------------------------

WRITTEN = "<!-- Written by docs/update.py from what the program prints; a test compares. -->\n"


def wrapped(text):
    return textwrap.fill(text, 118, break_long_words=False, break_on_hyphens=False) + "\n"


def output(program, *arguments, folder=None):
    return subprocess.run([program, *arguments], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, cwd=folder,
                          env={**os.environ, "LC_ALL": "C.UTF-8"}).stdout.decode()


def section(text, title):
    """Lines below "title:" of a help text, up to the next empty line."""
    return text.split(f"\n{title}\n", 1)[1].split("\n\n")[0]


def commands_page(program):
    overview = output(program, "help")
    names = [line.split()[0] for line in section(overview, "commands:").splitlines()]
    text = f"# Commands\n\n{WRITTEN}\n"
    text += "`fusee help COMMAND` prints the same. `cmake --install build/release` also installs manual pages (`man fusee-build`).\n\n"
    text += wrapped(" · ".join(f"[{name}](#fusee-{name})" for name in names))
    for name in names:
        parts = re.split(r"\n(?=[a-z][a-z, ]*:\n)", output(program, "help", name).rstrip("\n"))
        kept = [part for part in parts if not part.startswith("options of every command:")]
        text += f"\n## fusee {name}\n\n```text\n" + "\n".join(part.rstrip("\n") + "\n" for part in kept) + "```\n"
    text += "\n## Options of every command\n\n```text\n" + section(overview, "options, before or after the command:") + "\n```\n"
    text += "\n## Exit codes\n\n| code | meaning |\n|---|---|\n"
    for line in section(overview, "exit codes:").splitlines():
        code, meaning = line.split(None, 1)
        text += f"| {code} | {meaning} |\n"
    return text + "\n[Scripts](scripts.md) has more on exit codes and `--json`.\n"


def listed(program, fields):
    """Output of `fusee explain`: the meaning of each table, and the last parentheses of each key."""
    names = {(field["table"], field["key"]) for field in fields}
    tables, endings, table = {}, {}, ""
    for line in re.sub(r"\n {28,}", " ", output(program, "explain")).splitlines():
        words = line.split(None, 1)
        if line.startswith("["):
            table = words[0].strip("[]")
            tables[table] = words[1]
        elif words and (table, words[0]) in names:
            endings[table, words[0]] = last_parentheses(words[1])
        elif words and table:
            tables[table] += " " + line.strip()
    return tables, endings


def last_parentheses(text):
    depth = 0
    for i in range(len(text) - 1, -1, -1):
        depth += {")": 1, "(": -1}.get(text[i], 0)
        if depth == 0:
            return text[i + 1:-1]
    raise ValueError(text)


def number(value):
    return f"{value:.10g}"


def keys_page(program):
    fields = json.loads(output(program, "explain", "--json"))["explained"]["fields"]
    tables, endings = listed(program, fields)
    text = f"# Keys of the mechanism file\n\n{WRITTEN}\n"
    text += wrapped("`fusee explain KEY` prints one of them, with its entries of the [catalogue](catalogue.md). `fusee explain --schema` prints "
                    "a JSON schema for editors. [The mechanism file](mechanism-file.md) says what the keys do together.")
    text += "\n" + wrapped(" · ".join(f"[{name}](#{name})" for name in tables))
    table = None
    for field in fields:
        if field["table"] != table:
            table = field["table"]
            text += f"\n## {table}\n\n`[{table}]`: {tables[table]}\n" if table else "\n## At the top of the file\n"
            text += "\n| key | meaning | unit | allowed | default |\n|---|---|---|---|---|\n"
        allowed = " ".join(f"`{choice}`" for choice in field.get("choices", []))
        if not allowed and "least" in field:
            least, most = number(field["least"]), number(field["most"])
            allowed = least if least == most else f"{least} … {most}"
        symbol = f"{field['symbol']}: " if field["symbol"] else ""
        ending = re.sub(rf"^default (.*?)(?: {re.escape(field['unit'])})?(;|$)", r"`\1`\2", endings[table, field["key"]])
        text += f"| `{field['key']}` | {symbol}{field['meaning']} | {field['unit']} | {allowed} | {ending} |\n"
    return text


def catalogue_page(program):
    catalogue = {}
    for key in ("body.horn", "body.shaft", "tendon.diameter_mm", "material.name", "tendon.modulus_MPa"):
        catalogue.update(json.loads(output(program, "explain", key, "--json"))["explained"].get("catalogue", {}))
    titles = {"horns": "Horns and splines of servos: `body.horn`", "shafts": "Shafts of motors: `body.shaft`",
              "motors": "Motors: `motor.model`", "tendons": "Tendons", "materials": "Materials: `material.name`"}
    text = f"# Catalogue\n\n{WRITTEN}\n" + wrapped(
        "Parts and materials that the program knows by name, with their sources. Where a source says “measure yours”, no drawing was "
        "found: measure the part before you print. To add an entry, write its table into a file of `profiles/catalogue/` and compile again.")
    for kind, title in titles.items():
        text += f"\n## {title}\n\n| name | what | sizes | source |\n|---|---|---|---|\n"
        for entry in catalogue[kind]:
            sizes = ", ".join(f"{key} = {number(value)}" for key, value in entry.items() if isinstance(value, float) and value)
            text += f"| `{entry['name']}` | {entry['description']} | {sizes} | {entry['source']} |\n"
    return text


# A column that columns.toml does not describe fails.
COLUMNS = tomllib.loads((SOURCE / "docs/reference/columns.toml").read_text())
DIRECTIONS = {"rising_": ", α growing", "falling_": ", α falling"}
RUNS = [  # title, command that writes the file (None: written before), its path in the bench's folder, description
    ("profile.csv", "fusee build arm.toml", "out/arm/profile.csv", "Both pitch curves, one row per point"),
    ("profile_p1.csv", None, "out/arm/profile_p1.csv", "Points of P1 for a spline in CAD; `profile_p2.csv` has those of P2"),
    ("transmission.csv", None, "out/arm/transmission.csv", "The joint over the stroke, one row per motor angle"),
    ("transmission.csv, several turns", "fusee build profiles/wrist_turns.toml", "out/wrist_turns/transmission.csv",
     "The table of a helical pulley also has slopes"),
    ("analyze -o FILE.csv", "fusee analyze arm.toml -o a.csv", "a.csv", "Forces over the stroke: by the paper, and by the full model with α rising and falling"),
    ("run_1.csv", "fusee plan arm.toml", "out/arm_plan/run_1.csv", "An empty run of `fusee plan` and `fusee kit`, to fill in; a log for `fusee calibrate`"),
    ("simulate", "fusee simulate arm.toml out/arm_plan/run_1.csv -o s.csv", "s.csv", "Columns that `fusee simulate` adds to a log"),
    ("compensation.csv", "for i in 1 2 3 4 5; do fusee simulate profiles/forearm.toml profiles/measured/forearm_$i.csv "
     "--set identified.backlash_deg=1.5 --noise-deg 0.02 --seed $i -o m_$i.csv; done; "
     "fusee calibrate profiles/forearm.toml m_*.csv --no-audit -o c", "c/compensation.csv",
     "Where the motor has to stand for the joint to be at θ"),
]
DOCUMENTS = [  # command, what is run
    ("new", "fusee new --json"), ("explain", "fusee explain pulley.r1_mm --json"), ("build", "fusee build arm.toml --dry-run --json"),
    ("build, refused", "fusee build arm.toml --dry-run --json --set pulley.r1_mm=25"), ("check", "fusee check out/arm/pulley.stl --json"),
    ("rewind", "fusee rewind arm.toml out/arm/pulley.stl --json"), ("analyze", "fusee analyze arm.toml --json"),
    ("kit", "fusee kit arm.toml --dry-run --json"), ("model", "fusee model arm.toml --dry-run --json"),
    ("plan", "fusee plan arm.toml --dry-run --json"), ("simulate", "fusee simulate arm.toml out/arm_plan/run_1.csv --json"),
    ("optimize", "fusee optimize profiles/paper_optimum.toml --method certified --dry-run --json"),
    ("calibrate", "fusee calibrate profiles/forearm.toml profiles/measured/forearm_*.csv --no-audit --dry-run --json"),
    ("compare", "fusee compare profiles/forearm.toml --before m_[12].csv --after profiles/measured/forearm_[12].csv --json"),
]
COMMON = ("schema", "command", "ok", "exit", "errors", "warnings")


def json_type(value):
    if isinstance(value, dict):
        return "object with " + ", ".join(f"`{key}`" for key in value)
    if isinstance(value, list):
        return "list" + (f" of {json_type(value[0])}" if value else ", here empty")
    return {bool: "true or false", int: "number", float: "number", str: "text", type(None): "null"}[type(value)]


def meaning_of(column):
    for prefix, direction in DIRECTIONS.items():
        if column.startswith(prefix):
            return COLUMNS[column.removeprefix(prefix)] + direction
    return COLUMNS[column]


def columns_page(bench):
    bench.run("fusee new forearm > arm.toml")
    text = f"# Columns of tables\n\n{WRITTEN}\nA column's unit stands in its name. Separators are commas; a line that begins with `#` is a comment.\n"
    for title, command, path, about in RUNS:
        if command:
            bench.run(command)
        header = next(line for line in (bench.folder / path).read_text().splitlines() if not line.startswith("#"))
        text += f"\n## {title}\n\n{about}.\n\n| column | meaning |\n|---|---|\n"
        for column in header.split(","):
            text += f"| `{column}` | {meaning_of(column)} |\n"
    return text


def json_page(bench):
    """After columns_page(), whose files it reads."""
    text = f"# JSON documents\n\n{WRITTEN}\n`--json` puts one document on stdout and nothing else, even if a command fails. Every document has\n\n"
    text += "| key | value |\n|---|---|\n| `schema` | 1 |\n| `command` | the command |\n| `ok` | true where `exit` is 0 |\n| `exit` | the exit code |\n"
    text += "| `errors`, `warnings` | lists of objects with `file`, `line`, `column`, `message`, `hint` |\n\nAngles are in degrees, lengths in mm; the unit is part of the key.\n"
    for name, command in DOCUMENTS:
        document = json.loads("\n".join(bench.run(command + " 2>/dev/null")[1]))
        text += f"\n## {name}\n\n`{command}`\n\n| key | value |\n|---|---|\n"
        for key, value in document.items():
            if key not in COMMON:
                text += f"| `{key}` | {json_type(value)} |\n"
    return text


def quick_pages(program):
    """Pages of reference that need nothing but help texts."""
    return {"docs/reference/commands.md": commands_page(program), "docs/reference/keys.md": keys_page(program),
            "docs/reference/catalogue.md": catalogue_page(program)}


def run_pages(program):
    """Pages of reference for which commands are run, and pictures."""
    with Bench(program) as bench:
        pages = {"docs/reference/columns.md": columns_page(bench), "docs/reference/json.md": json_page(bench)}
    return {**pages, **{f"docs/pictures/{name}": text for name, text in draw.pictures(program).items()}}


def main():
    program = Path(sys.argv[1]).resolve()
    for path, text in {**quick_pages(program), **run_pages(program)}.items():
        (SOURCE / path).write_text(text)
    for page in PAGES:
        if "```console" in (SOURCE / page).read_text():
            with Bench(program) as bench:
                failed = []
                (SOURCE / page).write_text(rewritten(page, bench, failed))
                print("\n".join(f"{page}: {words}" for words in failed), end="", file=sys.stderr)


if __name__ == "__main__":
    main()

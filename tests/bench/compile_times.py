#!/usr/bin/env python3
"""Files with the longest compile times: compile_times.py [BUILD [HOW_MANY]], from ninja's log of the latest builds.

Measure a full build without other load and without a compiler cache: CCACHE_DISABLE=1 cmake --workflow --preset release
"""
import pathlib
import sys


def seconds_of(log: pathlib.Path) -> dict[str, float]:
    """Output → duration of its latest build, s; the log has milliseconds."""
    rows = (line.split("\t") for line in log.read_text().splitlines() if not line.startswith("#"))
    return {output: (int(end) - int(start)) / 1000 for start, end, _, output, _ in rows}


def main() -> None:
    build = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "build/release")
    shown = int(sys.argv[2]) if len(sys.argv) > 2 else 20
    made = seconds_of(build / ".ninja_log")
    units = {name: time for name, time in made.items() if name.endswith((".o", ".gch", ".pch")) and (build / name).exists()}
    for name, time in sorted(units.items(), key=lambda unit: -unit[1])[:shown]:
        print(f"{time:8.1f} s  {name.replace('CMakeFiles/', '')}")
    print(f"{sum(units.values()):8.1f} s  in all, {len(units)} units")


if __name__ == "__main__":
    main()

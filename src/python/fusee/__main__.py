"""python -m fusee: the command line, by the program in the wheel or the one on the path."""

import os
import shutil
import sys
from pathlib import Path


def program() -> str:
    """The program; exits with status 1 when there is none."""
    own = Path(__file__).parent / "bin" / "fusee"
    found = str(own) if own.exists() else shutil.which("fusee")
    if found is None:
        sys.exit("python -m fusee: error: the program fusee is neither in this package nor on the path; install it, or a portable wheel")
    return found


def main() -> None:
    path = program()
    os.execv(path, [path, *sys.argv[1:]])


if __name__ == "__main__":
    main()

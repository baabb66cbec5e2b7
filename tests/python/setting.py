"""Finds the package under test next to the program. Called as: SCRIPT PROGRAM SOURCE_FOLDER."""

import os
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "cli"))
import harness  # noqa: E402

PACKAGE = harness.PROGRAM.parent / "python"
sys.path.insert(0, str(PACKAGE))
ENVIRONMENT = {**harness.ENVIRONMENT, "PYTHONPATH": str(PACKAGE), "PYTHONDONTWRITEBYTECODE": "1"}
os.environ["PYTHONDONTWRITEBYTECODE"] = "1"
sys.dont_write_bytecode = True

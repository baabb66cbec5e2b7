#!/usr/bin/env python3
"""Draws the pictures of profiles/README.md and docs: each profile's part as its report shows it, the report's page, and the test rig.

    profiles/pictures/draw.py build/release/fusee [folder, this one without it]

Needs Chromium. It does not draw as_printed.png, which shows parts as a slicer arranges them.
"""

import pathlib
import shutil
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent

# The 3-D view and nothing else, over the whole window.
ALONE = """<style>.stage{position:fixed;inset:0;z-index:9;height:100vh!important;border:0;border-radius:0}
.stage .buttons,.stage .hint{display:none!important}</style>"""
# The part and the joint that moves it, away from home.
MOVED = """<style>header,.verdict,main section:not(#part,#moving){display:none!important}.stage{height:330px!important;min-height:0!important}</style>
<script>//<![CDATA[
const alpha = document.querySelector("#alpha");
alpha.value = 0.6 * alpha.max;
alpha.dispatchEvent(new Event("input"));
//]]></script>"""

# The last step of the kit's page: the whole test rig.
ASSEMBLED = """<style>header,.warnings,main section:not(#assembly),#assembly h2,#assembly .lead,.pictures>*:not(:last-child),.pictures h3,.pictures ol,footer{display:none!important}
section{border:0!important}.pictures{display:block!important}.pictures svg{width:760px;max-width:none}</style>"""


def browser():
    found = next((path for path in map(shutil.which, ("chromium", "chromium-browser", "google-chrome")) if path), None)
    return found or sys.exit("Chromium is not installed")


def drawn(page, addition, size, picture):
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder, "page.html")
        file.write_text(page.replace("</body>", addition + "</body>", 1), encoding="utf-8")
        subprocess.run([browser(), "--headless", "--no-sandbox", "--hide-scrollbars", "--disable-dev-shm-usage", "--use-angle=swiftshader",
                        "--enable-unsafe-swiftshader", f"--user-data-dir={folder}/user", f"--window-size={size}", "--virtual-time-budget=5000",
                        f"--screenshot={picture}", file.as_uri()], stderr=subprocess.DEVNULL, stdout=subprocess.DEVNULL, timeout=120, check=True)


def main():
    fusee = sys.argv[1]
    folder = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else HERE).resolve()
    for profile in sorted(HERE.parent.glob("*.toml")):
        with tempfile.TemporaryDirectory() as made:
            subprocess.run([fusee, "build", profile, "-o", made + "/out", "-q"], stdout=subprocess.DEVNULL, check=True)
            page = pathlib.Path(made, "out/report.html").read_text(encoding="utf-8")
            large = profile.stem == "paper_optimum"
            if large:
                subprocess.run([fusee, "kit", profile, "-o", made + "/kit", "-q"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=True)
                kit = pathlib.Path(made, "kit/kit.html").read_text(encoding="utf-8")
        drawn(page, ALONE, "960,540" if large else "420,340", folder / f"{profile.stem}.png")
        if large:
            drawn(page, MOVED, "1000,1150", folder / "page.png")
            drawn(kit, ASSEMBLED, "860,680", folder / "kit.png")


if __name__ == "__main__":
    main()

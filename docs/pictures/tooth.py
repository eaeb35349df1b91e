#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Makes the pictures of a real scan: tooth.png of README.md by --png, page.png of docs/segmentation.md by --html.

    python3 docs/pictures/tooth.py build/test/topoadapt DATA/volumes/tooth.nhdr docs/pictures

DATA is the folder of CMake's variable TOPOADAPT_SHARED_DATA. Needs Chromium (Debian: chromium).
"""
import os
import subprocess
import sys
import tempfile

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../tests/tool"))
from chromium import Page

# The cut shows the cavity.
SCRIPT = """(() => {
  for (const [name, value] of [['cut', '1'], ['cut_at', '500']]) {
    const control = document.getElementById(name);
    control.value = value;
    for (const kind of ['input', 'change']) control.dispatchEvent(new Event(kind));
  }
})()"""


def main():
    if len(sys.argv) != 4:
        sys.exit("usage: tooth.py TOOL VOLUME FOLDER")
    tool, volume, folder = sys.argv[1:]
    tooth, shot = os.path.join(folder, "tooth.png"), os.path.join(folder, "page.png")
    with tempfile.TemporaryDirectory() as scratch:
        html = os.path.join(scratch, "tooth.html")
        subprocess.run([tool, "segment", volume, "--seed", "50,45,80", "--threshold", "600", "--sigma", "0.7", "--bright",
                        "--quiet", "--png", tooth, "--html", html], check=True)
        page = Page(1280, 860)
        try:
            page.open(html)
            page.run(SCRIPT)
            picture = page.screenshot()
        finally:
            page.close()
    with open(shot, "wb") as file:
        file.write(picture)


if __name__ == "__main__":
    main()

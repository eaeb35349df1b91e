# SPDX-License-Identifier: MIT
"""Makes the add-on as Blender installs it, with a wheel of examples/python unpacked inside.

    python3 package.py OUT.zip WHEEL
"""

import os
import sys
import zipfile

HERE = os.path.dirname(os.path.abspath(__file__))
ADDON = "topoadapt_blender"
TIME = (1980, 1, 1, 0, 0, 0)  # the same bytes on each run


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    out, wheel = sys.argv[1:]
    files = {"LICENSE": os.path.join(HERE, "..", "..", "LICENSE")}
    files.update({name: os.path.join(HERE, ADDON, name) for name in sorted(os.listdir(os.path.join(HERE, ADDON)))})
    with zipfile.ZipFile(out, "w", zipfile.ZIP_DEFLATED) as archive, zipfile.ZipFile(wheel) as package:

        def add(name, data):
            archive.writestr(zipfile.ZipInfo("{}/{}".format(ADDON, name), TIME), data, zipfile.ZIP_DEFLATED)

        for name, path in files.items():
            if os.path.isfile(path):
                with open(path, "rb") as file:
                    add(name, file.read())
        for name in sorted(package.namelist()):
            add("wheel/" + name, package.read(name))


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: MIT
"""Makes a wheel with the library inside, offline, with pip, setuptools and wheel of this interpreter.

    python3 wheel.py OUT LIBRARY

LIBRARY is the shared library. On Linux the tag is manylinux where LIBRARY needs nothing but glibc; its version is that
of the newest symbols needed, and at least 2.17 (PEP 599 and 600), the oldest that installers of today know. Otherwise
the tag is the platform of this interpreter.
"""

import os
import re
import shutil
import subprocess
import sys
import sysconfig
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
OLDEST = (2, 17)
# Of PEP 599, as far as a library without C++ can need them.
GLIBC = {"libc.so.6", "libm.so.6", "libpthread.so.0", "libdl.so.2", "librt.so.1", "ld-linux-x86-64.so.2"}
GLIBC |= {"ld-linux-aarch64.so.1", "ld-linux.so.2"}
NAMES = {"win32": "topoadapt.dll", "darwin": "libtopoadapt.dylib"}


def platform_tag(library):
    """The tag of the oldest platform on which the library loads."""
    own = re.sub("[-.]", "_", sysconfig.get_platform())
    if not own.startswith("linux_"):
        return own
    dump = subprocess.run(["objdump", "-p", library], check=True, stdout=subprocess.PIPE).stdout.decode()
    needed = set(re.findall(r"NEEDED +(\S+)", dump))
    references = dump.partition("Version References:")[2]
    versions = re.findall(r"0x\w+ 0x\w+ \d+ (\S+)", references)
    numbers = [re.fullmatch(r"GLIBC_(\d+)\.(\d+)(?:\.\d+)?", version) for version in versions]
    if not needed <= GLIBC or not all(numbers):
        return own
    newest = max([OLDEST] + [(int(number[1]), int(number[2])) for number in numbers])
    tag = own.replace("linux_", "manylinux_{}_{}_".format(*newest), 1)
    # The older name of the same platform, for older installers.
    return tag + "." + own.replace("linux_", "manylinux2014_", 1) if newest == OLDEST else tag


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    out, library = (os.path.abspath(path) for path in sys.argv[1:])
    with tempfile.TemporaryDirectory() as folder:
        source = os.path.join(folder, "source")
        unwanted = shutil.ignore_patterns("__pycache__", "build", "*.egg-info", ".mypy_cache", "tests")
        shutil.copytree(HERE, source, ignore=unwanted)
        shutil.copy(os.path.join(HERE, "..", "..", "LICENSE"), source)
        name = NAMES.get(sys.platform, "libtopoadapt.so")
        # Not beside the modules: a library would be taken for one.
        inside = os.path.join(source, "topoadapt", "library", name)
        os.mkdir(os.path.dirname(inside))
        shutil.copyfile(os.path.realpath(library), inside)
        if sys.platform.startswith("linux"):
            subprocess.run(["strip", "--strip-unneeded", inside], check=True)
        environment = dict(os.environ, TOPOADAPT_WHEEL_PLATFORM=platform_tag(inside))
        options = ["--no-deps", "--no-build-isolation", "--no-index", "--disable-pip-version-check", "--quiet"]
        command = [sys.executable, "-m", "pip", "wheel", *options, "--wheel-dir", out, source]
        subprocess.run(command, check=True, env=environment)


if __name__ == "__main__":
    main()

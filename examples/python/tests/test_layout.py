# SPDX-License-Identifier: MIT
"""Structures and constants of this package against topoadapt.h, as a C compiler sees them.

A structure with struct_size may be longer in the header: a newer library takes the shorter one."""

import ctypes
import os
import re
import shutil
import subprocess
import tempfile
import unittest

from topoadapt import _library, _structures, records

COMPILER = os.environ.get("CC") or shutil.which("cc") or shutil.which("gcc") or shutil.which("clang")
HERE = os.path.dirname(os.path.abspath(__file__))
INCLUDE = os.environ.get("TOPOADAPT_INCLUDE", os.path.join(HERE, "..", "..", "..", "include"))
STRUCTURES = [
    value
    for value in vars(_structures).values()
    if isinstance(value, type) and issubclass(value, ctypes.Structure) and value is not ctypes.Structure
]
PREFIXES = {"Status": "TPA_", "Defect": "TPA_DEFECT_", "Limit": "TPA_LIMIT_", "DetectMode": "TPA_DETECT_"}
PREFIXES.update({"Region": "TPA_REGION_", "EventType": "TPA_EVENT_"})
CONSTANTS = {
    prefix + member.name: int(member) for name, prefix in PREFIXES.items() for member in getattr(_structures, name)
}
for constant in ("NONE", "FLOAT32", "FLOAT64", "UINT16", "UINT32", "HANDLE_MAX_FACES"):
    CONSTANTS["TPA_" + constant] = getattr(_structures, constant)


def source():
    """A C program that prints name and number of everything to compare."""
    lines = ["#include <stdio.h>", "#include <topoadapt.h>", "int main(void) {"]
    for structure in STRUCTURES:
        name = structure.__name__
        lines.append('printf("sizeof %s %zu\\n", "{0}", sizeof({0}));'.format(name))
        for field, _ in structure._fields_:
            lines.append('printf("offset {0}.{1} %zu\\n", offsetof({0}, {1}));'.format(name, field))
            lines.append('printf("size {0}.{1} %zu\\n", sizeof((({0}*)0)->{1}));'.format(name, field))
    lines += ['printf("constant {0} %lld\\n", (long long){0});'.format(name) for name in CONSTANTS]
    return "\n".join(lines + ["return 0;", "}", ""])


def seen_by_compiler():
    with tempfile.TemporaryDirectory() as folder:
        program = os.path.join(folder, "layout")
        with open(program + ".c", "w", encoding="utf-8") as file:
            file.write(source())
        subprocess.run([COMPILER, "-std=c99", "-I" + INCLUDE, program + ".c", "-o", program], check=True)
        output = subprocess.run([program], check=True, stdout=subprocess.PIPE).stdout.decode()
    return {tuple(line.split()[:2]): int(line.split()[2]) for line in output.splitlines()}


@unittest.skipUnless(COMPILER, "no C compiler")
@unittest.skipUnless(os.path.exists(os.path.join(INCLUDE, "topoadapt.h")), "no topoadapt.h: set TOPOADAPT_INCLUDE")
class Layout(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.seen = seen_by_compiler()
        with open(os.path.join(INCLUDE, "topoadapt.h"), encoding="utf-8") as file:
            cls.header = re.sub(r"/\*.*?\*/", "", file.read(), flags=re.S)

    def test_fields_lie_where_the_compiler_puts_them(self):
        for structure in STRUCTURES:
            for field, _ in structure._fields_:
                name, described = "{}.{}".format(structure.__name__, field), getattr(structure, field)
                self.assertEqual(described.offset, self.seen["offset", name], name)
                self.assertEqual(described.size, self.seen["size", name], name)

    def test_structures_have_their_sizes(self):
        self.assertGreater(len(STRUCTURES), 15)
        for structure in STRUCTURES:
            name, size = structure.__name__, ctypes.sizeof(structure)
            in_c = self.seen["sizeof", name]
            if structure._fields_[0][0] == "struct_size":
                self.assertLessEqual(size, in_c, name)
            else:
                self.assertEqual(size, in_c, name)

    def test_known_fields_leave_no_gap(self):
        """Each field of the header up to the last one known here is known here, in the same order."""
        for structure in STRUCTURES:
            body = re.search(r"typedef struct {0} {{(.*?)}} {0};".format(structure.__name__), self.header, re.S).group(
                1
            )
            in_header = re.findall(
                r"(\w+)(?:\[\d+\])?(?=[,;])|\(\*(\w+)\)\([^;]*;", re.sub(r"\(void\* user.*", ";", body)
            )
            names = [a or b for a, b in in_header]
            known = [field for field, _ in structure._fields_ if field != "parallel_for"]
            self.assertEqual([n for n in names if n != "parallel_for"][: len(known)], known, structure.__name__)

    def test_records_have_the_fields(self):
        """Those of the structures, but for sizes and what is reserved."""
        for name in ("Report", "Validation", "Component", "MemoryTable", "HandleInfo"):
            structure = getattr(_structures, "tpa_" + re.sub("(?<!^)(?=[A-Z])", "_", name).lower())
            fields = [field for field, _ in structure._fields_ if field not in ("struct_size", "reserved")]
            self.assertEqual(list(getattr(records, name)._fields), fields)

    def test_constants_have_their_values(self):
        for name, value in CONSTANTS.items():
            self.assertEqual(self.seen["constant", name], value, name)

    def test_functions_take_as_many_arguments(self):
        for name, (_, arguments) in _library._PROTOTYPES.items():
            found = re.search(r"TPA_API [^;]*?\b{}\(([^;]*)\);".format(name), self.header, re.S)
            self.assertIsNotNone(found, name)
            listed = found.group(1).strip()
            self.assertEqual(0 if listed == "void" else listed.count(",") + 1, len(arguments), name)


if __name__ == "__main__":
    unittest.main()

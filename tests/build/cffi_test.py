# SPDX-License-Identifier: MIT
"""cffi_test.py HEADER LIBRARY: the header from Python. All constants are there, enums have names, and tpa_config has
the size that the library takes."""
import re
import sys

import cffi


def declarations(header):
    """The header for cffi: no directives but plain constants, nothing for C++, no attributes."""
    text = re.sub(r"/\*.*?\*/", "", header, flags=re.S)
    text = re.sub(r"#ifdef __cplusplus.*?#endif", "", text, flags=re.S)
    lines = [x for x in text.splitlines() if not x.startswith("#") or re.match(r"#define TPA_\w+ [0-9]\w*$", x)]
    return "\n".join(lines).replace("TPA_API ", "")


header = open(sys.argv[1], encoding="utf-8").read()
ffi = cffi.FFI()
ffi.cdef(declarations(header))
library = ffi.dlopen(sys.argv[2])

names = set(re.findall(r"\b(TPA_[A-Z0-9_]+) = -?[0-9]", header)) | set(re.findall(r"#define (TPA_\w+) [0-9]", header))
assert len(names) > 50, names
for name in names:
    assert isinstance(getattr(library, name), int), name
assert library.TPA_NONE == 0xFFFFFFFF
assert library.TPA_E_TANGLED == -9
enums = re.findall(r"^enum (\w+)", header, flags=re.M)
assert len(enums) >= 7 and not re.search(r"\benum *{", header), enums
for name in enums:
    assert ffi.typeof("enum " + name).elements, name
version = library.TPA_VERSION_MAJOR << 16 | library.TPA_VERSION_MINOR << 8 | library.TPA_VERSION_PATCH
assert library.tpa_version() == version

config = ffi.new("tpa_config*")
assert library.tpa_config_init(config, ffi.sizeof("tpa_config")) == library.TPA_OK
assert (config.struct_size, config.smooth_mu) == (ffi.sizeof("tpa_config"), -0.6732)
config.max_passes = 65
size, issue, text = ffi.new("tpa_arena_size*"), ffi.new("tpa_issue*"), ffi.new("char[200]")
assert library.tpa_arena_query(config, size, issue) == library.TPA_E_CONFIG
library.tpa_issue_text(issue, text, 200)
assert b"config.max_passes" in ffi.string(text), ffi.string(text)
print(len(names), "constants,", len(enums), "enums")

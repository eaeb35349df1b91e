# SPDX-License-Identifier: MIT
"""The config of a context: fields by name, limits raised, memory needed."""

from __future__ import annotations

from ctypes import byref
from typing import Any

from . import _structures as s
from ._library import lib
from .errors import check

# Most that a limit may be raised to.
_MOST = {"max_vertices": 1 << 29, "max_triangles": 1 << 30, "max_contacts": 1 << 30, "max_substeps": 1 << 20}
_MOST_OF_OTHERS = 1 << 28


def config_fields() -> list[str]:
    """Names of the fields of tpa_config that callers set."""
    names = [field[0] for field in s.tpa_config._fields_]
    return [name for name in names if name not in ("struct_size", "cookie", "reserved")]


def copy_of_config(config: s.tpa_config) -> s.tpa_config:
    return s.tpa_config.from_buffer_copy(config)


def set_fields(config: s.tpa_config, values: dict[str, Any]) -> None:
    """Sets fields by their names in topoadapt.h."""
    known = config_fields()
    for field, value in values.items():
        if field not in known:
            raise TypeError("{!r} is no field of the config ({})".format(field, ", ".join(known)))
        s.set_field(config, field, value)


def query(config: s.tpa_config) -> s.tpa_arena_size:
    """Size and alignment of the block for a config."""
    size, issue = s.tpa_arena_size(), s.tpa_issue()
    check(lib.tpa_arena_query(byref(config), byref(size), byref(issue)), issue)
    return size


def raised(config: s.tpa_config, issue: s.tpa_issue) -> s.tpa_config:
    """The config with the limit of an issue raised. Raises the issue where the limit is as high as it can be."""
    field = s.CONFIG_FIELD.get(issue.limit, "")
    most = _MOST.get(field, _MOST_OF_OTHERS)
    if not field or issue.needed > most:
        check(issue.status, issue)
    larger = copy_of_config(config)
    setattr(larger, field, min(most, max(2 * issue.available, issue.needed + issue.needed // 4)))
    return larger

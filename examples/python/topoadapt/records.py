# SPDX-License-Identifier: MIT
"""Plain tuples for the structures that the library fills in. Fields are those of topoadapt.h, where each has its
meaning, unit and range."""

from collections import namedtuple

from . import _structures as s


def _record(name, structure, doc):
    fields = [field for field, _ in structure._fields_ if field not in ("struct_size", "reserved")]
    made = namedtuple(name, fields, module=__name__)
    made.__doc__ = doc
    return made


Report = _record("Report", s.tpa_report, "Account of a step, adapt, remesh or smooth (tpa_report).")
Validation = _record("Validation", s.tpa_validation, "Result of validate (tpa_validation).")
Component = _record("Component", s.tpa_component, "A connected component (tpa_component).")
Event = _record("Event", s.tpa_event, "A change of topology (tpa_event); None where there is no component.")
MemoryTable = _record("MemoryTable", s.tpa_memory_table, "A table of the block (tpa_memory_table).")
HandleInfo = _record("HandleInfo", s.tpa_handle_info, "Stored handles for given polygons (tpa_handle_info).")

VertexMap = namedtuple("VertexMap", "old_to_new parents weights", module=__name__)
VertexMap.__doc__ = """How the last commit renumbered vertices: `old_to_new` (old count,) with NONE for removed ones;
`parents` (new count, 2) in old ids, the second NONE for an old vertex; `weights` (new count,) of the first parent."""
Changes = namedtuple("Changes", "vertices faces changed_vertices changed_faces", module=__name__)
Changes.__doc__ = """What to copy after the last commit: `vertices` and `faces` are (k, 2) arrays of first id and count;
the numbers count changed elements without gaps."""
Surface = namedtuple("Surface", "vertices faces report", module=__name__)
Surface.__doc__ = """A mesh as arrays, (n, 3) float64 and (m, 3) uint32, and the Report of the call that made it."""


def read(record, structure):
    """The record of a filled structure."""
    values = (getattr(structure, field) for field in record._fields)
    return record(*(tuple(value) if hasattr(value, "_length_") else value for value in values))


def read_event(event):
    """The record of an event, with names and None for numbers that stand for them."""
    kinds = s.EventType._value2member_map_
    component = [None if id_ == s.NONE else id_ for id_ in (event.before, event.after)]
    return Event(kinds.get(event.type, event.type), event.amount, *component, tuple(event.position))

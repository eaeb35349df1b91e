# SPDX-License-Identifier: MIT
"""Plain tuples for the structures that the library fills in. Fields are those of topoadapt.h, where each has its
meaning, unit and range; tests/test_layout.py compares the names."""

from __future__ import annotations

from ctypes import Structure
from typing import Any, NamedTuple, Optional, TypeVar, Union

import numpy as np
import numpy.typing as npt

from . import _structures as s

_R = TypeVar("_R", bound=tuple)  # type: ignore[type-arg]


class Report(NamedTuple):
    """Account of a step, advance, adapt, remesh or smooth (tpa_report)."""

    passes: int
    contacts: int
    groups: int
    handles: tuple[int, int, int, int]
    caps: int
    removed_patches: int
    rolled_back_vertices: int
    unresolved: int
    splits: int
    collapses: int
    flips: int
    moved: int
    vertices: int
    triangles: int
    approach: float
    region_before: float
    region_after: float
    region_lost: float
    region_gained: float
    region_reach: float
    substeps: int
    unfinished: int


class Validation(NamedTuple):
    """Result of validate (tpa_validation)."""

    components: int
    self_intersections: int
    euler: int
    genus: int
    volume: float
    area: float


class Component(NamedTuple):
    """A connected component (tpa_component)."""

    id: int
    before: int
    vertices: int
    triangles: int
    genus: int
    volume: float
    area: float
    box: tuple[float, float, float, float, float, float]


class Event(NamedTuple):
    """A change of topology (tpa_event); None where there is no component.

    A component that comes apart is one event of type SPLIT: `amount` counts the pieces, `pieces` names them, and `after`
    is the first. `pieces` is empty for all other events.
    """

    type: Union[s.EventType, int]
    amount: int
    before: Optional[int]
    after: Optional[int]
    position: tuple[float, float, float]
    pieces: tuple[int, ...] = ()


class MemoryTable(NamedTuple):
    """A table of the block (tpa_memory_table)."""

    name: str
    bytes: int
    used: int
    peak: int
    limit: int


class HandleInfo(NamedTuple):
    """Stored handles for given polygons (tpa_handle_info)."""

    generators: int
    handles: int
    faces: int
    complete: int


class VertexMap(NamedTuple):
    """How the last commit renumbered vertices: `old_to_new` (old count,) with NONE for removed ones; `parents`
    (new count, 2) in old ids, the second NONE for an old vertex; `weights` (new count,) of the first parent."""

    old_to_new: npt.NDArray[np.uint32]
    parents: npt.NDArray[np.uint32]
    weights: npt.NDArray[np.float32]


class Changes(NamedTuple):
    """What to copy after the last commit: `vertices` and `faces` are (k, 2) arrays of first id and count; the numbers
    count changed elements without gaps."""

    vertices: npt.NDArray[np.uint32]
    faces: npt.NDArray[np.uint32]
    changed_vertices: int
    changed_faces: int


class Surface(NamedTuple):
    """A mesh as arrays, (n, 3) float64 and (m, 3) uint32, and the Report of the call that made it."""

    vertices: npt.NDArray[np.float64]
    faces: npt.NDArray[np.uint32]
    report: Report


def read(record: type[_R], structure: Structure) -> _R:
    """The record of a filled structure."""
    values: list[Any] = [getattr(structure, field) for field in record._fields]  # type: ignore[attr-defined]
    return record(*(tuple(value) if hasattr(value, "_length_") else value for value in values))


def read_events(events: Any) -> list[Event]:
    """The records of events, with names and None for numbers that stand for them. The library tells of a component that
    comes apart once for each piece; here it is one event."""
    found: list[Event] = []
    splits: dict[int, int] = {}
    for raw in events:
        if raw.type == s.EventType.SPLIT and raw.before in splits:
            place = splits[raw.before]
            found[place] = found[place]._replace(pieces=found[place].pieces + (raw.after,))
            continue
        kinds = s.EventType._value2member_map_
        before, after = (None if id_ == s.NONE else id_ for id_ in (raw.before, raw.after))
        event = Event(kinds.get(raw.type, raw.type), raw.amount, before, after, tuple(raw.position))  # type: ignore
        if raw.type == s.EventType.SPLIT:
            splits[raw.before] = len(found)
            event = event._replace(pieces=(raw.after,))
        found.append(event)
    return found

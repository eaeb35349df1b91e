# SPDX-License-Identifier: MIT
"""Structures and constants of topoadapt.h, as ctypes sees them. tests/test_layout.py compares them with a C compiler."""

from __future__ import annotations

import enum
import operator
from ctypes import CFUNCTYPE, POINTER, Structure, c_char_p, c_double, c_float, c_int32, c_int64, c_size_t, c_uint32
from ctypes import c_uint64, c_void_p, sizeof
from typing import Any, TypeVar

_S = TypeVar("_S", bound=Structure)

NONE = 0xFFFFFFFF  # "no such element"

FLOAT32, FLOAT64, UINT16, UINT32 = 1, 2, 3, 4
HANDLE_MAX_FACES = 64


class Status(enum.IntEnum):
    """Outcome of a call of the library."""

    OK = 0
    E_ARGUMENT = -1
    E_CONFIG = -2
    E_OVERFLOW = -3
    E_ARENA = -4
    E_CONTEXT = -5
    E_STATE = -6
    E_LIMIT = -7
    E_MESH = -8
    E_TANGLED = -9
    E_ENVIRONMENT = -10
    E_BUDGET = -11
    E_CANCELLED = -12
    E_DATA = -13


class Defect(enum.IntEnum):
    """Defect of a mesh, the field `defect` of MeshError."""

    NONE = 0
    NOT_FINITE = 1
    MAGNITUDE = 2
    INDEX_RANGE = 3
    REPEATED_VERTEX = 4
    ORIENTATION = 5
    NON_MANIFOLD_EDGE = 6
    BOUNDARY_EDGE = 7
    NON_MANIFOLD_VERTEX = 8
    ISOLATED_VERTEX = 9


class Limit(enum.IntEnum):
    """Limit of the config, the field `limit` of LimitError."""

    NONE = 0
    VERTICES = 1
    TRIANGLES = 2
    CONTACTS = 3
    CUT = 4
    EVENTS = 5
    COMPONENTS = 6
    PIECES = 7
    SUBSTEPS = 8


class DetectMode(enum.IntEnum):
    """How contacts are found: all of them, or by the hash of the paper's section 3."""

    COMPLETE = 0
    VERTEX_HASH = 1


class Region(enum.IntEnum):
    """Side of the surface on which the object lies."""

    INSIDE = 0
    OUTSIDE = 1


class EventType(enum.IntEnum):
    """Kind of an event of the last commit."""

    HANDLE = 1
    CAP = 2
    REMOVAL = 3
    ROLLBACK = 4
    MERGE = 5
    SPLIT = 6
    GENUS_UP = 7
    GENUS_DOWN = 8
    DEATH = 10


# Fields of the config that each limit names.
CONFIG_FIELD = {
    Limit.VERTICES: "max_vertices",
    Limit.TRIANGLES: "max_triangles",
    Limit.CONTACTS: "max_contacts",
    Limit.CUT: "max_cut_edges",
    Limit.EVENTS: "max_events",
    Limit.COMPONENTS: "max_components",
    Limit.PIECES: "max_pieces",
    Limit.SUBSTEPS: "max_substeps",
}


class tpa_issue(Structure):
    _fields_ = [
        ("status", c_int32),
        ("defect", c_int32),
        ("limit", c_int32),
        ("argument", c_int32),
        ("element", c_uint64),
        ("other", c_uint64),
        ("needed", c_uint64),
        ("available", c_uint64),
    ]


class tpa_config(Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("cookie", c_uint32),
        ("max_vertices", c_uint32),
        ("max_triangles", c_uint32),
        ("max_contacts", c_uint32),
        ("max_cut_edges", c_uint32),
        ("max_events", c_uint32),
        ("max_components", c_uint32),
        ("max_pieces", c_uint32),
        ("detect_mode", c_uint32),
        ("cell_size", c_double),
        ("region", c_uint32),
        ("max_passes", c_uint32),
        ("max_candidates", c_uint32),
        ("smooth_iterations", c_uint32),
        ("smooth_lambda", c_double),
        ("smooth_mu", c_double),
        ("max_substeps", c_uint32),
        ("reserved", c_uint32),
    ]


class tpa_arena_size(Structure):
    _fields_ = [("bytes", c_size_t), ("alignment", c_size_t)]


class tpa_memory_table(Structure):
    _fields_ = [
        ("name", c_char_p),
        ("bytes", c_uint64),
        ("used", c_uint64),
        ("peak", c_uint64),
        ("limit", c_uint64),
    ]


class tpa_mesh_input(Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("vertex_count", c_uint32),
        ("triangle_count", c_uint32),
        ("position_type", c_uint32),
        ("index_type", c_uint32),
        ("position_stride", c_uint32),
        ("triangle_stride", c_uint32),
        ("positions", c_void_p),
        ("triangles", c_void_p),
    ]


class tpa_mesh_view(Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("vertex_count", c_uint32),
        ("triangle_count", c_uint32),
        ("reserved", c_uint32),
        ("epoch", c_uint64),
        ("positions", c_void_p),
        ("triangles", c_void_p),
        ("opposites", c_void_p),
    ]


class tpa_move_input(Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("count", c_uint32),
        ("position_type", c_uint32),
        ("position_stride", c_uint32),
        ("positions", c_void_p),
        ("vertices", c_void_p),
    ]


TASK = CFUNCTYPE(None, c_void_p, c_uint32)
PARALLEL_FOR = CFUNCTYPE(None, c_void_p, c_uint32, TASK, c_void_p)


class tpa_exec(Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("flags", c_uint32),
        ("user", c_void_p),
        ("parallel_for", PARALLEL_FOR),
        ("budget", c_uint64),
        ("cancel", POINTER(c_int32)),
        ("progress", POINTER(c_uint64)),
    ]


class tpa_contact(Structure):
    _fields_ = [("a", c_uint32), ("b", c_uint32)]


class tpa_contacts(Structure):
    _fields_ = [("struct_size", c_uint32), ("count", c_uint32), ("pairs", c_void_p)]


class tpa_validation(Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("components", c_uint32),
        ("self_intersections", c_uint64),
        ("euler", c_int64),
        ("genus", c_int64),
        ("volume", c_double),
        ("area", c_double),
    ]


class tpa_report(Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("passes", c_uint32),
        ("contacts", c_uint32),
        ("groups", c_uint32),
        ("handles", c_uint32 * 4),
        ("caps", c_uint32),
        ("removed_patches", c_uint32),
        ("rolled_back_vertices", c_uint32),
        ("unresolved", c_uint32),
        ("splits", c_uint32),
        ("collapses", c_uint32),
        ("flips", c_uint32),
        ("moved", c_uint32),
        ("vertices", c_uint32),
        ("triangles", c_uint32),
        ("approach", c_double),
        ("region_before", c_double),
        ("region_after", c_double),
        ("region_lost", c_double),
        ("region_gained", c_double),
        ("region_reach", c_double),
        ("substeps", c_uint32),
        ("unfinished", c_uint32),
    ]


class tpa_remesh_options(Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("iterations", c_uint32),
        ("target_length", c_double),
        ("split_ratio", c_double),
        ("collapse_ratio", c_double),
        ("relaxation", c_double),
        ("count", c_uint32),
        ("reserved", c_uint32),
        ("vertices", c_void_p),
        ("lengths", c_void_p),
    ]


class tpa_smooth_options(Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("iterations", c_uint32),
        ("count", c_uint32),
        ("reserved", c_uint32),
        ("vertices", c_void_p),
    ]


class tpa_event(Structure):
    _fields_ = [
        ("type", c_int32),
        ("amount", c_uint32),
        ("before", c_uint32),
        ("after", c_uint32),
        ("position", c_double * 3),
    ]


class tpa_component(Structure):
    _fields_ = [
        ("id", c_uint32),
        ("before", c_uint32),
        ("vertices", c_uint32),
        ("triangles", c_uint32),
        ("genus", c_int32),
        ("reserved", c_uint32),
        ("volume", c_double),
        ("area", c_double),
        ("box", c_double * 6),
    ]


class tpa_vertex_origin(Structure):
    _fields_ = [("parents", c_uint32 * 2), ("weight", c_float)]


class tpa_vertex_map_view(Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("old_count", c_uint32),
        ("new_count", c_uint32),
        ("reserved", c_uint32),
        ("old_to_new", c_void_p),
        ("origins", c_void_p),
    ]


class tpa_triangle_map_view(Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("old_count", c_uint32),
        ("new_count", c_uint32),
        ("reserved", c_uint32),
        ("origins", c_void_p),
    ]


class tpa_range(Structure):
    _fields_ = [("first", c_uint32), ("count", c_uint32)]


class tpa_change_list(Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("gap", c_uint32),
        ("vertex_capacity", c_uint32),
        ("triangle_capacity", c_uint32),
        ("vertices", c_void_p),
        ("triangles", c_void_p),
        ("vertex_ranges", c_uint32),
        ("triangle_ranges", c_uint32),
        ("changed_vertices", c_uint32),
        ("changed_triangles", c_uint32),
        ("old_vertex_count", c_uint32),
        ("old_triangle_count", c_uint32),
        ("vertex_count", c_uint32),
        ("triangle_count", c_uint32),
    ]


class tpa_handle_info(Structure):
    _fields_ = [
        ("struct_size", c_uint32),
        ("generators", c_uint32),
        ("handles", c_uint64),
        ("faces", c_uint32),
        ("complete", c_uint32),
    ]


def sized(structure: type[_S], **fields: Any) -> _S:
    """A structure with struct_size and some fields set: `sized(tpa_report)`."""
    made = structure()
    set_field(made, "struct_size", sizeof(structure))
    for field, value in fields.items():
        set_field(made, field, value)
    return made


def set_field(made: Structure, field: str, value: Any) -> None:
    """Sets a field, and raises ValueError for a number that the field cannot hold (ctypes cuts it off in silence)."""
    if isinstance(getattr(made, field), int) and value is not None:
        value = operator.index(value)
    setattr(made, field, value)
    if isinstance(value, int) and getattr(made, field) not in (value, None):
        raise ValueError("{} cannot be {}".format(field, value))

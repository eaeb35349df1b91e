# SPDX-License-Identifier: MIT
"""Finds the library, in the package or installed, loads it, and declares its functions."""

from __future__ import annotations

import ctypes
import ctypes.util
import os
import sys
from ctypes import POINTER, c_char_p, c_double, c_float, c_int32, c_size_t, c_uint32, c_uint64, c_void_p
from typing import Any

from . import _structures as s

_context = c_void_p
_issue = POINTER(s.tpa_issue)

# Result and arguments of each function, in the order of the header.
_PROTOTYPES: dict[str, tuple[Any, list[Any]]] = {
    "tpa_status_string": (c_char_p, [c_int32]),
    "tpa_issue_text": (c_size_t, [_issue, c_void_p, c_size_t]),
    "tpa_version": (c_uint32, []),
    "tpa_build_info": (c_char_p, []),
    "tpa_config_init": (c_int32, [POINTER(s.tpa_config), c_size_t]),
    "tpa_arena_query": (c_int32, [POINTER(s.tpa_config), POINTER(s.tpa_arena_size), _issue]),
    "tpa_init": (c_int32, [c_void_p, c_size_t, POINTER(s.tpa_config), POINTER(_context), _issue]),
    "tpa_reset": (c_int32, [_context]),
    "tpa_memory_stats": (c_int32, [_context, POINTER(s.tpa_memory_table), c_uint32, POINTER(c_uint32)]),
    "tpa_load": (c_int32, [_context, POINTER(s.tpa_mesh_input), _issue]),
    "tpa_view": (c_int32, [_context, POINTER(s.tpa_mesh_view)]),
    "tpa_move": (c_int32, [_context, POINTER(s.tpa_move_input), _issue]),
    "tpa_detect": (c_int32, [_context, POINTER(s.tpa_exec), POINTER(s.tpa_contacts), _issue]),
    "tpa_validate": (c_int32, [_context, POINTER(s.tpa_exec), POINTER(s.tpa_validation), _issue]),
    "tpa_step": (c_int32, [_context, POINTER(s.tpa_exec), POINTER(s.tpa_report), _issue]),
    "tpa_advance": (
        c_int32,
        [_context, c_double, POINTER(s.tpa_exec), POINTER(s.tpa_report), _issue],
    ),
    "tpa_adapt": (c_int32, [_context, POINTER(s.tpa_exec), POINTER(s.tpa_report), _issue]),
    "tpa_remesh": (
        c_int32,
        [_context, POINTER(s.tpa_remesh_options), POINTER(s.tpa_exec), POINTER(s.tpa_report), _issue],
    ),
    "tpa_smooth": (
        c_int32,
        [_context, POINTER(s.tpa_smooth_options), POINTER(s.tpa_exec), POINTER(s.tpa_report), _issue],
    ),
    "tpa_reorder": (c_int32, [_context, _issue]),
    "tpa_events": (c_int32, [_context, POINTER(c_void_p), POINTER(c_uint32)]),
    "tpa_components": (
        c_int32,
        [_context, POINTER(s.tpa_component), c_uint32, c_void_p, POINTER(c_uint32), _issue],
    ),
    "tpa_rolled_back": (c_int32, [_context, POINTER(c_void_p), POINTER(c_uint32)]),
    "tpa_vertex_map": (c_int32, [_context, POINTER(s.tpa_vertex_map_view)]),
    "tpa_triangle_map": (c_int32, [_context, POINTER(s.tpa_triangle_map_view)]),
    "tpa_changes": (c_int32, [_context, POINTER(s.tpa_change_list), _issue]),
    "tpa_carry_vertices": (c_int32, [_context, POINTER(c_float), c_uint32, POINTER(c_float)]),
    "tpa_carry_vertices_f64": (c_int32, [_context, POINTER(c_double), c_uint32, POINTER(c_double)]),
    "tpa_carry_triangles": (c_int32, [_context, POINTER(c_float), c_uint32, POINTER(c_float)]),
    "tpa_grow": (c_int32, [_context, c_void_p, c_size_t, POINTER(s.tpa_config), POINTER(_context), _issue]),
    "tpa_save": (c_int32, [_context, c_void_p, c_size_t, POINTER(c_size_t), _issue]),
    "tpa_restore": (c_int32, [_context, c_char_p, c_size_t, _issue]),
    "tpa_digest": (c_int32, [_context, POINTER(c_uint64)]),
    "tpa_config_of": (c_int32, [_context, POINTER(s.tpa_config)]),
    "tpa_targets": (
        c_int32,
        [_context, POINTER(c_uint32), POINTER(c_double), c_uint32, POINTER(c_uint32)],
    ),
    "tpa_drop_targets": (c_int32, [_context]),
    "tpa_handle_describe": (c_int32, [c_uint32, POINTER(c_uint32), POINTER(s.tpa_handle_info)]),
    "tpa_handle_get": (c_int32, [c_uint32, POINTER(c_uint32), c_uint64, POINTER(c_uint32), c_uint32]),
    "tpa_handle_generator": (
        c_int32,
        [c_uint32, POINTER(c_uint32), c_uint32, POINTER(c_uint32), c_uint32, POINTER(c_uint64)],
    ),
}


def _names() -> list[str]:
    """Names to try, the most particular first. A wheel has the library inside."""
    chosen = os.environ.get("TOPOADAPT_LIBRARY")
    if chosen:
        return [chosen]
    usual = {"win32": "topoadapt.dll", "darwin": "libtopoadapt.dylib"}.get(sys.platform, "libtopoadapt.so")
    own = os.path.join(os.path.dirname(os.path.abspath(__file__)), "library", usual)
    if os.path.exists(own):
        return [own]
    found = ctypes.util.find_library("topoadapt")
    return [found, usual] if found else [usual]


def _load() -> Any:
    names, reasons = _names(), []
    for name in names:
        try:
            return _declare(ctypes.CDLL(name), name)
        except OSError as error:
            reasons.append(str(error))
    raise ImportError(
        "The shared library topoadapt is not found ({}). Install it with `cmake --install`, or set "
        "TOPOADAPT_LIBRARY to the path of the shared library.".format("; ".join(reasons))
    )


def _declare(library: Any, name: str) -> Any:
    for function, (result, arguments) in _PROTOTYPES.items():
        try:
            declared = getattr(library, function)
        except AttributeError:
            raise ImportError("{} has no function {}: it is older than this package".format(name, function)) from None
        declared.restype, declared.argtypes = result, arguments
    return library


lib = _load()

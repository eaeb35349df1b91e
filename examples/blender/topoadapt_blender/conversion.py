# SPDX-License-Identifier: MIT
"""Meshes of Blender as arrays, and back. Faces become triangles."""

import numpy as np

from .carrying import Attributes

# Properties, numbers and kinds of attributes: "means" may be mixed.
_TYPES = {
    "FLOAT": ("value", 1, "means", float),
    "FLOAT_VECTOR": ("vector", 3, "means", float),
    "FLOAT2": ("vector", 2, "means", float),
    "FLOAT_COLOR": ("color", 4, "means", float),
    "BYTE_COLOR": ("color", 4, "means", float),
    "INT": ("value", 1, "picks", np.int32),
    "INT8": ("value", 1, "picks", np.int32),
    "BOOLEAN": ("value", 1, "picks", bool),
}
# Read and written by other means, in Blender of some version or other.
_OWN = {"position", "material_index", "sharp_face", "sharp_edge", "crease", "crease_edge", "UVMap"}


class Source:
    """A mesh as it was: vertices (n, 3), triangles (m, 3), attributes, and how to write attributes again."""

    def __init__(self, thing):
        mesh = thing.data
        mesh.calc_loop_triangles()
        self.vertices = _got(mesh.vertices, "co", 3, float)
        self.faces = _got(mesh.loop_triangles, "vertices", 3, np.int32)
        self._loops = _got(mesh.loop_triangles, "loops", 3, np.int32)
        self._polygons = _got(mesh.loop_triangles, "polygon_index", 1, np.int32)[:, 0]
        self.attributes = Attributes()
        self._types = {}
        self.attributes.faces["material"] = self._of_polygons(mesh, "material_index", np.int32)
        self.attributes.faces["smooth"] = self._of_polygons(mesh, "use_smooth", bool)
        self._uv = [layer.name for layer in mesh.uv_layers]
        for layer in mesh.uv_layers:
            self.attributes.corners["uv", layer.name] = _got(layer.data, "uv", 2, float)[self._loops]
        for attribute in mesh.attributes:
            if attribute.name not in _OWN and attribute.name not in self._uv and not attribute.name.startswith("."):
                self._read(attribute)
        self._groups = [group.name for group in thing.vertex_groups]
        if self._groups:
            self.attributes.means["weights"] = _weights(thing)

    def _of_polygons(self, mesh, field, dtype):
        return _got(mesh.polygons, field, 1, dtype)[self._polygons]

    def _read(self, attribute):
        if attribute.data_type not in _TYPES or attribute.domain not in ("POINT", "FACE", "CORNER"):
            return
        field, size, kind, dtype = _TYPES[attribute.data_type]
        key = ("attribute", attribute.name)
        values = _got(attribute.data, field, size, dtype)
        if attribute.domain == "POINT":
            getattr(self.attributes, kind)[key] = values
        elif attribute.domain == "FACE":
            self.attributes.faces[key] = values[self._polygons]
        elif kind == "means":
            self.attributes.corners[key] = values[self._loops]
        else:
            return
        self._types[key] = (attribute.data_type, attribute.domain)

    def write(self, thing, vertices, faces):
        """Replaces the mesh of the object, with all attributes as they have been carried."""
        mesh, carried = thing.data, self.attributes
        if mesh.shape_keys is not None:
            thing.shape_key_clear()
        mesh.clear_geometry()
        mesh.from_pydata(vertices.tolist(), [], faces.tolist())
        _set(mesh.polygons, "material_index", carried.faces["material"])
        _set(mesh.polygons, "use_smooth", carried.faces["smooth"])
        for name in self._uv:
            layer = mesh.uv_layers.new(name=name, do_init=False)
            _set(layer.data, "uv", carried.corners["uv", name])
        places = {"POINT": ("means", "picks"), "FACE": ("faces",), "CORNER": ("corners",)}
        for key, (data_type, domain) in self._types.items():
            field = _TYPES[data_type][0]
            made = mesh.attributes.new(key[1], data_type, domain)
            (values,) = [getattr(carried, kind)[key] for kind in places[domain] if key in getattr(carried, kind)]
            _set(made.data, field, values)
        if self._groups:
            self._write_weights(thing)
        mesh.update()

    def _write_weights(self, thing):
        weights = self.attributes.means["weights"]
        groups = [thing.vertex_groups.get(name) or thing.vertex_groups.new(name=name) for name in self._groups]
        for group, column in zip(groups, weights.T):
            for vertex in np.flatnonzero(column > 0).tolist():
                group.add([vertex], float(column[vertex]), "REPLACE")


def displacement(thing):
    """The way of each vertex from the basis to the active shape key, times the value of the key: (n, 3)."""
    keys, active = thing.data.shape_keys, thing.active_shape_key
    if keys is None or active is None or active == keys.reference_key:
        return None
    way = _got(active.data, "co", 3, float) - _got(keys.reference_key.data, "co", 3, float)
    return way * (active.value or 1.0)


def _got(collection, field, size, dtype):
    flat = np.empty(len(collection) * size, np.float32 if dtype is float else dtype)
    collection.foreach_get(field, flat)
    return flat.reshape(-1, size).astype(dtype)


def _set(collection, field, values):
    flat = np.ascontiguousarray(values).ravel()
    collection.foreach_set(field, flat.astype(np.float32) if flat.dtype == float else flat)


def _weights(thing):
    weights = np.zeros((len(thing.data.vertices), len(thing.vertex_groups)))
    for vertex in thing.data.vertices:
        for group in vertex.groups:
            weights[vertex.index, group.group] = group.weight
    return weights

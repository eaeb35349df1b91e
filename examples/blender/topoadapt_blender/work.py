# SPDX-License-Identifier: MIT
"""The work of the operators on arrays, without Blender: it may run in a thread beside the interface."""

import os
import threading

import numpy as np
import topoadapt
from topoadapt import Defect

_DEFECTS = {
    Defect.BOUNDARY_EDGE: "the mesh is open: the edge of vertices {0} and {1} has a single face. Fill the hole",
    Defect.NON_MANIFOLD_EDGE: "not a manifold: the edge of vertices {0} and {1} has more than two faces",
    Defect.NON_MANIFOLD_VERTEX: "not a manifold: at vertex {0} only a point joins the faces",
    Defect.ORIENTATION: "faces at the edge of vertices {0} and {1} point in and out: recalculate the normals",
    Defect.ISOLATED_VERTEX: "vertex {0} is loose: delete loose geometry",
    Defect.NOT_FINITE: "vertex {0} has a coordinate that is no number",
}


class Refused(Exception):
    """A mesh that the operators do not take, with a line for the user."""


class Job:
    """Work in a thread of its own. `error` is what ended it, or None; a cancelled job ends with CancelledError."""

    def __init__(self, work, run):
        self.work, self.error = work, None
        self._thread = threading.Thread(target=self._run, args=(run,), daemon=True)
        self._thread.start()

    def _run(self, run):
        try:
            run(self.work)
        except Exception as error:  # told by the thread of the interface
            self.error = error

    def runs(self):
        return self._thread.is_alive()

    def cancel(self):
        """Ends the work, and waits for its end."""
        self.work.cancel()
        self._thread.join()


class Work:
    """A mesh on its way. `progress` is a share of the whole; cancel() ends the work, and leaves Blender's mesh alone."""

    def __init__(self, source):
        self.source, self.attributes = source, source.attributes
        self.control = topoadapt.Control(threads=min(8, os.cpu_count() or 1))
        self.progress = 0.0
        self.text = ""
        self.mesh = _loaded(source.vertices, source.faces)

    def cancel(self):
        self.control.cancel()

    def _commit(self, call):
        """A call that commits; attributes follow."""
        ids, places = self.mesh.targets()
        vertices, faces = self.mesh.vertices.copy(), self.mesh.faces
        vertices[ids] = places
        report = call()
        self.attributes.carry(self.mesh, vertices, faces)
        return report

    def resolve(self):
        """The boundary of the region of winding number 1 or more."""
        contacts = len(self.mesh.detect(self.control))
        if contacts == 0:
            self.text = "no face meets another"
            return
        report = self._commit(lambda: self.mesh.adapt(self.control))
        if report.unresolved:
            raise Refused("{} pairs of faces still meet".format(report.unresolved))
        self.text = "{} pairs of faces met; now {} triangles".format(contacts, report.triangles)

    def inflate(self, steps, distance, displacement, edge_length, thickness):
        """Steps along the normals, or parts of a displacement of each vertex. Lengths of 0: from the mesh."""
        if len(self.mesh.detect(self.control)):
            raise Refused("faces meet already: resolve self-intersections first")
        edge_length = edge_length or _mean_edge(self.mesh)
        thickness = thickness or edge_length
        if displacement is not None:
            self.attributes.means["displacement"] = displacement
        events = []
        for step in range(steps):
            if displacement is None:
                way = distance * _normals(self.mesh)
            else:
                way = self.attributes.means["displacement"] / steps
            self.mesh.move(self.mesh.vertices + way)
            self._commit(lambda: self.mesh.advance(thickness, self.control))
            events += [e.type for e in self.mesh.events() if e.type >= topoadapt.EventType.MERGE]
            self._commit(lambda: self.mesh.remesh(edge_length, 2, control=self.control))
            self.progress = (step + 1) / steps
        self.attributes.means.pop("displacement", None)
        kinds = sorted(set(events))
        told = ["{} {}".format(events.count(kind), kind.name.lower().replace("_", " ")) for kind in kinds]
        self.text = "{} triangles; {}".format(len(self.mesh.faces), ", ".join(told) or "no change of topology")


def _loaded(vertices, faces):
    if min(len(vertices), len(faces)) < 4:
        raise Refused("the mesh is open: a closed surface has four faces or more")
    try:
        mesh = topoadapt.Mesh(vertices, faces, max_substeps=2)
    except topoadapt.MeshError as error:
        text = _DEFECTS.get(error.defect, str(error))
        raise Refused(text.format(error.element, error.other)) from error
    if mesh.validate().volume < 0:
        raise Refused("the faces point inwards: recalculate the normals outside")
    return mesh


def _mean_edge(mesh):
    vertices, faces = mesh.vertices, mesh.faces
    return float(np.linalg.norm(vertices[faces] - vertices[np.roll(faces, 1, axis=1)], axis=2).mean())


def _normals(mesh):
    vertices, faces = mesh.vertices, mesh.faces.astype(np.int64)
    a, b, c = vertices[faces].transpose(1, 0, 2)
    normals = np.zeros_like(vertices)
    np.add.at(normals, faces.ravel(), np.repeat(np.cross(b - a, c - a), 3, axis=0))
    return normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)

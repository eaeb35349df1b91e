# SPDX-License-Identifier: MIT
"""Runs in Blender: installs the add-on from its archive, tries both operators, and renders pictures of before and after.

    blender -b --factory-startup --python-exit-code 1 --python tests/in_blender.py -- ADDON.zip [PICTURES]
"""

import math
import os
import sys
import time
import unittest

import bmesh
import bpy
import numpy as np

ARCHIVE, *PICTURES = sys.argv[sys.argv.index("--") + 1 :]


def spheres(*centres, radius=1.0, name="spheres"):
    """Spheres as one object. Each has a material; the UV of a point is its (x, z), and so is the attribute "place"."""
    shape = bmesh.new()
    for number, centre in enumerate(centres):
        made = bmesh.ops.create_icosphere(shape, subdivisions=4, radius=radius)
        bmesh.ops.translate(shape, verts=made["verts"], vec=centre)
        for face in {face for vertex in made["verts"] for face in vertex.link_faces}:
            face.material_index, face.smooth = number, number == 0
    mesh = bpy.data.meshes.new(name)
    shape.to_mesh(mesh)
    shape.free()
    thing = bpy.data.objects.new(name, mesh)
    bpy.context.collection.objects.link(thing)
    for colour in ((0.9, 0.3, 0.2, 1), (0.1, 0.45, 0.8, 1))[: len(centres)]:
        material = bpy.data.materials.new("of a sphere")
        material.use_nodes = True
        material.node_tree.nodes["Principled BSDF"].inputs["Base Color"].default_value = colour
        mesh.materials.append(material)
    layer, place = mesh.uv_layers.new(name="place"), mesh.attributes.new("height", "FLOAT", "POINT")
    for loop in mesh.loops:
        x, _, z = mesh.vertices[loop.vertex_index].co
        layer.data[loop.index].uv = (x, z)
    place.data.foreach_set("value", [vertex.co.z for vertex in mesh.vertices])
    group = thing.vertex_groups.new(name="right")
    group.add([vertex.index for vertex in mesh.vertices if vertex.co.x > 0], 1.0, "REPLACE")
    choose(thing)
    return thing


def choose(thing):
    bpy.ops.object.select_all(action="DESELECT")
    thing.select_set(True)
    bpy.context.view_layer.objects.active = thing


def judged(mesh):
    """Volume, number of parts, and whether all edges have two faces: by bmesh."""
    shape = bmesh.new()
    shape.from_mesh(mesh)
    closed = all(edge.is_manifold and edge.is_contiguous for edge in shape.edges)
    volume, left, parts = shape.calc_volume(), set(shape.verts), 0
    while left:
        parts += 1
        front = [left.pop()]
        while front:
            found = {edge.other_vert(vertex) for vertex in front for edge in vertex.link_edges} & left
            left -= found
            front = list(found)
    shape.free()
    return volume, parts, closed


def areas(mesh):
    """Area of each material."""
    of = {}
    for polygon in mesh.polygons:
        of[polygon.material_index] = of.get(polygon.material_index, 0) + polygon.area
    return of


def union_by_blender(*centres):
    """The exact Boolean of Blender, of spheres apart."""
    first, second = spheres(centres[0], name="first"), spheres(centres[1], name="second")
    modifier = first.modifiers.new("union", "BOOLEAN")
    modifier.operation, modifier.solver, modifier.object = "UNION", "EXACT", second
    mesh = bpy.data.meshes.new_from_object(first.evaluated_get(bpy.context.evaluated_depsgraph_get()))
    for thing in (first, second):
        bpy.data.objects.remove(thing)
    return mesh


def render(name):
    if not PICTURES:
        return
    scene = bpy.context.scene
    scene.render.engine, scene.cycles.device, scene.cycles.samples = "CYCLES", "CPU", 32
    scene.cycles.use_denoising = False
    scene.render.resolution_x, scene.render.resolution_y = 640, 400
    scene.render.filepath = os.path.join(os.path.abspath(PICTURES[0]), name)
    for kind, place, turn in (("CAMERA", (0.0, -7.6, 1.6), (1.37, 0, 0)), ("LIGHT", (4, -5, 6), (0.7, 0.4, 0.5))):
        if kind == "CAMERA":
            data = bpy.data.cameras.new(kind)
        else:
            data = bpy.data.lights.new(kind, "SUN")
            data.energy = 1.6
        thing = bpy.data.objects.new(kind, data)
        bpy.context.collection.objects.link(thing)
        thing.location, thing.rotation_euler = place, turn
        if kind == "CAMERA":
            scene.camera = thing
    scene.world.use_nodes, scene.world.color = False, (0.4, 0.43, 0.46)
    scene.view_settings.view_transform = "Standard"
    bpy.ops.render.render(write_still=True)


class Operators(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        bpy.ops.preferences.addon_install(filepath=ARCHIVE, overwrite=True)
        bpy.ops.preferences.addon_enable(module="topoadapt_blender")

    def setUp(self):
        for thing in list(bpy.data.objects):
            bpy.data.objects.remove(thing)

    def test_resolve_is_the_union(self):
        centres = (-0.7, 0, 0), (0.7, 0.1, 0.05)
        wanted = union_by_blender(*centres)
        thing = spheres(*centres)
        render("resolve-before.png")
        self.assertEqual(bpy.ops.mesh.topoadapt_resolve(), {"FINISHED"})
        render("resolve-after.png")
        (volume, parts, closed), (volume_wanted, _, _) = judged(thing.data), judged(wanted)
        self.assertTrue(closed)
        self.assertEqual(parts, 1)
        self.assertAlmostEqual(volume / volume_wanted, 1, delta=1e-5)
        of = areas(thing.data)
        self.assertAlmostEqual(of[0] + of[1], areas(wanted)[0], delta=1e-4)
        self.assertAlmostEqual(of[0] / of[1], 1, delta=0.02)

    def test_attributes_are_carried(self):
        thing = spheres((-0.7, 0, 0), (0.7, 0.1, 0.05))
        bpy.ops.mesh.topoadapt_resolve()
        mesh = thing.data
        wrong = 0
        for loop in mesh.loops:
            x, _, z = mesh.vertices[loop.vertex_index].co
            wrong += math.dist(mesh.uv_layers["place"].data[loop.index].uv, (x, z)) > 1e-5
        self.assertEqual(wrong, 0)
        heights = np.empty(len(mesh.vertices), np.float32)
        mesh.attributes["height"].data.foreach_get("value", heights)
        away = np.abs(heights - [vertex.co.z for vertex in mesh.vertices])
        self.assertLess(away.max(), 0.15)  # an edge
        self.assertEqual(np.median(away), 0)
        weighted = [v for v in mesh.vertices if any(group.weight > 0.99 for group in v.groups)]
        self.assertTrue(all(vertex.co.x > -0.15 for vertex in weighted))
        self.assertGreater(len(weighted), 0.4 * len(mesh.vertices))
        for polygon in mesh.polygons:
            self.assertEqual(polygon.use_smooth, polygon.material_index == 0)

    def test_clean_meshes_stay(self):
        thing = spheres((0, 0, 0))
        before = [vertex.co.copy() for vertex in thing.data.vertices]
        bpy.ops.mesh.topoadapt_resolve()
        self.assertEqual([vertex.co.copy() for vertex in thing.data.vertices], before)

    def refused(self, operator, text, **options):
        with self.assertRaisesRegex(RuntimeError, text):
            operator(**options)

    def test_meshes_that_are_refused(self):
        thing = spheres((0, 0, 0))
        shape = bmesh.new()
        shape.from_mesh(thing.data)
        shape.faces.ensure_lookup_table()
        bmesh.ops.delete(shape, geom=[shape.faces[3]], context="FACES_ONLY")
        shape.to_mesh(thing.data)
        count = len(thing.data.vertices)
        for operator in (bpy.ops.mesh.topoadapt_resolve, bpy.ops.mesh.topoadapt_inflate):
            self.refused(operator, "the mesh is open: the edge of vertices \\d+ and \\d+")
        self.assertEqual(len(thing.data.vertices), count)
        bmesh.ops.holes_fill(shape, edges=shape.edges)
        bmesh.ops.reverse_faces(shape, faces=shape.faces)
        shape.to_mesh(thing.data)
        self.refused(bpy.ops.mesh.topoadapt_resolve, "point inwards")
        shape.free()
        bpy.ops.mesh.primitive_plane_add()
        self.refused(bpy.ops.mesh.topoadapt_resolve, "the mesh is open")
        spheres((-0.7, 0, 0), (0.7, 0, 0))
        self.refused(bpy.ops.mesh.topoadapt_inflate, "resolve self-intersections first")
        self.refused(bpy.ops.mesh.topoadapt_inflate, "no shape key", along="SHAPE_KEY")

    def test_inflated_spheres_merge(self):
        thing = spheres((-1.15, 0, 0), (1.15, 0, 0))
        render("inflate-before.png")
        before, _, _ = judged(thing.data)
        bpy.ops.mesh.topoadapt_inflate(steps=8, distance=0.05)
        render("inflate-after.png")
        volume, parts, closed = judged(thing.data)
        self.assertEqual((parts, closed), (1, True))
        # Two balls of radius 1.4, less the lens that they share.
        lens = math.pi * (2.8 - 2.3) ** 2 * (2.3**2 + 4 * 2.3 * 1.4) / (12 * 2.3)
        self.assertAlmostEqual(volume, 2 * 4 / 3 * math.pi * 1.4**3 - lens, delta=0.6)
        self.assertGreater(volume, before)
        self.assertEqual(len(areas(thing.data)), 2)

    def test_a_shape_key_is_followed(self):
        thing = spheres((-1.15, 0, 0), (1.15, 0, 0))
        thing.shape_key_add(name="Basis")
        key = thing.shape_key_add(name="together")
        for vertex, point in zip(thing.data.vertices, key.data):
            point.co.x = vertex.co.x - math.copysign(0.4, vertex.co.x)
        key.value, thing.active_shape_key_index = 1.0, 1
        bpy.ops.mesh.topoadapt_inflate(steps=4, along="SHAPE_KEY")
        volume, parts, closed = judged(thing.data)
        self.assertEqual((parts, closed), (1, True))
        self.assertAlmostEqual(max(vertex.co.x for vertex in thing.data.vertices), 1.75, delta=0.02)
        self.assertAlmostEqual(volume, 2 * 4 / 3 * math.pi - math.pi * 0.5**2 * (1.5**2 + 6) / 18, delta=0.3)
        self.assertIsNone(thing.data.shape_keys)

    def test_a_job_tells_its_progress_and_is_cancelled(self):
        from topoadapt import errors
        from topoadapt_blender.conversion import Source
        from topoadapt_blender.work import Job, Work

        thing = spheres((-1.15, 0, 0), (1.15, 0, 0))
        before = [vertex.co.copy() for vertex in thing.data.vertices]
        job = Job(Work(Source(thing)), lambda work: work.inflate(100000, 1e-6, None, 0, 0))
        for _ in range(10000):
            if job.work.progress > 0 or not job.runs():
                break
            time.sleep(0.01)
        self.assertTrue(job.runs())
        self.assertTrue(0 < job.work.progress < 1)
        job.cancel()
        self.assertFalse(job.runs())
        self.assertIsInstance(job.error, errors.CancelledError)
        self.assertEqual([vertex.co.copy() for vertex in thing.data.vertices], before)
        done = Job(Work(Source(spheres((-0.7, 0, 0), (0.7, 0, 0)))), Work.resolve)
        while done.runs():
            time.sleep(0.01)
        self.assertIsNone(done.error)
        self.assertEqual(done.work.mesh.validate().components, 1)

    def test_undo(self):
        thing = spheres((-0.7, 0, 0), (0.7, 0.1, 0.05))
        name, count = thing.name, len(thing.data.vertices)
        bpy.context.preferences.edit.use_global_undo = True
        bpy.ops.ed.undo_push(message="before")
        bpy.ops.mesh.topoadapt_resolve("EXEC_DEFAULT", True)
        self.assertNotEqual(len(bpy.data.objects[name].data.vertices), count)
        bpy.ops.ed.undo()
        self.assertEqual(len(bpy.data.objects[name].data.vertices), count)


result = unittest.main(argv=["in_blender"], exit=False).result
sys.exit(0 if result.wasSuccessful() and result.testsRun else 1)

# SPDX-License-Identifier: MIT
"""Runs in Blender with a window, such as that of Xvfb: the operators as a menu starts them, which go on while the window
stays alive.

    xvfb-run blender --factory-startup --python tests/in_window.py -- ADDON.zip
"""

import os
import sys

import bmesh
import bpy

ARCHIVE = sys.argv[sys.argv.index("--") + 1]
MOST_TICKS = 200


def two_spheres():
    shape = bmesh.new()
    for x in (-0.7, 0.7):
        made = bmesh.ops.create_icosphere(shape, subdivisions=4, radius=1)
        bmesh.ops.translate(shape, verts=made["verts"], vec=(x, 0, 0))
    mesh = bpy.data.meshes.new("spheres")
    shape.to_mesh(mesh)
    shape.free()
    thing = bpy.data.objects.new("spheres", mesh)
    bpy.context.collection.objects.link(thing)
    bpy.context.view_layer.objects.active = thing
    return thing


def view():
    """Where an operator of a menu begins."""
    window = bpy.context.window_manager.windows[0]
    area = next(area for area in window.screen.areas if area.type == "VIEW_3D")
    region = next(region for region in area.regions if region.type == "WINDOW")
    return bpy.context.temp_override(window=window, area=area, region=region)


def acts():
    """Each yield waits for the next tick. Ends with the status of the process."""
    thing = two_spheres()
    before = len(thing.data.vertices)
    with view():
        started = bpy.ops.mesh.topoadapt_resolve("INVOKE_DEFAULT")
    if started != {"RUNNING_MODAL"} or len(thing.data.vertices) != before:
        return print("the operator did not go on beside the window:", started) or 1
    for _ in range(MOST_TICKS):
        if len(thing.data.vertices) != before:
            break
        yield
    resolved = len(thing.data.vertices)
    with view():
        bpy.ops.mesh.topoadapt_inflate("INVOKE_DEFAULT", steps=2)
    for _ in range(MOST_TICKS):
        if len(thing.data.vertices) != resolved:
            break
        yield
    print(before, resolved, len(thing.data.vertices))
    return 0 if len({before, resolved, len(thing.data.vertices)}) == 3 else 1


def tick(running):
    try:
        next(running)
    except StopIteration as end:
        sys.stdout.flush()
        os._exit(end.value)
    except Exception as error:
        print(error, flush=True)
        os._exit(1)
    return 0.1


bpy.ops.preferences.addon_install(filepath=ARCHIVE, overwrite=True)
bpy.ops.preferences.addon_enable(module="topoadapt_blender")
running = acts()
bpy.app.timers.register(lambda: tick(running), first_interval=1)

# SPDX-License-Identifier: MIT
"""Two operators. From a menu the work runs in a thread: the header tells the progress, Escape ends it. From a script, and
in the background, the operator returns at the end."""

import bpy
import topoadapt
from bpy.props import EnumProperty, FloatProperty, IntProperty

from .conversion import Source, displacement
from .work import Job, Refused, Work


class _Operator:
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        thing = context.active_object
        return thing is not None and thing.type == "MESH" and thing.mode == "OBJECT"

    def execute(self, context):
        try:
            work = Work(Source(context.active_object))
            self.prepare(context.active_object)(work)
        except (Refused, topoadapt.Error) as error:
            return self._refuse(error)
        return self._finish(context, work)

    def invoke(self, context, event):
        try:
            work, run = Work(Source(context.active_object)), self.prepare(context.active_object)
        except (Refused, topoadapt.Error) as error:
            return self._refuse(error)
        self._thing, self._job = context.active_object, Job(work, run)
        manager = context.window_manager
        manager.progress_begin(0, 100)
        self._timer = manager.event_timer_add(0.1, window=context.window)
        manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type == "ESC":
            self._job.work.cancel()
        if event.type != "TIMER":
            return {"RUNNING_MODAL"}
        if self._job.runs():
            progress = self._job.work.progress
            context.window_manager.progress_update(100 * progress)
            self._tell(context, "{}: {:.0%}   Esc: cancel".format(self.bl_label, progress))
            return {"RUNNING_MODAL"}
        self._end(context)
        error = self._job.error
        if isinstance(error, topoadapt.errors.CancelledError):
            return {"CANCELLED"}
        if isinstance(error, (Refused, topoadapt.Error)):
            return self._refuse(error)
        if error is not None:
            raise error
        return self._finish(context, self._job.work, self._thing)

    def cancel(self, context):
        self._job.cancel()
        self._end(context)

    def _end(self, context):
        context.window_manager.event_timer_remove(self._timer)
        context.window_manager.progress_end()
        self._tell(context, None)

    def _tell(self, context, text):
        if context.area is not None:
            context.area.header_text_set(text)

    def _refuse(self, error):
        self.report({"ERROR"}, "topoadapt: {}".format(error))
        return {"CANCELLED"}

    def _finish(self, context, work, thing=None):
        work.source.write(thing or context.active_object, work.mesh.vertices, work.mesh.faces)
        self.report({"INFO"}, "topoadapt: {}".format(work.text))
        return {"FINISHED"}


class MESH_OT_topoadapt_resolve(_Operator, bpy.types.Operator):
    """Make a closed mesh that runs into itself the surface of the region that it encloses, exactly"""

    bl_idname = "mesh.topoadapt_resolve"
    bl_label = "Resolve Self-Intersections"

    def prepare(self, thing):
        return Work.resolve


class MESH_OT_topoadapt_inflate(_Operator, bpy.types.Operator):
    """Inflate a closed mesh, or follow a shape key: parts that meet merge, necks split, handles open and close"""

    bl_idname = "mesh.topoadapt_inflate"
    bl_label = "Inflate with Topology"

    along: EnumProperty(
        name="Along",
        items=[
            ("NORMALS", "Normals", "Each step moves vertices along their normals"),
            ("SHAPE_KEY", "Shape Key", "All steps together move vertices from the basis to the active shape key"),
        ],
    )
    steps: IntProperty(name="Steps", default=10, min=1, soft_max=100)
    distance: FloatProperty(name="Distance", description="Of a step; negative: inwards", default=0.05, unit="LENGTH")
    edge_length: FloatProperty(name="Edges", description="Length of edges; 0: as they are", min=0, unit="LENGTH")
    thickness: FloatProperty(
        name="Thickness", description="Thinner parts may pass each other; 0: an edge", min=0, unit="LENGTH"
    )

    def prepare(self, thing):
        way = None
        if self.along == "SHAPE_KEY":
            way = displacement(thing)
            if way is None:
                raise Refused("no shape key besides the basis is active")
        return lambda work: work.inflate(self.steps, self.distance, way, self.edge_length, self.thickness)


class VIEW3D_MT_topoadapt(bpy.types.Menu):
    bl_label = "topoadapt"

    def draw(self, context):
        self.layout.operator(MESH_OT_topoadapt_resolve.bl_idname)
        self.layout.operator(MESH_OT_topoadapt_inflate.bl_idname)


def _draw_menu(menu, context):
    menu.layout.menu("VIEW3D_MT_topoadapt")


_CLASSES = (MESH_OT_topoadapt_resolve, MESH_OT_topoadapt_inflate, VIEW3D_MT_topoadapt)


def register():
    for kind in _CLASSES:
        bpy.utils.register_class(kind)
    bpy.types.VIEW3D_MT_object.append(_draw_menu)


def unregister():
    bpy.types.VIEW3D_MT_object.remove(_draw_menu)
    for kind in reversed(_CLASSES):
        bpy.utils.unregister_class(kind)

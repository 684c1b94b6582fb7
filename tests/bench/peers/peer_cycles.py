# SPDX-License-Identifier: Apache-2.0
"""Cycles, Blender's renderer, as a peer: the scenes of path_cases.py on all CPU cores, without
denoising, clamping and adaptive sampling. Its module `bpy` comes from PyPI."""
import math
import statistics
import time

from path_cases import ANGLE, BOUNCES, GREY, SIZE, SKY, SUN, SUN_WAY
from peer_mitsuba import colors_of


class CyclesScene:
    """A case in Cycles. Throws ImportError without it."""

    def __init__(self, np, case, folder):
        import bpy
        import mathutils
        self.bpy, self.math, self.np = bpy, mathutils, np
        self.image = folder / "cycles.exr"
        bpy.ops.wm.read_factory_settings(use_empty=True)
        self.scene = bpy.context.scene
        self._set_up()
        grey, own = self._matt(None), self._matt("paint")
        meshes = {name: self._mesh(name, mesh, grey if mesh.colors is None else own)
                  for name, mesh in case.meshes.items()}
        for number, (name, at) in enumerate(case.placed):
            self._add(f"object {number}", meshes[name]).location = at
        if case.floor:
            self._add_box(*case.floor, grey)
        self._light()
        self._look(case.place)
        self.loading = statistics.median(self._seconds_of_a_corner() for _ in range(5))

    def render(self, mi, samples, seed):
        """The picture, and the seconds that it took without loading the scene, which Cycles does
        for each."""
        self.scene.cycles.samples, self.scene.cycles.seed = samples, seed
        start = time.perf_counter()
        self.bpy.ops.render.render(write_still=True)
        seconds = time.perf_counter() - start
        return colors_of(mi, self.np, self.image), max(seconds - self.loading, 1e-3)

    def _seconds_of_a_corner(self):
        """How long a picture takes of which next to nothing is rendered."""
        render = self.scene.render
        render.use_border = True
        render.border_min_x = render.border_min_y = 0
        render.border_max_x, render.border_max_y = 2 / SIZE[0], 2 / SIZE[1]
        self.scene.cycles.samples = 1
        start = time.perf_counter()
        self.bpy.ops.render.render(write_still=True)
        seconds = time.perf_counter() - start
        render.use_border = False
        return seconds

    def _set_up(self):
        render, cycles = self.scene.render, self.scene.cycles
        render.engine = "CYCLES"
        render.resolution_x, render.resolution_y = SIZE
        render.resolution_percentage = 100
        render.filepath = str(self.image)
        render.image_settings.file_format = "OPEN_EXR"
        render.image_settings.color_depth = "32"
        cycles.device, cycles.pixel_filter_type = "CPU", "BOX"
        cycles.use_adaptive_sampling = cycles.use_denoising = False
        cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
        cycles.max_bounces = cycles.diffuse_bounces = BOUNCES
        cycles.light_sampling_threshold = 0

    def _matt(self, attribute):
        """A matt material, grey or in the colours of an attribute."""
        material = self.bpy.data.materials.new(attribute or "grey")
        material.use_nodes = True
        nodes, links = material.node_tree.nodes, material.node_tree.links
        nodes.clear()
        diffuse, out = nodes.new("ShaderNodeBsdfDiffuse"), nodes.new("ShaderNodeOutputMaterial")
        diffuse.inputs["Color"].default_value = [GREY] * 3 + [1]
        if attribute:
            color = nodes.new("ShaderNodeAttribute")
            color.attribute_name = attribute
            links.new(color.outputs["Color"], diffuse.inputs["Color"])
        links.new(diffuse.outputs["BSDF"], out.inputs["Surface"])
        return material

    def _mesh(self, name, mesh, material):
        np, data = self.np, self.bpy.data.meshes.new(name)
        count = len(mesh.triangles)
        data.vertices.add(len(mesh.points))
        data.vertices.foreach_set("co", mesh.points.astype(np.float32).ravel())
        data.loops.add(3 * count)
        data.loops.foreach_set("vertex_index", mesh.triangles.astype(np.int32).ravel())
        data.polygons.add(count)
        data.polygons.foreach_set("loop_start", np.arange(0, 3 * count, 3, dtype=np.int32))
        data.update(calc_edges=True)
        data.shade_flat()
        if mesh.colors is not None:
            colors = data.color_attributes.new("paint", "FLOAT_COLOR", "POINT")
            rows = np.hstack([mesh.colors, np.ones((len(mesh.colors), 1))]).astype(np.float32)
            colors.data.foreach_set("color", rows.ravel())
        data.materials.append(material)
        return data

    def _add(self, name, data):
        thing = self.bpy.data.objects.new(name, data)
        self.scene.collection.objects.link(thing)
        return thing

    def _add_box(self, middle, size, material):
        self.bpy.ops.mesh.primitive_cube_add(size=1, location=middle, scale=size)
        self.bpy.context.object.data.materials.append(material)

    def _light(self):
        world = self.bpy.data.worlds.new("sky")
        world.use_nodes = True
        world.node_tree.nodes["Background"].inputs["Color"].default_value = SKY + [1]
        self.scene.world = world
        sun = self.bpy.data.lights.new("sun", "SUN")
        sun.energy, sun.angle = max(SUN), 0
        sun.color = [c / max(SUN) for c in SUN]
        thing = self._add("sun", sun)
        thing.rotation_mode = "QUATERNION"
        thing.rotation_quaternion = self.math.Vector(SUN_WAY).to_track_quat("-Z", "Y")

    def _look(self, place):
        vector = self.math.Vector
        ahead = (vector(place.look_at) - vector(place.eye)).normalized()
        right = ahead.cross(vector([0, 1, 0])).normalized()
        camera = self.bpy.data.cameras.new("camera")
        camera.sensor_fit, camera.angle = "HORIZONTAL", math.radians(ANGLE)
        camera.clip_start, camera.clip_end = 1e-3 * place.length, 10 * place.length
        thing = self._add("camera", camera)
        turned = self.math.Matrix([right, right.cross(ahead), -ahead]).transposed().to_4x4()
        thing.matrix_world = self.math.Matrix.Translation(place.eye) @ turned
        self.scene.camera = thing

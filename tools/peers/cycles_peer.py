# SPDX-License-Identifier: MIT
"""Cycles, by Blender's Python module, set to take no short cuts: no clamping, no adaptive sampling, no smoothed glossy
bounces, no limit of depth, and the light tree."""

import math

import bpy
import numpy as np
import OpenEXR

import geometry
import images
from description import Image
from worker import Rendered

# Blender's z is up: (x, y, z) becomes (x, -z, y).
UP = np.array([[1, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, 0], [0, 0, 0, 1]], dtype=float)
NO_LIMIT = 1024
UNBIASED = {
    "use_adaptive_sampling": False,
    "use_denoising": False,
    "sample_clamp_direct": 0.0,
    "sample_clamp_indirect": 0.0,
    "light_sampling_threshold": 0.0,
    "blur_glossy": 0.0,
    "caustics_reflective": True,
    "caustics_refractive": True,
    "use_fast_gi": False,
    "use_light_tree": True,
    "max_bounces": NO_LIMIT,
    "diffuse_bounces": NO_LIMIT,
    "glossy_bounces": NO_LIMIT,
    "transmission_bounces": NO_LIMIT,
    "transparent_max_bounces": NO_LIMIT,
    "min_light_bounces": 0,
    "min_transparent_bounces": 0,
    "pixel_filter_type": "BOX",
    "filter_width": 1.0,
    "device": "CPU",
}


class Materials:
    """One for each pair of BSDF and radiance."""

    def __init__(self, directory):
        self.directory = directory
        self.made = {}

    def find(self, shape):
        values = shape.bsdf.parameters.values()
        key = repr((shape.bsdf.type, [v.name if isinstance(v, Image) else v for v in values], shape.radiance))
        if key not in self.made:
            self.made[key] = self.make(shape)
        return self.made[key]

    def make(self, shape):
        material = bpy.data.materials.new("material")
        material.use_nodes = True
        nodes, links = material.node_tree.nodes, material.node_tree.links
        nodes.clear()
        surface = self.emission(material, shape) if shape.radiance is not None else self.bsdf(nodes, links, shape.bsdf)
        links.new(surface.outputs[0], nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])
        return material

    def emission(self, material, shape):
        """From the front; black."""
        assert shape.bsdf.parameters["albedo"] == (0.0, 0.0, 0.0)
        nodes, links = material.node_tree.nodes, material.node_tree.links
        material.cycles.emission_sampling = "FRONT"
        node = nodes.new("ShaderNodeEmission")
        node.inputs["Color"].default_value = (*shape.radiance, 1.0)
        front = nodes.new("ShaderNodeMath")
        front.operation = "SUBTRACT"
        front.inputs[0].default_value = 1.0
        links.new(nodes.new("ShaderNodeNewGeometry").outputs["Backfacing"], front.inputs[1])
        links.new(front.outputs[0], node.inputs["Strength"])
        return node

    def bsdf(self, nodes, links, bsdf):
        p = bsdf.parameters
        if bsdf.type == "diffuse":
            node = nodes.new("ShaderNodeBsdfDiffuse")
            albedo = p["albedo"]
            if isinstance(albedo, Image):
                texture = nodes.new("ShaderNodeTexImage")
                texture.image = load_image(self.directory, albedo)
                links.new(texture.outputs["Color"], node.inputs["Color"])
            else:
                node.inputs["Color"].default_value = (*albedo, 1.0)
        elif bsdf.type == "dielectric":
            node = nodes.new("ShaderNodeBsdfGlass")
            node.inputs["Roughness"].default_value = 0.0
            node.inputs["IOR"].default_value = p["intIOR"] / p["extIOR"]
            node.inputs["Color"].default_value = (1.0, 1.0, 1.0, 1.0)
        else:
            assert bsdf.type == "mirror" or (bsdf.type == "roughconductor" and p["R0"] == (1.0, 1.0, 1.0))
            node = nodes.new("ShaderNodeBsdfAnisotropic")  # Blender's name for its glossy BSDF
            node.distribution = "BECKMANN"
            node.inputs["Roughness"].default_value = math.sqrt(p.get("alpha", 0.0))  # of which Blender takes the square
            node.inputs["Color"].default_value = (1.0, 1.0, 1.0, 1.0)
        return node


def load_image(directory, image):
    image = bpy.data.images.load(str(directory / (image.name + ".exr")), check_existing=True)
    image.colorspace_settings.name = "Non-Color"
    return image


def load_mesh(directory, mesh):
    bpy.ops.wm.obj_import(filepath=str(directory / (mesh.name + ".obj")), forward_axis="Y", up_axis="Z", validate_meshes=False)
    loaded = bpy.context.selected_objects[0]
    data = loaded.data
    bpy.data.objects.remove(loaded)
    data.materials.clear()
    data.materials.append(None)
    data.shade_flat()
    return data


def make_rectangle(shape):
    corners, uvs = geometry.rectangle(shape)
    data = bpy.data.meshes.new("rectangle")
    data.from_pydata(corners, [], [(0, 1, 2, 3)])
    data.uv_layers.new().data.foreach_set("uv", [x for uv in uvs for x in uv])
    data.materials.append(None)
    return data


class Peer:
    def __init__(self, scene, directory, settings):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        self.version = "Cycles of Blender " + bpy.app.version_string
        self.file = directory / "cycles.exr"
        self.bpy_scene = bpy.context.scene
        self.set_up(scene, settings["threads"])
        self.add_shapes(scene, directory)
        self.add_world(scene, directory)
        self.add_camera(scene.camera)

    def set_up(self, scene, threads):
        render = self.bpy_scene.render
        render.engine = "CYCLES"
        for name, value in UNBIASED.items():
            setattr(self.bpy_scene.cycles, name, value)
        render.threads_mode = "FIXED"
        render.threads = threads
        render.resolution_x, render.resolution_y = scene.camera.width, scene.camera.height
        render.resolution_percentage = 100
        render.use_compositing = False
        render.use_sequencer = False
        render.dither_intensity = 0.0
        image = render.image_settings
        image.file_format, image.color_mode, image.color_depth = "OPEN_EXR", "RGB", "32"

    def add_shapes(self, scene, directory):
        materials, meshes = Materials(directory), {}
        for shape in scene.shapes:
            if shape.kind == "mesh":
                if shape.mesh.name not in meshes:
                    meshes[shape.mesh.name] = load_mesh(directory, shape.mesh)
                data = meshes[shape.mesh.name]
            else:
                assert shape.kind == "rectangle", "Cycles has no spheres"
                data = make_rectangle(shape)
            placed = bpy.data.objects.new("shape", data)
            placed.matrix_world = (UP @ geometry.steps_matrix(shape.steps)).T.tolist()
            self.bpy_scene.collection.objects.link(placed)
            placed.material_slots[0].link = "OBJECT"
            placed.material_slots[0].material = materials.find(shape)

    def add_world(self, scene, directory):
        world = bpy.data.worlds.new("world")
        self.bpy_scene.world = world
        world.use_nodes = True
        nodes, links = world.node_tree.nodes, world.node_tree.links
        background = nodes["Background"]
        background.inputs["Color"].default_value = (0.0, 0.0, 0.0, 1.0)
        for light in scene.lights:
            assert light.kind == "environment" and light.color == (1.0, 1.0, 1.0)
            # Blender's middle column looks along x, Plumb's first one does.
            turn = nodes.new("ShaderNodeMapping")
            turn.inputs["Rotation"].default_value = (0.0, 0.0, math.pi)
            texture = nodes.new("ShaderNodeTexEnvironment")
            texture.image = load_image(directory, light.image)
            links.new(nodes.new("ShaderNodeTexCoord").outputs["Generated"], turn.inputs["Vector"])
            links.new(turn.outputs["Vector"], texture.inputs["Vector"])
            links.new(texture.outputs["Color"], background.inputs["Color"])

    def add_camera(self, camera):
        data = bpy.data.cameras.new("camera")
        data.sensor_fit = "HORIZONTAL"
        data.angle = math.radians(camera.fov)
        data.clip_start, data.clip_end = 1e-3, 1e4
        backwards = np.array(camera.origin) - np.array(camera.target)
        backwards /= np.linalg.norm(backwards)
        right = np.cross(camera.up, backwards)
        right /= np.linalg.norm(right)
        matrix = np.eye(4)
        matrix[:3, :] = np.stack([right, np.cross(backwards, right), backwards, camera.origin], axis=1)
        placed = bpy.data.objects.new("camera", data)
        placed.matrix_world = (UP @ matrix).T.tolist()
        self.bpy_scene.collection.objects.link(placed)
        self.bpy_scene.camera = placed

    def render(self, spp, seed):
        """Blender hands the scene to Cycles anew for each image, which is no part of the seconds."""
        self.bpy_scene.cycles.samples = spp
        self.bpy_scene.cycles.seed = seed
        bpy.ops.render.render()
        bpy.data.images["Render Result"].save_render(str(self.file), scene=self.bpy_scene)
        # To the hundredth: "00:03.28". Asking Blender to call us at each stage may end in a deadlock.
        parts = OpenEXR.File(str(self.file)).header()["cycles.ViewLayer.render_time"].split(":")
        seconds = sum(float(part) * 60**i for i, part in enumerate(reversed(parts)))
        return Rendered(lambda: images.read(self.file), max(seconds, 0.005))

# SPDX-License-Identifier: MIT
"""LuxCore's path tracer on the processor."""

import time

import numpy as np
import pyluxcore

import geometry
from description import Image
from worker import Rendered

NO_LIMIT = 1024
RENDERING = {
    "renderengine.type": "PATHCPU",
    "sampler.type": "SOBOL",
    "sampler.sobol.adaptive.strength": 0.0,
    "path.pathdepth.total": NO_LIMIT,
    "path.pathdepth.diffuse": NO_LIMIT,
    "path.pathdepth.glossy": NO_LIMIT,
    "path.pathdepth.specular": NO_LIMIT,
    "path.clamping.variance.maxvalue": 0.0,
    # Its default, 0.5, makes images brighter where paths are long: by 1.5 % in the room, as roulette switched off shows.
    "path.russianroulette.cap": 0.99,
    "path.hybridbackforward.enable": False,
    "film.filter.type": "BOX",
    "film.filter.width": 0.5,
    "film.imagepipelines.0.0.type": "NOP",
    "film.outputs.0.type": "RGB_IMAGEPIPELINE",
    "film.outputs.0.index": 0,
    "film.outputs.0.filename": "luxcore.exr",
    "scene.epsilon.min": 1e-5,
}


def properties(values):
    result = pyluxcore.Properties()
    for name, value in values.items():
        result.Set(pyluxcore.Property(name, list(value) if isinstance(value, tuple) else value))
    return result


def image(name, directory, image):
    """An image's file, as it is: no gamma."""
    return {f"{name}.file": str(directory / (image.name + ".exr")), f"{name}.gamma": 1.0}


def material(name, shape, directory):
    p = shape.bsdf.parameters
    if shape.radiance is not None:
        return {
            f"scene.materials.{name}.type": "matte",
            f"scene.materials.{name}.kd": (0.0, 0.0, 0.0),
            f"scene.materials.{name}.emission": shape.radiance,
        }
    if shape.bsdf.type == "diffuse":
        found = {f"scene.materials.{name}.type": "matte", f"scene.materials.{name}.kd": p["albedo"]}
        if isinstance(p["albedo"], Image):
            texture = f"scene.textures.{name}"
            found |= {f"{texture}.type": "imagemap", **image(texture, directory, p["albedo"])}
            # Row 0 is the top one.
            found |= {f"{texture}.mapping.type": "uvmapping2d", f"{texture}.mapping.uvscale": (1.0, -1.0)}
            found |= {f"{texture}.mapping.uvdelta": (0.0, 1.0)}
            found[f"scene.materials.{name}.kd"] = name
        return found
    white = (1.0, 1.0, 1.0)
    if shape.bsdf.type == "mirror":
        return {f"scene.materials.{name}.type": "mirror", f"scene.materials.{name}.kr": white}
    assert shape.bsdf.type == "dielectric"
    return {
        f"scene.materials.{name}.type": "glass",
        f"scene.materials.{name}.kr": white,
        f"scene.materials.{name}.kt": white,
        f"scene.materials.{name}.interiorior": p["intIOR"],
        f"scene.materials.{name}.exteriorior": p["extIOR"],
    }


class Peer:
    def __init__(self, scene, directory, settings):
        pyluxcore.Init(lambda message: None)
        self.version = "LuxCore " + pyluxcore.Version()
        self.size = (scene.camera.height, scene.camera.width)
        self.threads = settings["threads"]
        self.scene = pyluxcore.Scene()
        self.add_camera(scene.camera)
        meshes = set()
        for i, shape in enumerate(scene.shapes):
            self.add_shape(f"shape{i}", shape, directory, meshes)
        for light in scene.lights:
            assert light.kind == "environment" and light.color == (1.0, 1.0, 1.0)
            # The image's z is up, and it is seen from the other side: y and z change places.
            values = {"scene.lights.sky.type": "infinite", **image("scene.lights.sky", directory, light.image)}
            values["scene.lights.sky.transformation"] = np.eye(4)[[0, 2, 1, 3]].ravel().tolist()
            self.scene.Parse(properties(values))

    def add_camera(self, camera):
        tall, pixel = camera.height / camera.width, 2.0 / camera.width
        values = {
            "scene.camera.type": "perspective",
            "scene.camera.lookat.orig": camera.origin,
            "scene.camera.lookat.target": camera.target,
            "scene.camera.up": camera.up,
            "scene.camera.fieldofview": camera.fov,
            # Half the width is 1. LuxCore's images lie one row lower than those of others: the window is moved.
            "scene.camera.screenwindow": (-1.0, 1.0, -tall - pixel, tall - pixel),
            "scene.camera.lensradius": 0.0,
            "scene.camera.clipping.hither": 1e-3,
            "scene.camera.clipping.yon": 1e4,
            "scene.camera.autofocus.enable": False,
        }
        self.scene.Parse(properties(values))

    def add_shape(self, name, shape, directory, meshes):
        values = material(name, shape, directory)
        values[f"scene.objects.{name}.material"] = name
        if shape.kind == "mesh":
            if shape.mesh.name not in meshes:
                meshes.add(shape.mesh.name)
                ply = str(directory / (shape.mesh.name + ".ply"))
                loaded = {f"scene.shapes.{shape.mesh.name}.type": "mesh", f"scene.shapes.{shape.mesh.name}.ply": ply}
                self.scene.Parse(properties(loaded))
            values[f"scene.objects.{name}.shape"] = shape.mesh.name
            values[f"scene.objects.{name}.transformation"] = tuple(geometry.steps_matrix(shape.steps).T.ravel().tolist())
        else:
            assert shape.kind == "rectangle", "LuxCore has no spheres"
            corners, uvs = geometry.rectangle(shape)
            self.scene.DefineMesh(name, corners, [(0, 1, 2), (0, 2, 3)], None, uvs, None, None)
            values[f"scene.objects.{name}.shape"] = name
        self.scene.Parse(properties(values))

    def render(self, spp, seed):
        """Each image is a session, which builds its own tree: no part of the seconds."""
        height, width = self.size
        values = RENDERING | {
            "film.width": width,
            "film.height": height,
            "native.threads.count": self.threads,
            "renderengine.seed": seed,
            "batch.haltspp": spp,
        }
        session = pyluxcore.RenderSession(pyluxcore.RenderConfig(properties(values), self.scene))
        session.Start()
        start = time.perf_counter()
        while not session.HasDone():
            time.sleep(0.002)
            session.UpdateStats()
        seconds = time.perf_counter() - start
        session.Stop()
        film = np.empty((height, width, 3), dtype=np.float32)
        session.GetFilm().GetOutputFloat(pyluxcore.FilmOutputType.RGB_IMAGEPIPELINE, film, 0, True)
        return Rendered(lambda: film[::-1], seconds)

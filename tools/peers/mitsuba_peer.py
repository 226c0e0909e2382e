# SPDX-License-Identifier: MIT
"""Mitsuba 3, as tools/judge has it. Settings: variant, sampler, robust (intersections)."""

import time

import mitsuba as mi
import numpy as np

from worker import Rendered

# A wavefront holds all its paths in memory; more samples are taken in several, with seeds of their own.
LARGEST_WAVEFRONT = 1 << 24


class Peer:
    def __init__(self, scene, directory, settings):
        mi.set_variant(settings["variant"])
        import drjit
        import mitsuba_scene

        drjit.set_thread_count(settings["threads"])
        self.version = "Mitsuba " + mi.__version__
        if scene.shapes:
            self.scene = mitsuba_scene.build(scene, directory, settings["sampler"], settings.get("robust", False))
        else:  # a file of Mitsuba's own, which has the sampler 'independent'
            text = (directory / (scene.name + ".xml")).read_text()
            text = text.replace('sampler type="independent"', f'sampler type="{settings["sampler"]}"')
            if settings.get("robust"):
                text = text.replace("</scene>", '<boolean name="embree_use_robust_intersections" value="true"/>\n</scene>')
            file = directory / f"{scene.name}-{settings['sampler']}-{'robust' if settings.get('robust') else 'fast'}.xml"
            file.write_text(text)
            self.scene = mi.load_file(str(file))
        pixels = scene.camera.width * scene.camera.height
        self.most = 1 << ((LARGEST_WAVEFRONT // pixels).bit_length() - 1)
        self.compiled = set()  # numbers of samples
        if not settings["variant"].startswith("llvm"):
            self.most = 1 << 30

    def render(self, spp, seed):
        """Mitsuba may compile anew for another number of samples, which is no part of the seconds."""
        passes = -(-spp // self.most)
        if spp // passes not in self.compiled:
            np.array(mi.render(self.scene, spp=spp // passes, seed=0))
            self.compiled.add(spp // passes)
        image = 0.0
        start, cpu_start = time.perf_counter(), time.process_time()
        for i in range(passes):
            part = mi.render(self.scene, spp=spp // passes, seed=passes * seed + i)
            image = image + np.array(part, dtype=np.float64)[:, :, :3] / passes
        return Rendered(lambda: image, time.perf_counter() - start, time.process_time() - cpu_start)

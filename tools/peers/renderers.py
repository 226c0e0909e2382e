# SPDX-License-Identifier: MIT
"""Plumb and its peers, seen from the bench: each loads a scene and renders it with a number of samples and a seed."""

import json
import os
import resource
import statistics
import subprocess
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

import environment
import images

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
PLUMB = ROOT / "build" / "bench" / "renderer"


class Failed(Exception):
    """The renderer cannot do this scene; the message says why."""


@dataclass
class Run:
    image: object  # (height, width, 3)
    seconds: float  # of rendering alone
    cpu_seconds: float = None  # the same, of all threads
    rays_per_second: float = None  # where the renderer reports it
    rays_per_path: float = None


@dataclass
class Configuration:
    name: str  # as in the tables
    renderer: str  # "plumb", "mitsuba", "cycles", "luxcore"
    settings: dict = field(default_factory=dict)
    error_falls: float = None  # MSE ~ samples^-error_falls, where that is known: 1 for independent samples

    @property
    def is_plumb(self):
        return self.renderer == "plumb"


def plumb_samplers():
    """Of the bench, those that this build has."""
    listed = subprocess.run([PLUMB, "types"], capture_output=True, text=True, check=True).stdout.split()
    return [sampler for sampler in ("sobol", "independent") if sampler in listed]


def configurations(peers):
    """All that race, Plumb first."""
    found = [
        Configuration(f"Plumb path_mis, {sampler}", "plumb", {"integrator": "path_mis", "sampler": sampler},
                      1.0 if sampler == "independent" else None)  # fmt: skip
        for sampler in plumb_samplers()
    ]
    if "mitsuba" in peers:
        if environment.llvm_library():
            found.append(Configuration("Mitsuba llvm_ad_rgb", "mitsuba", {"variant": "llvm_ad_rgb", "sampler": "independent"}, 1.0))
            multijitter = {"variant": "llvm_ad_rgb", "sampler": "multijitter"}
            found.append(Configuration("Mitsuba llvm_ad_rgb, multijitter", "mitsuba", multijitter))
            found.append(Configuration("Mitsuba llvm_ad_rgb, multijitter, robust", "mitsuba", multijitter | {"robust": True}))
        found.append(Configuration("Mitsuba scalar_rgb", "mitsuba", {"variant": "scalar_rgb", "sampler": "independent"}, 1.0))
    if "cycles" in peers:
        found.append(Configuration("Cycles", "cycles"))
    if "luxcore" in peers:
        found.append(Configuration("LuxCore path", "luxcore"))
    return found


def children_cpu_seconds():
    """Of processes that have ended."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


class Plumb:
    """A process for each image."""

    def __init__(self, configuration, scene, directory, options):
        self.scene = directory / (scene.name + ".xml")
        self.file = directory / "plumb.exr"
        self.words = ["--sampler", configuration.settings["sampler"], "--threads", str(options.threads)]
        if scene.shapes:  # else its own: a file of Mitsuba's
            self.words += ["--integrator", configuration.settings["integrator"]]
        self.peak_memory = 0
        self.loads = []
        cpu_loads = []
        for _ in range(options.loads):
            start = time.perf_counter()
            report = self.run(1, 1)
            self.loads.append(time.perf_counter() - start - report["seconds"]["writing"])
            cpu_loads.append(report["cpu_seconds"])
        self.cpu_load = statistics.median(cpu_loads)  # of all but the rendering
        self.version = report["software"]

    def run(self, spp, seed):
        command = [PLUMB, self.scene, "-o", self.file, "--no-variance", "--json", "-", "--quiet", "--spp", spp, "--seed", seed]
        before = children_cpu_seconds()
        result = subprocess.run([*map(str, command), *self.words], capture_output=True, text=True, check=False)
        cpu_seconds = children_cpu_seconds() - before
        if result.returncode != 0:
            raise Failed(result.stderr.strip())
        report = json.loads(result.stdout)
        self.peak_memory = max(self.peak_memory, report["peak_memory_bytes"])
        return report | {"cpu_seconds": cpu_seconds}

    def render(self, spp, seed):
        report = self.run(spp, seed)
        paths = spp * report["resolution"][0] * report["resolution"][1]
        cpu_seconds = max(report["cpu_seconds"] - self.cpu_load, 0.001)
        return Run(images.read(self.file), report["seconds"]["rendering"], cpu_seconds, report["rays_per_second"],
                   report["rays"]["total"] / paths)  # fmt: skip

    def close(self):
        pass


class Worker:
    """A process that stays (worker.py), so that only the first image waits for loading."""

    def __init__(self, configuration, scene, directory, options):
        self.directory = directory
        self.log = directory / (configuration.name.replace(" ", "-").replace(",", "") + ".log")
        settings = {"scene": scene.name, "directory": str(directory), "width": scene.camera.width, "height": scene.camera.height,
                    "quick": options.quick, "threads": options.threads, **configuration.settings}  # fmt: skip
        self.command = [sys.executable, str(HERE / "worker.py"), configuration.renderer, json.dumps(settings)]
        self.loads = []
        self.peak_memory = 0
        for i in range(options.loads):
            if i > 0:
                self.close()
            start = time.perf_counter()
            self.start()
            self.version = self.answer()["version"]
            self.loads.append(time.perf_counter() - start)

    def start(self):
        environ = dict(os.environ)
        if environment.llvm_library():
            environ["DRJIT_LIBLLVM_PATH"] = environment.llvm_library()
        with open(self.log, "w") as log:
            self.process = subprocess.Popen(self.command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=log,
                                            text=True, bufsize=1, env=environ)  # fmt: skip

    def answer(self):
        line = self.process.stdout.readline()
        if not line:
            self.process.wait()
            lines = [line for line in self.log.read_text().splitlines() if line.strip()]
            raise Failed(f"ended with {self.process.returncode}: {lines[-1] if lines else ''}")
        return json.loads(line)

    def render(self, spp, seed):
        file = self.directory / "peer.npy"
        self.process.stdin.write(json.dumps({"spp": spp, "seed": seed, "file": str(file)}) + "\n")
        found = self.answer()
        self.peak_memory = max(self.peak_memory, found["peak_memory"])
        return Run(np.load(file).astype(np.float64), found["seconds"], found["cpu_seconds"])

    def close(self):
        self.process.stdin.close()
        self.process.wait()


def start(configuration, scene, directory, options):
    return (Plumb if configuration.is_plumb else Worker)(configuration, scene, directory, options)

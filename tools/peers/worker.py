# SPDX-License-Identifier: MIT
"""A peer in a process of its own: loads one scene once, then renders it as often as it is asked to.

    worker.py RENDERER SETTINGS

SETTINGS is JSON: scene, directory (its files), width, height, quick, threads, and the renderer's own. Requests are lines
of JSON, {"spp": N, "seed": N, "file": X.npy}; answers too: {"seconds": X, "cpu_seconds": X, "peak_memory": N}. The first answer, with the
renderer's version, comes when a first image of one sample per pixel is rendered.
"""

import importlib
import json
import os
import sys
import time
from dataclasses import dataclass
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent / "judge")]


@dataclass
class Rendered:
    image: object  # a function that fetches it
    seconds: float  # of rendering alone
    cpu_seconds: float = None  # of all threads; where the peer does not tell, those of the whole request


def answers():
    """Where answers go: standard output, which is from then on standard error, as renderers print there."""
    channel = os.fdopen(os.dup(1), "w", buffering=1)
    os.dup2(2, 1)
    return channel


def peak_memory():
    """Not getrusage(), which remembers what the process was before it became this one: as large as the bench."""
    status = Path("/proc/self/status").read_text()
    return 1024 * int(status.split("VmHWM:")[1].split()[0])


def main():
    channel = answers()
    renderer, settings = sys.argv[1], json.loads(sys.argv[2])

    import bench_scenes

    scene = bench_scenes.make(settings["scene"], settings["width"], settings["height"], settings["quick"]).scene
    peer = importlib.import_module(renderer + "_peer").Peer(scene, Path(settings["directory"]), settings)
    peer.render(1, 1)
    print(json.dumps({"version": peer.version}), file=channel)

    import numpy as np

    for line in sys.stdin:
        request = json.loads(line)
        start = time.process_time()
        rendered = peer.render(request["spp"], request["seed"])
        cpu_seconds = rendered.cpu_seconds or time.process_time() - start
        np.save(request["file"], np.asarray(rendered.image(), dtype=np.float32))
        print(json.dumps({"seconds": rendered.seconds, "cpu_seconds": cpu_seconds, "peak_memory": peak_memory()}), file=channel)


if __name__ == "__main__":
    main()

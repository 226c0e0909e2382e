# SPDX-License-Identifier: MIT
"""Races Plumb against its peers: see tools/bench. Runs in the peers' virtual environment."""

import argparse
import json
import os
import platform
import sys
import tempfile
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent / "judge")]

import bench_scenes  # noqa: E402
import environment  # noqa: E402
import measure  # noqa: E402
import renderers  # noqa: E402
import report  # noqa: E402

# What fills about 35 minutes on two cores, and less than three. An image of the race takes `shortest` seconds, doubled for
# each of the `doublings`; an image that converges is the mean of `replicates`, each of `longer` times as many samples.
FULL = {"width": 256, "height": 192, "shortest": 0.25, "rounds": 3, "doublings": 4, "replicates": 16, "longer": 4, "loads": 3}
QUICK = {"width": 96, "height": 72, "shortest": 0.05, "rounds": 1, "doublings": 2, "replicates": 16, "longer": 2, "loads": 1}


def processor():
    for line in Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return line.split(":")[1].strip()
    return platform.machine()


def main():
    parser = argparse.ArgumentParser(prog="tools/bench", description="races Plumb against its peers; see tools/bench --help")
    parser.add_argument("--out", metavar="DIRECTORY", default="bench")
    parser.add_argument("--scenes", metavar="NAME,...", default=",".join(bench_scenes.MAKERS))
    parser.add_argument("--peers", metavar="NAME,...", default=",".join(environment.PEERS))
    parser.add_argument("--threads", type=int, default=os.cpu_count())
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--venv", default=None)
    for name, value in FULL.items():
        parser.add_argument("--" + name, type=type(value), default=None)
    options = parser.parse_args()
    for name, value in (QUICK if options.quick else FULL).items():
        if getattr(options, name) is None:
            setattr(options, name, value)
    names, peers = options.scenes.split(","), options.peers.split(",")
    for what, given, known in (("scene", names, bench_scenes.MAKERS), ("peer", peers, environment.PEERS)):
        for name in given:
            if name not in known:
                parser.error(f"no {what} {name}; there are {', '.join(known)}")

    there = environment.installed(options.venv)
    for peer in peers:
        if peer not in there:
            measure.say(f"bench: {peer} is not installed and left out; tools/bench --install installs it")
    configurations = renderers.configurations([peer for peer in peers if peer in there])
    # One error in a hundred runs of the bench, not in a hundred comparisons.
    options.significance = 0.01 / (len(names) * max(len(configurations) - 1, 1))
    options.undecided_percent = 5.0  # of the pixels: caustics that need more samples than there is time for

    out = Path(options.out)
    out.mkdir(parents=True, exist_ok=True)
    start = time.time()
    found = {
        "date": time.strftime("%Y-%m-%d", time.gmtime()),
        "processor": processor(),
        "threads": options.threads,
        "size": [options.width, options.height],
        "rounds": options.rounds,
        "replicates": options.replicates,
        "falls": {one.name: one.error_falls for one in configurations},
        "scenes": {},
    }
    with tempfile.TemporaryDirectory(prefix="plumb-bench-") as temporary:
        for name in names:
            found["scenes"][name] = measure.measure(name, configurations, Path(temporary) / name, options)
            found["seconds"] = time.time() - start
            (out / "bench.json").write_text(json.dumps(found, indent=1) + "\n")
    report.write(found, out)


if __name__ == "__main__":
    main()

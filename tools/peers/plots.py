# SPDX-License-Identifier: MIT
"""RMSE against the time of rendering, one small plot a scene."""

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402

from estimates import Convergence  # noqa: E402


def write(found, path):
    plt.rcParams["svg.fonttype"] = "none"  # text stays text: a small file
    scenes = list(found["scenes"].values())
    columns = min(4, len(scenes) + 1)
    rows = -(-(len(scenes) + 1) // columns)
    figure, axes = plt.subplots(rows, columns, figsize=(3.3 * columns, 2.9 * rows), squeeze=False)
    places = axes.ravel()
    colors = {name: f"C{i}" for i, name in enumerate(found["falls"])}
    for place, scene in zip(places, scenes):
        for name, result in scene["configurations"].items():
            if not result.get("runs"):
                continue
            counts = result["agrees"]["outcome"] == "passes"
            curve = Convergence(result["runs"], "mse", found["falls"][name])
            place.loglog(curve.seconds, curve.errors**0.5, "o-" if counts else "x:", color=colors[name], markersize=3, linewidth=1)
        place.set_title(scene["what"], fontsize=8)
        place.minorticks_off()
        place.tick_params(labelsize=7)
        place.grid(True, linewidth=0.3)
        place.set_xlabel("seconds", fontsize=7)
        place.set_ylabel("RMSE", fontsize=7)
    for place in places[len(scenes) :]:
        place.axis("off")
    handles = [plt.Line2D([], [], color=color, marker="o", markersize=3, linewidth=1) for color in colors.values()]
    places[len(scenes)].legend(handles, colors, fontsize=7, loc="center", frameon=False)
    figure.tight_layout()
    figure.savefig(path, metadata={"Date": None})

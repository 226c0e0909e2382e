# SPDX-License-Identifier: MIT
"""What the race found, as tables and plots. The arithmetic is in estimates.py."""

import statistics

import plots
from estimates import ERRORS, Convergence


def agrees(result):
    return result.get("agrees", {}).get("outcome") == "passes"


def fits(found, scene, error):
    """A Convergence for each configuration that counts, by name."""
    return {
        name: Convergence(result["runs"], error, found["falls"][name])
        for name, result in scene["configurations"].items()
        if agrees(result) and result["runs"]
    }


def target(scene, curves):
    """The error to reach: that of the best peer with the middle number of its samples; and who it is.

    The best peer is the one that has the least error after as long as all of them were measured. Without peers, Plumb's
    own best.
    """
    peers = {name: curve for name, curve in curves.items() if scene["configurations"][name]["renderer"] != "plumb"} or curves
    common = min(float(curve.seconds[-1]) for curve in peers.values())
    best = min(peers, key=lambda name: peers[name].error_after(common))
    return best, peers[best].middle_error


def number(value):
    if value >= 100:
        return f"{value:.0f}"
    if value >= 10:
        return f"{value:.1f}"
    return f"{value:.2g}" if value < 0.1 else f"{value:.2f}"


def speed(scene, size, result):
    """Millions of camera paths and of rays a second, of paths a second of CPU time, and rays a path; of the runs with most
    samples."""
    most = max(run["spp"] for run in result["runs"])
    runs = [run for run in result["runs"] if run["spp"] == most]
    paths = size[0] * size[1] * most / 1e6

    def median(values):
        values = list(values)
        return number(statistics.median(values)) if values else "-"

    return (
        median(paths / run["seconds"] for run in runs),
        median(run["rays_per_second"] / 1e6 for run in runs if "rays_per_second" in run),
        median(paths / run["cpu_seconds"] for run in runs if "cpu_seconds" in run),
        median(run["rays_per_path"] for run in runs if "rays_per_path" in run),
    )


def verdict(result):
    found = result["agrees"]
    if found["with"] is None:
        return "itself"
    bias = found["detectable_bias"]
    if found["outcome"] == "passes":
        within = f", within {100 * bias:.2g} %" if bias else ""
        undecided = f", {100 * found['undecided'] / found['pixels']:.2g} % of pixels undecided" if found["undecided"] else ""
        return "yes" + within + undecided
    means = found["means"]
    away = f"{100 * (means[0] / means[1] - 1):+.2g} % in all, " if means[1] else ""
    if found["outcome"] == "differs":
        return f"no: {away}{100 * found['differing'] / found['pixels']:.2g} % of pixels"
    return f"undecided in {100 * found['undecided'] / found['pixels']:.2g} % of pixels"


def why_not(result):
    """In the summary, for one that does not count."""
    if "left_out" in result:
        return "left out"
    return {"differs": "differs", "undecided": "undecided"}[result["agrees"]["outcome"]]


def details(found, scene):
    """One row a configuration: loading, speed, memory, agreement, and the times to equal error."""
    curves = {error: fits(found, scene, error) for error in ERRORS}
    if not curves["mse"]:
        return "No renderer agrees with another.\n"
    best, targets = {}, {}
    for error in ERRORS:
        best[error], targets[error] = target(scene, curves[error])
    rmse = targets["mse"] ** 0.5
    lines = [
        f"Seconds to RMSE {rmse:.3g} ({100 * rmse / scene['reference_mean']:.2g} % of the mean), as {best['mse']} has it, "
        f"to relMSE {targets['relmse']:.2g}, as {best['relmse']} has it, and to trimmed RMSE {targets['trimmed'] ** 0.5:.3g} "
        f"(without the 2 % of pixels where the reference is noisiest), as {best['trimmed']} has it.",
        "",
        "| | load s | Mpaths/s | Mrays/s | Mpaths/CPU s | rays/path | MB | agrees | to RMSE s | and load | times best peer "
        "| to relMSE s | times best peer | to trimmed RMSE s | times best peer |",
        "|---" * 15 + "|",
    ]
    for name, result in scene["configurations"].items():
        if "left_out" in result:
            lines.append(f"| {name} | left out: {result['left_out']} " + "| " * 13 + "|")
            continue
        load = statistics.median(result["loads"])
        cells = [name, number(load), *speed(scene, found["size"], result), f"{result['peak_memory'] / 1e6:.0f}", verdict(result)]
        if agrees(result):
            for error in ERRORS:
                seconds = curves[error][name].seconds_to(targets[error])
                cells.append(number(seconds))
                if error == "mse":
                    cells.append(number(seconds + load))
                cells.append(number(curves[error][best[error]].seconds_to(targets[error]) / seconds))
        else:
            cells += ["-"] * 7
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"


def summary(found):
    """Seconds to equal RMSE, one row a scene; the last column tells how much sooner the best of Plumb's is there."""
    names = list(found["falls"])
    lines = ["| scene | " + " | ".join(names) + " | Plumb, times best peer |", "|---" * (len(names) + 2) + "|"]
    for scene in found["scenes"].values():
        curves = fits(found, scene, "mse")
        if not curves:
            continue
        best, mse = target(scene, curves)
        seconds = {name: curve.seconds_to(mse) for name, curve in curves.items()}
        ours = [seconds[name] for name in seconds if scene["configurations"][name]["renderer"] == "plumb"]
        cells = [number(seconds[name]) if name in seconds else why_not(scene["configurations"][name]) for name in names]
        ratio = number(seconds[best] / min(ours)) if ours and scene["configurations"][best]["renderer"] != "plumb" else "-"
        lines.append(f"| {scene['what']} | " + " | ".join(cells) + f" | {ratio} |")
    return "\n".join(lines) + "\n"


def text(found):
    width, height = found["size"]
    head = f"""Seconds to equal RMSE. {found["processor"]}, {found["threads"]} threads, {found["date"]}; {width}x{height} pixels, box filter, no
limit of depth; medians of {found["rounds"]} interleaved rounds. Loading, from the start of a process to a first image of one
sample per pixel, is not included. Versions: {", ".join(versions(found))}.

"""
    parts = [f"\n### {scene['what']}\n\n{details(found, scene)}" for scene in found["scenes"].values()]
    return head + summary(found) + "".join(parts)


def versions(found):
    seen = {}
    for scene in found["scenes"].values():
        for result in scene["configurations"].values():
            if "version" in result:
                seen.setdefault(result["renderer"], result["version"])
    return seen.values()


def write(found, out):
    (out / "table.md").write_text(text(found))
    plots.write(found, out / "convergence.svg")
    print(summary(found), end="")

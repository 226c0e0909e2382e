# SPDX-License-Identifier: MIT
"""One scene: loads it in all renderers, lets them converge, checks that they agree, and lets them race."""

import statistics
import sys

import numpy as np

import bench_scenes
import estimates
import geometry
import meshes
import images
import plumb_xml
import renderers


def say(text):
    print(text, file=sys.stderr, flush=True)


def write_scene(scene, directory):
    for mesh in {mesh.name: mesh for mesh in plumb_xml.meshes(scene)}.values():
        if mesh.positions is None:
            made = meshes.waves(mesh.name, int(mesh.name.split("-")[1]))
            mesh.positions, mesh.faces = made.positions, made.faces
        (directory / (mesh.name + ".obj")).write_text(plumb_xml.mesh_text(mesh))
        geometry.write_ply(directory / (mesh.name + ".ply"), mesh)
    for image in plumb_xml.images(scene):
        images.write(directory / (image.name + ".exr"), np.array(image.rows))
    (directory / (scene.name + ".xml")).write_text(plumb_xml.scene_text(scene))


def samples_for(racer, seconds):
    """The power of two of samples that takes about so long."""
    spp = 1
    while True:
        took = min(racer.render(spp, 1).seconds for _ in range(2))
        if took >= 0.7 * seconds or spp >= 1 << 16:
            return spp
        spp *= 2 if took > 0.2 * seconds else 4


def converge(racer, spp, replicates):
    return estimates.mean_and_variance([racer.render(spp, 1000 + i).image for i in range(replicates)])


def race(racers, results, reference, options):
    """Interleaved: in each round each renderer makes one image of each of its numbers of samples."""
    mean, variance = reference
    for number in range(options.rounds):
        for doubling in range(options.doublings):
            for name, racer in racers.items():
                spp = results[name]["base_spp"] << doubling
                seed = 100_000 + options.doublings * number + doubling
                run = racer.render(spp, seed)
                entry = {"round": number, "spp": spp, "seed": seed, "seconds": run.seconds, **estimates.errors(run.image, mean, variance)}
                for fact in ("cpu_seconds", "rays_per_second", "rays_per_path"):
                    if getattr(run, fact):
                        entry[fact] = getattr(run, fact)
                results[name]["runs"].append(entry)


def measure(name, configurations, directory, options):
    directory.mkdir()
    bench = bench_scenes.make(name, options.width, options.height, options.quick)
    scene = bench.scene
    say(f"{name}: writing")
    if bench.write:
        bench.write(directory, options.width, options.height, options.quick)
    else:
        write_scene(scene, directory)

    racers, results, converged = {}, {}, {}
    for configuration in configurations:
        result = results[configuration.name] = {"renderer": configuration.renderer, "runs": []}
        if configuration.renderer in bench.left_out:
            result["left_out"] = bench.left_out[configuration.renderer]
            continue
        try:
            racer = renderers.start(configuration, scene, directory, options)
            result |= {"version": racer.version, "loads": racer.loads, "base_spp": samples_for(racer, options.shortest)}
            racers[configuration.name] = racer
            converged[configuration.name] = converge(racer, options.longer * result["base_spp"], options.replicates)
            images.write(directory / (configuration.name + ".exr"), *converged[configuration.name], options.replicates)
        except renderers.Failed as failure:
            result["left_out"] = str(failure)
            racers.pop(configuration.name, None)
        say(f"{name}: {configuration.name}: " + (result.get("left_out") or
            f"loaded in {statistics.median(racer.loads):.2f} s, {result['base_spp']} spp in about {options.shortest} s"))  # fmt: skip

    first = next(iter(converged))
    for other in converged:
        if other == first:
            results[other]["agrees"] = {"outcome": "passes", "with": None}
            continue
        found = images.compare(renderers.PLUMB, directory / (other + ".exr"), directory / (first + ".exr"), options.significance,
                                 options.undecided_percent)  # fmt: skip
        results[other]["agrees"] = found | {"with": first}
        say(f"{name}: {other} and {first}: {found['outcome']}, p {found['p']:.3g}, "
            f"{found['differing']} of {found['pixels']} pixels differ, {found['undecided']} undecided, means {found['means']}")  # fmt: skip

    agreeing = [converged[other] for other in converged if results[other]["agrees"]["outcome"] == "passes"]
    reference = estimates.combine(agreeing)
    images.write(directory / "reference.exr", reference[0])
    race(racers, results, reference, options)
    for racer_name, racer in racers.items():
        results[racer_name]["peak_memory"] = racer.peak_memory
        racer.close()
    return {
        "what": scene.what,
        "reference_mean": float(reference[0].mean()),
        "reference_mse": float(reference[1].mean()),
        "configurations": results,
    }

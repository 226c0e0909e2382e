# SPDX-License-Identifier: MIT
"""The scenes of the independent judge. A new one is a line or a few here."""

from description import Camera, Checkerboard, Filter, Light, MitsubaFile, Scene, Shape
from objects import (
    GREY, MIRROR, PAINTING, ball, board, cube, dielectric, diffuse, dome, floor, frosted, gem, mesh_lamp, metal,
    microfacet, octahedron, painted_sky, panel, phong, point_light, rectangle_lamp, sheet, sky, sphere_lamp, substrate, sun,
)  # fmt: skip

SCENES = []


def add(name, what, shapes, lights=(), **more):
    SCENES.append(Scene(name, list(shapes), list(lights), what=what, **more))


# --- Diffuse: every light on every shape --------------------------------------------------------------------------

RED = diffuse(0.8, 0.2, 0.1)
add("diffuse-sphere-rectangle", "Diffuse sphere, rectangle lamp", [floor(), ball(RED), rectangle_lamp()])
add("diffuse-mesh-sphere", "Diffuse mesh, sphere lamp", [floor(), gem(RED), sphere_lamp()])
add("diffuse-rectangle-mesh", "Diffuse rectangle, mesh lamp", [floor(), board(RED), mesh_lamp()])
add("diffuse-sphere-point", "Diffuse sphere, point light", [floor(), ball(RED)], [point_light()])
add("diffuse-point-power", "Point light given by its power", [floor(), gem(RED)],
    [Light("point", (200.0, 300.0, 250.0), position=(-1.0, 3.0, 2.0), as_power=True)])
add("diffuse-mesh-sun", "Diffuse mesh, directional light", [floor(), gem(RED)], [sun()])
add("diffuse-sphere-sky", "Diffuse sphere under a uniform sky", [floor(), ball(RED)], [sky(0.6, 0.8, 1.0)])
add("diffuse-mesh-image", "Diffuse mesh under a painted sky", [floor(), gem(RED)], [painted_sky((1.0, 0.9, 0.8))])

# --- Smooth mirrors and glass -------------------------------------------------------------------------------------

add("mirror-sphere-image", "Mirror ball under a painted sky: its lookup", [floor(), ball(MIRROR)], [painted_sky()])
add("mirror-rectangle-lamp", "Mirror board, rectangle lamp", [floor(), board(MIRROR), rectangle_lamp()])
add("mirror-mesh-sphere", "Mirror mesh, sphere lamp", [floor(), gem(MIRROR), sphere_lamp()])
add("glass-sphere-image", "Glass ball under a painted sky", [floor(), ball(dielectric())], [painted_sky()],
    max_depth=8)
add("glass-sphere-lamp", "Glass ball and a large lamp: caustic",
    [floor(), ball(dielectric(1.7)), rectangle_lamp((3.0, 3.0, 3.0))], [sky(0.2, 0.2, 0.2)])
add("glass-mesh-diamond", "Faceted mesh of index 2.4", [floor(), gem(dielectric(2.4))], [sky(0.7, 0.9, 1.0)],
    max_depth=10)
add("glass-water", "Floor seen through the surface of water: radiance is scaled by the index, and back",
    [floor(), ball(RED, (0.0, 0.4, 0.0), 0.4),
     Shape("rectangle", dielectric(1.33), center=(0.0, 1.0, 0.0), width=9.0, height=8.0, normal=(0, 1, 0))],
    [sky(0.8, 0.9, 1.0)], max_depth=6)
add("glass-bubble", "Bubble of air: total reflection outside", [floor(), ball(dielectric(1.0, 1.33))],
    [painted_sky()], max_depth=6)
add("glass-lamp-inside", "Camera in air, diffuse and shining balls in glass",
    [floor(), ball(dielectric(1.5), (0.0, 1.3, 0.0), 1.3), ball(RED, (-0.4, 1.2, 0.0), 0.4),
     Shape("sphere", GREY, center=(0.6, 1.3, 0.0), radius=0.3, radiance=(4.0, 4.0, 3.0))],
    [sky(0.3, 0.3, 0.4)], max_depth=8)

# --- Rough plastic, metal and glass -------------------------------------------------------------------------------

add("plastic-sphere-rectangle", "Microfacet 0.1", [floor(), ball(microfacet(0.1, (0.2, 0.3, 0.6))), rectangle_lamp()])
add("plastic-mesh-sphere", "Microfacet 0.3", [floor(), gem(microfacet(0.3, (0.5, 0.1, 0.1), 1.8)), sphere_lamp()])
add("plastic-rectangle-point", "Microfacet 0.2", [floor(), board(microfacet(0.2, (0.1, 0.4, 0.2)))], [point_light()])
add("plastic-sphere-sky", "Microfacet 0.7 without a base", [floor(), ball(microfacet(0.7, (0.0, 0.0, 0.0), 1.5046, 1.000277))],
    [sky(1.0, 0.9, 0.8)])
add("plastic-floor-sun", "Microfacet 0.5 floor", [floor(microfacet(0.5, (0.3, 0.3, 0.3))), ball(RED)], [sun()])
add("plastic-mesh-lamp", "Microfacet 0.15, mesh lamp", [floor(), board(microfacet(0.15, (0.7, 0.6, 0.5), 2.2)), mesh_lamp()])

add("metal-sphere-rectangle", "Rough metal 0.1", [floor(), ball(metal(0.1)), rectangle_lamp()])
add("metal-mesh-sphere", "Rough metal 0.3", [floor(), gem(metal(0.3)), sphere_lamp()])
add("metal-rectangle-mesh", "Rough metal 0.2", [floor(), board(metal(0.2)), mesh_lamp()])
add("metal-sphere-point", "Rough metal 0.5", [floor(), ball(metal(0.5))], [point_light()])
add("metal-sphere-image", "Rough metal 1.0", [floor(), ball(metal(1.0))], [painted_sky()])
add("metal-floor-sun", "Rough metal 0.4 floor", [floor(metal(0.4)), gem(RED)], [sun((0.5, 1.0, -1.0))])

add("frosted-sphere-sky", "Rough glass 0.1", [floor(), ball(frosted(0.1))], [painted_sky()], max_depth=6)
add("frosted-sphere-rectangle", "Rough glass 0.3", [floor(), ball(frosted(0.3, 1.7)), rectangle_lamp()], max_depth=6)
add("frosted-mesh-sphere", "Rough glass 0.5, tinted", [floor(), gem(frosted(0.5, 1.5, 1.0, (0.9, 0.6, 0.3))), sphere_lamp()],
    max_depth=6)
add("frosted-pane", "Rough pane: one surface, refraction into the denser side, point light",
    [floor(), Shape("rectangle", frosted(0.2, 1.33), center=(0.0, 0.8, 0.0), width=9.0, height=8.0, normal=(0, 1, 0))],
    [point_light(), sky(0.3, 0.3, 0.3)], max_depth=4)
add("frosted-inside-out", "Rough glass whose inside is thinner", [floor(), ball(frosted(0.4, 1.0, 1.5))],
    [sky(0.9, 1.0, 0.8)], max_depth=5)
for name, side in (("frosted-backlit", 1.0), ("frosted-backlit-inside", -1.0)):
    add(name, "Rough pane before a point light and a lamp: refraction towards lights",
        [Shape("rectangle", frosted(0.3, 1.5), center=(0.0, 1.0, 0.0), width=6.0, height=4.5, normal=(0.1, 0.2, side)),
         Shape("sphere", GREY, center=(1.0, 1.5, -2.5), radius=0.6, radiance=(3.0, 6.0, 5.0))],
        [point_light((-0.8, 0.5, -1.5), (2.0, 1.5, 1.0))], max_depth=1)

# --- Models that are written as plugins for Mitsuba: on shapes, with all bounces -----------------------------------

GOLD = (1.0, 0.71, 0.29)
PLUGIN = "Mitsuba, plugin"
add("schlick-sphere-rectangle", "Metal 0.25 after Schlick", [floor(), ball(metal(0.25, GOLD)), rectangle_lamp()], judge=PLUGIN)
add("schlick-mesh-image", "Metal 0.4 after Schlick", [floor(), gem(metal(0.4, (0.1, 0.3, 0.6)))], [painted_sky()], judge=PLUGIN)
add("schlick-floor-point", "Metal 0.5 after Schlick", [floor(metal(0.5, GOLD)), ball(RED)], [point_light()], judge=PLUGIN)
add("substrate-sphere-rectangle", "Substrate 0.2", [floor(), ball(substrate(0.2, (0.5, 0.2, 0.1))), rectangle_lamp()], judge=PLUGIN)
add("substrate-mesh-sphere", "Substrate 0.4, index 1.9", [floor(), gem(substrate(0.4, (0.2, 0.2, 0.7), 1.9)), sphere_lamp()],
    judge=PLUGIN)
add("substrate-floor-sky", "Substrate 0.6", [floor(substrate(0.6, (0.6, 0.5, 0.4))), ball(RED)], [sky(1.0, 0.9, 0.8)], judge=PLUGIN)
add("phong-sphere-point", "Phong 20", [floor(), ball(phong((0.3, 0.1, 0.1), (0.4, 0.4, 0.4), 20))], [point_light()], judge=PLUGIN)
add("phong-mesh-lamp", "Phong 8", [floor(), gem(phong((0.1, 0.2, 0.1), (0.6, 0.5, 0.4), 8)), mesh_lamp()], judge=PLUGIN)
add("phong-board-image", "Phong 15, coefficients above 1 are scaled", [floor(), board(phong((0.5, 0.4, 0.3), (0.8, 0.8, 0.8), 15))],
    [painted_sky()], judge=PLUGIN)

# --- Lights together ----------------------------------------------------------------------------------------------

add("lights-many", "A lamp of each kind, of very different powers",
    [floor(), ball(RED), rectangle_lamp((1.0, 1.0, 1.0)), sphere_lamp((20.0, 5.0, 5.0)), mesh_lamp((0.5, 0.5, 2.0))],
    [point_light(intensity=(2.0, 1.0, 1.0)), sun(irradiance=(0.2, 0.5, 0.2)), sky(0.1, 0.1, 0.2)])
add("lights-glossy", "Two lamps of different sizes on a glossy floor",
    [floor(microfacet(0.1, (0.1, 0.1, 0.1))), sphere_lamp((3.0, 6.0, 3.0)), rectangle_lamp((5.0, 1.0, 1.0))],
    [painted_sky((0.1, 0.1, 0.1))])
add("lights-checkered", "A lamp with a checkered radiance",
    [floor(), ball(RED), rectangle_lamp(Checkerboard((8.0, 1.0, 1.0), (0.0, 4.0, 9.0), (0.25, 0.5), (0.4, 0.4)))])
add("lights-facing", "The camera looks at lamps from before and behind, and at a scaled one",
    [floor(), Shape("sphere", RED, center=(-1.0, 1.0, 0.0), radius=0.7, radiance=(0.5, 0.8, 0.2), radiance_scale=2.5),
     Shape("rectangle", RED, center=(1.0, 1.0, 0.0), width=1.2, height=1.2, normal=(0.3, 0.2, 1.0), radiance=(0.2, 0.6, 0.9)),
     Shape("rectangle", RED, center=(0.2, 0.8, 1.6), width=0.6, height=0.6, normal=(0.0, 0.0, -1.0), radiance=(2.0, 1.0, 1.0))])

# --- Textures -----------------------------------------------------------------------------------------------------

CHECKS = Checkerboard((0.9, 0.8, 0.7), (0.1, 0.2, 0.3), (0.125, 0.25), (0.4, 0.4))
add("texture-checkerboard", "Checkerboard on a rectangle", [floor(diffuse(CHECKS)), ball(RED)], [sky(1.0, 1.0, 1.0)])
add("texture-mesh", "Checkerboard on a mesh with its own coordinates",
    [floor(), Shape("mesh", diffuse(CHECKS), mesh=sheet())], [point_light()])
add("texture-image", "Image on a rectangle", [floor(), board(diffuse(PAINTING)), rectangle_lamp()])
add("texture-image-mesh", "Image on a mesh, repeated", [floor(), Shape("mesh", diffuse(PAINTING), mesh=sheet())],
    [sun((0.2, 1.0, 2.0))])
add("texture-roughness", "Metal with two roughnesses", [floor(), board(metal(Checkerboard(0.1, 0.6, (0.25, 0.25)))), mesh_lamp()])

# --- The camera and its filters -----------------------------------------------------------------------------------

FOCUS = [floor(diffuse(CHECKS)), ball(RED, (-1.0, 0.7, 1.0), 0.7), ball(diffuse(0.2, 0.5, 0.8), (1.0, 0.7, -1.5), 0.7)]
add("lens-near", "Depth of field, sharp near", FOCUS, [sun()],
    camera=Camera(lens_radius=0.25, focal_distance=4.0))
add("lens-far", "Depth of field, sharp far, 36 x 24 pixels", FOCUS, [sky(1.0, 1.0, 1.0)],
    camera=Camera(width=36, height=24, lens_radius=0.15, focal_distance=7.0), max_depth=2)
add("lens-bokeh", "Small lamps far out of focus: the shape of the lens",
    [Shape("sphere", GREY, radius=0.9, radiance=(9.0, 6.0, 3.0)),
     Shape("sphere", GREY, center=(2.4, 1.0, -3.0), radius=1.0, radiance=(1.0, 4.0, 9.0))],
    camera=Camera(origin=(0.4, 0.2, 8.0), target=(0.4, 0.2, 0.0), lens_radius=0.6, focal_distance=2.0), max_depth=0)
add("lens-wide", "Lamps in focus, wide view, large lens: what is sharp is a plane",
    [Shape("rectangle", GREY, center=(x, y, 0.0), width=0.7, height=0.7, radiance=(4.0, 5.0, 6.0))
     for x, y in ((-3.0, 2.0), (3.0, -2.0), (3.0, 2.0), (-1.0, 0.0))],
    camera=Camera(origin=(0.0, 0.0, 4.0), target=(0.0, 0.0, 0.0), fov=90.0, lens_radius=2.0, focal_distance=4.0), max_depth=0)
add("camera-tilted", "Tilted camera, narrow view, 18 x 24 pixels", FOCUS, [point_light()],
    camera=Camera(origin=(3.0, 3.0, 3.5), up=(0.4, 1.0, 0.2), fov=30.0, width=18, height=24))
for kind, more in (
    ("tent", {"radius": 1.0}),
    ("gaussian", {"radius": 2.0, "stddev": 0.5}),
    ("mitchell", {"radius": 2.0, "b": 1 / 3, "c": 1 / 3}),
):
    add("filter-" + kind, f"Filter {kind}, radius {more['radius']}", FOCUS, [point_light()],
        filter=Filter(kind, **more), max_depth=1)
add("filter-mitchell-sharp", "Filter mitchell with B = 0, C = 1/2 before a bright edge",
    [floor(), ball(RED), sphere_lamp((3.0, 3.0, 3.0))], filter=Filter("mitchell", 2.0, b=0.0, c=0.5), max_depth=1)

# --- Transforms ---------------------------------------------------------------------------------------------------

add("transform-mesh", "Meshes scaled unevenly, turned about an axis that is no unit vector, mirrored twice",
    [floor(), Shape("mesh", RED, mesh=cube(), steps=[("scale", (-0.5, 0.9, -0.3)), ("rotate", (1, 1, 0.5), 40.0),
                                                    ("translate", (-0.6, 1.0, 0.0))]),
     Shape("mesh", diffuse(0.2, 0.6, 0.3), mesh=cube(), steps=[("rotate", (0, 0, 1), 30.0), ("scale", (0.4, 0.7, 0.5)),
                                                              ("translate", (1.0, 0.8, 0.2))])],
    [sun(), sky(0.2, 0.2, 0.2)])
add("transform-sphere", "Sphere moved and scaled by its transform, a rectangle turned",
    [floor(), Shape("sphere", RED, center=(0.5, 0.0, 0.0), radius=0.5, steps=[("scale", (1.6, 1.6, 1.6)),
                                                                             ("translate", (-0.5, 0.9, 0.0))]),
     Shape("rectangle", diffuse(PAINTING), width=1.5, height=1.0, steps=[("rotate", (0, 1, 0), -40.0),
                                                                        ("translate", (-1.3, 0.8, -0.5))])],
    [point_light(), sky(0.2, 0.2, 0.2)])
add("transform-lamp", "Lamps that are scaled and mirrored",
    [floor(), ball(RED),
     Shape("mesh", GREY, mesh=panel(), steps=[("scale", (0.5, 1.0, 2.0)), ("rotate", (0, 0, 1), 50.0),
                                             ("translate", (-1.9, 2.5, 0.5))], radiance=(6.0, 4.0, 4.0)),
     Shape("sphere", GREY, radius=0.5, steps=[("scale", (0.7, 0.7, 0.7)), ("translate", (1.9, 2.6, 0.6))],
           radiance=(5.0, 9.0, 9.0))])
add("normals-dome", "Mesh with smooth normals, lit from the front",
    [floor(), Shape("mesh", RED, mesh=dome(), steps=[("translate", (0.0, -0.4, 0.0))])], [sun((0.3, 3.0, 1.0))], max_depth=1)
add("normals-stretched", "Mesh with smooth normals, stretched unevenly",
    [floor(), Shape("mesh", RED, mesh=dome(), steps=[("scale", (1.1, 0.6, 1.5)), ("rotate", (0, 0, 1), 20.0),
                                                    ("translate", (0.0, 0.2, 0.0))])], [sun((0.3, 3.0, 1.0))], max_depth=1)
add("normals-mirrored", "Mesh with smooth normals, mirrored",
    [floor(), Shape("mesh", RED, mesh=dome(), steps=[("scale", (-1.0, 0.8, 1.2)), ("rotate", (0, 0, 1), -20.0),
                                                    ("translate", (0.0, 0.0, 0.0))])], [sun((0.3, 3.0, 1.0))], max_depth=1)
add("mirrored-mesh", "Without normals, a mirror turns meshes inside out: a black octahedron, a lamp that shines to its other side",
    [floor(),
     Shape("mesh", RED, mesh=octahedron(), steps=[("scale", (1.0, -1.0, 1.0)), ("translate", (0.8, 1.0, 0.0))]),
     Shape("mesh", GREY, mesh=panel(), steps=[("scale", (-1.0, 1.0, 1.0)), ("rotate", (0, 0, 1), 200.0),
                                             ("translate", (-0.5, 3.2, 0.5))], radiance=(6.0, 6.0, 8.0))])

# --- Depths -------------------------------------------------------------------------------------------------------


def room():
    """A box with a lamp ball, lit from all sides by its walls."""
    walls = [((0, 1, 0), (0.7, 0.7, 0.7)), ((0, -1, 0), (0.7, 0.7, 0.7)), ((0, 0, 1), (0.7, 0.7, 0.7)),
             ((1, 0, 0), (0.7, 0.2, 0.1)), ((-1, 0, 0), (0.1, 0.3, 0.7))]  # fmt: skip
    result = [
        Shape("rectangle", diffuse(*color), center=tuple(1.5 - 1.5 * x if i == 1 else -1.5 * x for i, x in enumerate(n)),
              width=3.0, height=3.0, normal=n)
        for n, color in walls
    ]  # fmt: skip
    lamp = Shape("sphere", GREY, center=(0.2, 2.2, 0.0), radius=0.35, radiance=(6.0, 5.5, 5.0))
    return [*result, lamp, ball(metal(0.3), (-0.6, 0.6, -0.3), 0.6), ball(dielectric(), (0.7, 0.5, 0.3), 0.5)]


ROOM_CAMERA = Camera(origin=(0.0, 1.5, 5.2), target=(0.0, 1.5, 0.0), fov=42.0)
for depth in (0, 1, 2, 4, -1):
    name = "all" if depth < 0 else str(depth)
    add("room-depth-" + name, f"Room, largest depth {depth}", room(), camera=ROOM_CAMERA, max_depth=depth)
add("room-white", "Room of albedo 0.9: long paths, roulette",
    [*(Shape("rectangle", diffuse(0.9, 0.9, 0.85), center=tuple(1.5 - 1.5 * x if i == 1 else -1.5 * x for i, x in enumerate(n)),
             width=3.0, height=3.0, normal=n) for n in ((0, 1, 0), (0, -1, 0), (0, 0, 1), (1, 0, 0), (-1, 0, 0), (0, 0, -1))),
     Shape("sphere", GREY, center=(0.0, 1.5, 0.0), radius=0.4, radiance=(1.0, 1.0, 1.0))],
    camera=Camera(origin=(0.8, 0.7, 1.4), target=(-0.3, 1.4, -0.5), fov=70.0), max_depth=-1)

# --- Models that Mitsuba has not: direct light on a board that fills the image, by quadrature -------------------

ABOVE = Camera(origin=(0.5, 2.0, 2.2), target=(0.0, 0.0, 0.0), fov=35.0)
LOW = Camera(origin=(0.0, 0.7, 3.0), target=(0.0, 0.0, 0.2), fov=25.0)
PLANE_POINT = [point_light((-0.6, 1.4, -1.5), (9.0, 10.0, 8.0))]
PLANE_PANEL = Shape("rectangle", GREY, center=(-0.3, 1.5, -1.6), width=1.2, height=0.8, normal=(0.1, -1.0, 0.9),
                    radiance=(4.0, 5.0, 6.0))  # fmt: skip
PLANE_BALL = Shape("sphere", GREY, center=(-0.2, 1.6, -1.5), radius=0.5, radiance=(5.0, 4.0, 6.0))


def judged_by_quadrature(name, what, bsdf, lamp, camera=ABOVE, **more):
    plane = Shape("rectangle", bsdf, width=60.0, height=60.0, normal=(0, 1, 0))
    shapes, lights = ([plane], [lamp]) if isinstance(lamp, Light) else ([plane, lamp], [])
    add(name, what, shapes, lights, camera=camera, max_depth=1, judge="quadrature", **more)


QUADRATURE = [
    ("schlick-point", "Metal 0.3 after Schlick, point light", metal(0.3, GOLD), PLANE_POINT[0], ABOVE),
    ("schlick-panel", "Metal 0.15 after Schlick, rectangle lamp", metal(0.15, (0.2, 0.5, 0.9)), PLANE_PANEL, ABOVE),
    ("schlick-ball", "Metal 0.5 after Schlick, grazing, sphere lamp", metal(0.5, (0.04, 0.3, 0.6)), PLANE_BALL, LOW),
    ("substrate-point", "Substrate 0.2, point light", substrate(0.2, (0.5, 0.3, 0.1)), PLANE_POINT[0], ABOVE),
    ("substrate-panel", "Substrate 0.3, rectangle lamp, index 2", substrate(0.3, (0.2, 0.4, 0.7), 2.0), PLANE_PANEL, ABOVE),
    ("substrate-ball", "Substrate 0.1, grazing, sphere lamp", substrate(0.1, (0.6, 0.6, 0.6)), PLANE_BALL, LOW),
    ("phong-point", "Phong 20, point light", phong((0.2, 0.1, 0.3), (0.5, 0.6, 0.4), 20), PLANE_POINT[0], ABOVE),
    ("phong-panel", "Phong 60, coefficients above 1 are scaled", phong((0.4, 0.5, 0.6), (0.7, 0.7, 0.7), 60), PLANE_PANEL, ABOVE),
    ("phong-ball", "Phong 5, grazing, sphere lamp", phong((0.1, 0.1, 0.1), (0.8, 0.5, 0.3), 5), PLANE_BALL, LOW),
    ("diffuse-quadrature", "Diffuse, rectangle lamp: the quadrature itself, and the light", RED, PLANE_PANEL, ABOVE),
    ("plastic-quadrature", "Microfacet 0.25, sphere lamp", microfacet(0.25, (0.2, 0.2, 0.4)), PLANE_BALL, ABOVE),
]
for row in QUADRATURE:
    judged_by_quadrature(*row)
judged_by_quadrature("sun-quadrature", "Metal 0.4 after Schlick, directional light", metal(0.4, GOLD),
                     sun((-0.4, 1.0, -1.0)), ABOVE)
judged_by_quadrature("mitchell-quadrature", "Phong 100 through the Mitchell filter",
                     phong((0.1, 0.1, 0.1), (0.8, 0.8, 0.8), 100), PLANE_POINT[0], ABOVE,
                     filter=Filter("mitchell", 2.0, b=1 / 3, c=1 / 3))
judged_by_quadrature("gaussian-quadrature", "Phong 100 through a Gaussian cut off at 1.5 deviations",
                     phong((0.1, 0.1, 0.1), (0.8, 0.8, 0.8), 100), PLANE_POINT[0], ABOVE,
                     filter=Filter("gaussian", 1.2, stddev=0.8))
judged_by_quadrature("box-quadrature", "Phong 30 through a wide box",
                     phong((0.1, 0.1, 0.1), (0.8, 0.8, 0.8), 30), PLANE_POINT[0], ABOVE, filter=Filter("box", 1.5))

# --- Files of Mitsuba ---------------------------------------------------------------------------------------------

SCENES += [
    MitsubaFile("file-blender", "As the add-on mitsuba-blender writes scenes: named references, painted vertices"),
    MitsubaFile("file-metals", "Metals by name and by index, anisotropic GGX, rough plastic"),
    MitsubaFile("file-principled", "Disney's BSDF in a turned environment map"),
    MitsubaFile("file-sheets", "Mask with a checkerboard, thin glass, a blend, nothing"),
    MitsubaFile("file-bent", "A bump map, a bent normal; a point and a spot light"),
    MitsubaFile("file-instances", "Cylinder, disk and cube in a group, and two instances of it"),
    MitsubaFile("file-lights", "A slide in a spot, a projector, a textured lamp"),
    MitsubaFile("file-lens", "A thin lens and a crop window; spectra; nearest texels"),
]

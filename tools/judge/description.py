# SPDX-License-Identifier: MIT
"""The words in which scenes.py describes a scene.

A description belongs to no renderer: plumb_xml.py writes it as a scene file, mitsuba_scene.py as a Mitsuba 3
dictionary, and quadrature.py integrates it. Conventions: y is up, angles are in degrees, colours are linear RGB, a
transform is a list of steps in the order of their application, rows of an image run from the top down.
"""

from dataclasses import dataclass, field


@dataclass
class Color:
    """A uniform texture."""

    value: tuple


@dataclass
class Checkerboard:
    """first where floor(u / su - du) + floor(v / sv - dv) is even, else second."""

    first: tuple  # a colour, or a number
    second: tuple
    scale: tuple = (0.5, 0.5)
    delta: tuple = (0.0, 0.0)


@dataclass
class Image:
    """rows[0] is the top row; bilinear between pixels' middles, repeated; (0, 0) is the lower left corner."""

    name: str
    rows: list


@dataclass
class Bsdf:
    type: str  # Plumb's name
    parameters: dict = field(default_factory=dict)  # Plumb's names; numbers, colours (tuples) or textures


@dataclass
class Mesh:
    name: str
    positions: list
    faces: list  # of corners, counted from 0
    normals: list = None  # one for each position
    uvs: list = None


@dataclass
class Shape:
    kind: str  # "mesh", "sphere" or "rectangle"
    bsdf: Bsdf
    mesh: Mesh = None
    center: tuple = (0, 0, 0)
    radius: float = 1.0
    width: float = 1.0
    height: float = 1.0
    normal: tuple = (0, 0, 1)
    steps: list = field(default_factory=list)  # ("translate", v), ("scale", v), ("rotate", axis, angle)
    radiance: object = None  # it shines: a colour or a texture
    radiance_scale: float = 1.0


@dataclass
class Light:
    kind: str  # "point", "directional", "environment"
    color: tuple = (1, 1, 1)  # intensity, irradiance, factor of the image
    position: tuple = None
    towards: tuple = None  # from the scene to a directional light
    image: Image = None  # equirectangular
    as_power: bool = False  # color is the power of a point light


@dataclass
class Camera:
    origin: tuple = (0.0, 2.2, 5.0)
    target: tuple = (0.0, 0.7, 0.0)
    up: tuple = (0, 1, 0)
    fov: float = 42.0  # horizontal
    width: int = 24
    height: int = 18
    lens_radius: float = 0.0
    focal_distance: float = 1.0


@dataclass
class Filter:
    kind: str = "box"
    radius: float = 0.5
    stddev: float = None  # gaussian
    b: float = None  # mitchell
    c: float = None


@dataclass
class Scene:
    name: str
    shapes: list
    lights: list = field(default_factory=list)
    camera: Camera = field(default_factory=Camera)
    filter: Filter = field(default_factory=Filter)
    max_depth: int = 5  # surface bounces; -1: no limit
    judge: str = "Mitsuba"  # or "quadrature"
    what: str = ""  # what it is there for


@dataclass
class MitsubaFile:
    """A scene of Mitsuba's own language, kept by hand in tests/scenes/independent: both renderers read the same file."""

    name: str  # without .xml
    what: str
    judge: str = "Mitsuba, the same file"

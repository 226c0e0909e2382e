# SPDX-License-Identifier: MIT
"""Direct light on a horizontal plane through the origin by Gauss-Legendre quadrature, in double precision.

For the models that Mitsuba has not. Written from the papers, not from Plumb's sources:
[1] Walter, Marschner, Li and Torrance 2007, "Microfacet Models for Refraction through Rough Surfaces".
[2] Schlick 1994, "An Inexpensive BRDF Model for Physically-based Rendering".
[3] Ashikhmin and Shirley 2000, "An Anisotropic Phong BRDF Model".
[4] Lafortune and Willems 1994, "Using the Modified Phong Reflectance Model for Physically Based Rendering".
[5] Mitchell and Netravali 1988, "Reconstruction Filters in Computer Graphics".
"""

import numpy as np

NORMAL = np.array([0.0, 1.0, 0.0])


def unit(v):
    return v / np.linalg.norm(v, axis=-1, keepdims=True)


def legendre(low, high, count):
    x, w = np.polynomial.legendre.leggauss(count)
    return 0.5 * (high - low) * x + 0.5 * (high + low), 0.5 * (high - low) * w


# --- Reflectance: value(wi, wo) without the cosine, directions in world space, shape (..., 3) ----------------------


def exact_fresnel(cos_i, eta):
    """Unpolarised; eta is the index inside over that outside, cos_i > 0."""
    sin_t_squared = (1.0 - cos_i**2) / eta**2
    cos_t = np.sqrt(np.maximum(1.0 - sin_t_squared, 0.0))
    s = (cos_i - eta * cos_t) / (cos_i + eta * cos_t)
    p = (eta * cos_i - cos_t) / (eta * cos_i + cos_t)
    return np.where(sin_t_squared >= 1.0, 1.0, 0.5 * (s**2 + p**2))


def beckmann(wi, wo, alpha):
    """D G / (4 cos_i cos_o), and the cosine with the half vector: [1], equations 20, 25 and 27."""
    h = unit(wi + wo)
    cos_h, cos_i, cos_o = h[..., 1], wi[..., 1], wo[..., 1]
    tan_squared = 1.0 / cos_h**2 - 1.0
    d = np.exp(-tan_squared / alpha**2) / (np.pi * alpha**2 * cos_h**4)

    def g1(cos_v):
        a = 1.0 / (alpha * np.sqrt(np.maximum(1.0 / cos_v**2 - 1.0, 1e-300)))
        return np.where(a < 1.6, (3.535 * a + 2.181 * a**2) / (1.0 + 2.276 * a + 2.577 * a**2), 1.0)

    cosine = np.sum(wi * h, axis=-1)
    return d * g1(cos_i) * g1(cos_o) / (4.0 * cos_i * cos_o), cosine


def reflectance(bsdf):
    p = bsdf.parameters
    eta = p.get("intIOR", 1.5046) / p.get("extIOR", 1.000277)

    def array(name):
        return np.array(p[name], dtype=float)

    def diffuse(wi, wo):
        return array("albedo") / np.pi

    def microfacet(wi, wo):
        kd = array("kd")
        facets, cosine = beckmann(wi, wo, p["alpha"])
        return kd / np.pi + ((1.0 - kd.max()) * facets * exact_fresnel(cosine, eta))[..., None]

    def roughconductor(wi, wo):
        facets, cosine = beckmann(wi, wo, p["alpha"])
        r0 = array("R0")
        fresnel = r0 + (1.0 - r0) * ((1.0 - cosine) ** 5)[..., None]  # [2], equation 15
        return facets[..., None] * fresnel

    def roughsubstrate(wi, wo):
        facets, cosine = beckmann(wi, wo, p["alpha"])
        r0 = ((p["extIOR"] - p["intIOR"]) / (p["extIOR"] + p["intIOR"])) ** 2
        passes = (1.0 - (1.0 - wi[..., 1] / 2.0) ** 5) * (1.0 - (1.0 - wo[..., 1] / 2.0) ** 5)
        base = 28.0 / (23.0 * np.pi) * (1.0 - r0) * passes  # [3], equation 5
        return base[..., None] * array("kd") + (facets * exact_fresnel(cosine, eta))[..., None]

    def phong(wi, wo):
        kd, ks, n = array("diffuse-coefficients"), array("specular-coefficients"), p["exponent"]
        largest = (kd + ks).max()
        if largest > 1.0:
            kd, ks = kd * (0.99 / largest), ks * (0.99 / largest)
        mirrored = 2.0 * wo[..., 1:2] * NORMAL - wo
        cosine = np.maximum(np.sum(wi * mirrored, axis=-1), 0.0)
        return kd / np.pi + ks * ((n + 2.0) / (2.0 * np.pi) * cosine**n)[..., None]  # [4], equation 13

    known = {f.__name__: f for f in (diffuse, microfacet, roughconductor, roughsubstrate, phong)}
    return known[bsdf.type]


# --- Light that leaves a point of the plane -----------------------------------------------------------------------


def shaded(f, wi, wo, radiance):
    """f cos L; nothing from below the plane."""
    cosine = wo[..., 1]
    above = cosine > 0.0
    safe = np.where(above[..., None], wo, NORMAL)
    return np.where(above[..., None], f(wi, safe) * cosine[..., None] * radiance, 0.0)


def from_rectangle(f, points, wi, lamp, order):
    normal = unit(np.array(lamp.normal, dtype=float))
    along = unit(np.array([1.0, 0.0, 0.0]) - normal * normal[0])
    across = np.cross(normal, along)
    x, wx = legendre(-lamp.width / 2, lamp.width / 2, order)
    y, wy = legendre(-lamp.height / 2, lamp.height / 2, order)
    result = np.zeros_like(points)
    for xi, wxi in zip(x, wx):
        for yi, wyi in zip(y, wy):
            to_lamp = np.array(lamp.center) + xi * along + yi * across - points
            squared = np.sum(to_lamp**2, axis=-1, keepdims=True)
            wo = to_lamp / np.sqrt(squared)
            facing = np.maximum(-np.sum(wo * normal, axis=-1, keepdims=True), 0.0)
            result += wxi * wyi * shaded(f, wi, wo, np.array(lamp.radiance)) * facing / squared
    return result


def from_sphere(f, points, wi, lamp, order):
    """Over the cone that the sphere fills, in cosine and azimuth about its axis."""
    to_center = np.array(lamp.center) - points
    distance = np.linalg.norm(to_center, axis=-1)
    axis = to_center / distance[..., None]
    side = unit(np.cross(axis, np.array([0.123, 0.456, 0.789])))
    up = np.cross(axis, side)
    lowest = np.sqrt(1.0 - (lamp.radius / distance) ** 2)
    t, wt = legendre(0.0, 1.0, order)
    turns = 2 * order
    result = np.zeros_like(points)
    for ti, wti in zip(t, wt):
        cosine = lowest + (1.0 - lowest) * ti
        sine = np.sqrt(1.0 - cosine**2)
        for k in range(turns):  # periodic: the midpoint rule is exact to all orders
            phi = 2.0 * np.pi * (k + 0.5) / turns
            wo = cosine[..., None] * axis + sine[..., None] * (np.cos(phi) * side + np.sin(phi) * up)
            weight = wti * (1.0 - lowest) * 2.0 * np.pi / turns
            result += weight[..., None] * shaded(f, wi, wo, np.array(lamp.radiance))
    return result


def from_delta(f, points, wi, light):
    color = np.array(light.color)
    if light.kind == "directional":
        wo = np.broadcast_to(unit(np.array(light.towards, dtype=float)), points.shape)
        return shaded(f, wi, wo, color)
    to_light = np.array(light.position) - points
    squared = np.sum(to_light**2, axis=-1, keepdims=True)
    return shaded(f, wi, to_light / np.sqrt(squared), color / squared)


# --- The camera ---------------------------------------------------------------------------------------------------


def camera_rays(camera, x, y):
    """Directions through raster positions, x to the right and y down, in pixels."""
    forward = unit(np.array(camera.target, dtype=float) - np.array(camera.origin, dtype=float))
    left = unit(np.cross(np.array(camera.up, dtype=float), forward))
    up = np.cross(forward, left)
    extent = np.tan(np.radians(camera.fov) / 2.0)
    sx = (1.0 - 2.0 * x / camera.width) * extent
    sy = (1.0 - 2.0 * y / camera.height) * extent * camera.height / camera.width
    return unit(forward + sx[..., None] * left + sy[..., None] * up)


def filter_value(rfilter, x):
    x, r = np.abs(x), rfilter.radius
    if rfilter.kind == "box":
        return np.ones_like(x)
    if rfilter.kind == "gaussian":
        return np.exp(-(x**2) / (2 * rfilter.stddev**2)) - np.exp(-(r**2) / (2 * rfilter.stddev**2))
    if rfilter.kind == "tent":
        return 1.0 - x / r
    b, c = rfilter.b, rfilter.c
    x = 2.0 * x / r
    near = (12 - 9 * b - 6 * c) * x**3 + (-18 + 12 * b + 6 * c) * x**2 + (6 - 2 * b)
    far = (-b - 6 * c) * x**3 + (6 * b + 30 * c) * x**2 + (-12 * b - 48 * c) * x + (8 * b + 24 * c)
    return np.where(x < 1, near, far) / 6.0  # [5], equation 8


def filter_nodes(rfilter, order):
    """Nodes and normalised weights along one axis; the rule is applied between the kinks of a filter."""
    kinks = np.linspace(-rfilter.radius, rfilter.radius, 2 if rfilter.kind == "box" else 5)
    parts = [legendre(low, high, order) for low, high in zip(kinks, kinks[1:])]
    x = np.concatenate([part[0] for part in parts])
    w = np.concatenate([part[1] for part in parts]) * filter_value(rfilter, x)
    return x, w / w.sum()


def seen(scene, x, y, order):
    """The radiance along rays. The lamp must not be in the image."""
    origin = np.array(scene.camera.origin, dtype=float)
    direction = camera_rays(scene.camera, x, y)
    assert np.all(direction[..., 1] < 0.0), "the plane must fill the image"
    points = origin + direction * (-origin[1] / direction[..., 1])[..., None]
    plane, *lamps = scene.shapes
    assert np.all(np.abs(points[..., 0]) < plane.width / 2) and np.all(np.abs(points[..., 2]) < plane.height / 2)
    f = reflectance(plane.bsdf)
    result = np.zeros_like(points)
    for lamp in lamps:
        method = {"rectangle": from_rectangle, "sphere": from_sphere}[lamp.kind]
        result += method(f, points, -direction, lamp, order)
    for light in scene.lights:
        result += from_delta(f, points, -direction, light)
    return result


def image(scene, pixel_order, lamp_order):
    offsets, weights = filter_nodes(scene.filter, pixel_order)
    rows, columns = np.meshgrid(
        np.arange(scene.camera.height) + 0.5, np.arange(scene.camera.width) + 0.5, indexing="ij"
    )
    result = np.zeros((scene.camera.height, scene.camera.width, 3))
    for dx, wx in zip(offsets, weights):
        for dy, wy in zip(offsets, weights):
            result += wx * wy * seen(scene, columns + dx, rows + dy, lamp_order)
    return result


def render(scene):
    """The image, and the square of an estimate of its error: what a coarser rule differs by."""
    pixel_order = 3 if len(scene.shapes) > 1 else 8
    fine = image(scene, pixel_order, 24)
    coarse = image(scene, pixel_order - 1, 18)
    return fine, (fine - coarse) ** 2

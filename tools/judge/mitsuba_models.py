# SPDX-License-Identifier: MIT
"""Models that Mitsuba has not, as BSDF plugins for it, so that its transport judges them, too.

Written from the papers that quadrature.py numbers. Directions are chosen as a diffuse surface would: slow, and right
for any reflectance on the front side.
"""

import drjit as dr
import mitsuba as mi

descriptions = []  # what a plugin's parameter `index` counts


def beckmann(wi, wo, alpha):
    """D G / (4 cos_i), and the cosine with the half vector: [1], equations 20, 25 and 27."""
    h = dr.normalize(wi + wo)
    tan_squared = (h.x * h.x + h.y * h.y) / (h.z * h.z)
    d = dr.exp(-tan_squared / (alpha * alpha)) / (dr.pi * alpha * alpha * h.z * h.z * h.z * h.z)

    def g1(v):
        a = v.z / (alpha * dr.sqrt(v.x * v.x + v.y * v.y))
        fit = (3.535 * a + 2.181 * a * a) / (1.0 + 2.276 * a + 2.577 * a * a)
        return dr.select(a < 1.6, fit, 1.0)

    return d * g1(wi) * g1(wo) / (4.0 * wi.z), dr.dot(wi, h)


def roughconductor(p, wi, wo):
    facets, cosine = beckmann(wi, wo, p["alpha"])
    r0 = mi.Color3f(p["R0"])
    return facets * (r0 + (1.0 - r0) * (1.0 - cosine) ** 5)


def roughsubstrate(p, wi, wo):
    facets, cosine = beckmann(wi, wo, p["alpha"])
    interior, exterior = p["intIOR"], p["extIOR"]
    fresnel, _, _, _ = mi.fresnel(cosine, interior / exterior)
    normal = ((interior - exterior) / (interior + exterior)) ** 2
    base = 28.0 / (23.0 * dr.pi) * (1.0 - normal) * (1.0 - (1.0 - 0.5 * wi.z) ** 5) * (1.0 - (1.0 - 0.5 * wo.z) ** 5)
    return mi.Color3f(p["kd"]) * (base * wo.z) + facets * fresnel


def phong(p, wi, wo):
    kd, ks, n = p["diffuse-coefficients"], p["specular-coefficients"], p["exponent"]
    largest = max(a + b for a, b in zip(kd, ks))
    scale = 0.99 / largest if largest > 1.0 else 1.0
    cosine = dr.maximum(dr.dot(mi.reflect(wi), wo), 0.0)
    lobe = (n + 2.0) / (2.0 * dr.pi) * cosine**n
    return (mi.Color3f(kd) / dr.pi + mi.Color3f(ks) * lobe) * (scale * wo.z)


MODELS = {f.__name__: f for f in (roughconductor, roughsubstrate, phong)}


class Model(mi.BSDF):
    def __init__(self, properties):
        mi.BSDF.__init__(self, properties)
        description = descriptions[properties["index"]]
        self.value = MODELS[description.type]
        self.parameters = description.parameters
        flags = mi.BSDFFlags.GlossyReflection | mi.BSDFFlags.FrontSide
        self.m_components = [flags]
        self.m_flags = flags

    def eval_pdf(self, context, si, wo, active=True):
        front = active & (si.wi.z > 0.0) & (wo.z > 0.0)
        up = mi.Vector3f(0.0, 0.0, 1.0)
        value = self.value(self.parameters, dr.select(front, si.wi, up), dr.select(front, wo, up))
        pdf = mi.warp.square_to_cosine_hemisphere_pdf(wo)
        return dr.select(front, value, 0.0), dr.select(front, pdf, 0.0)

    def eval(self, context, si, wo, active=True):
        return self.eval_pdf(context, si, wo, active)[0]

    def pdf(self, context, si, wo, active=True):
        return self.eval_pdf(context, si, wo, active)[1]

    def sample(self, context, si, sample1, sample2, active=True):
        sampled = mi.BSDFSample3f()
        sampled.wo = mi.warp.square_to_cosine_hemisphere(sample2)
        value, sampled.pdf = self.eval_pdf(context, si, sampled.wo, active)
        sampled.eta = 1.0
        sampled.sampled_type = mi.UInt32(+mi.BSDFFlags.GlossyReflection)
        sampled.sampled_component = mi.UInt32(0)
        return sampled, dr.select(sampled.pdf > 0.0, value / sampled.pdf, 0.0)

    def traverse(self, callback):
        pass


class RoughGlass(mi.BSDF):
    """Mitsuba's rough dielectric, with directions chosen as [1], section 5.2, has it.

    Its own way to choose among all normals takes them from a rougher surface, with weights that differ from its
    value by a percent and more; its way to choose visible normals follows the exact shadowing function.
    """

    def __init__(self, properties):
        mi.BSDF.__init__(self, properties)
        p = descriptions[properties["index"]]
        self.inner = mi.load_dict(p)
        self.eta = p["int_ior"] / p["ext_ior"]
        self.facets = mi.MicrofacetDistribution(mi.MicrofacetType.Beckmann, p["alpha"], False)
        sides = mi.BSDFFlags.FrontSide | mi.BSDFFlags.BackSide
        self.m_components = [mi.BSDFFlags.GlossyReflection | sides, mi.BSDFFlags.GlossyTransmission | sides]
        self.m_flags = mi.BSDFFlags.GlossyReflection | mi.BSDFFlags.GlossyTransmission | sides

    def density(self, wi, wo):
        reflected = wi.z * wo.z > 0.0
        eta = dr.select(wi.z > 0.0, mi.Float(self.eta), mi.Float(1.0 / self.eta))
        h = dr.normalize(wi + wo * dr.select(reflected, 1.0, eta))
        h = dr.select(h.z < 0.0, -h, h)
        cos_i, cos_o = dr.dot(wi, h), dr.dot(wo, h)
        jacobian = dr.select(
            reflected,
            1.0 / (4.0 * dr.abs(cos_o)),  # [1], equation 14
            eta * eta * dr.abs(cos_o) / ((cos_i + eta * cos_o) * (cos_i + eta * cos_o)),  # [1], equation 17
        )
        fresnel, _, _, _ = mi.fresnel(cos_i, self.eta)
        pdf = self.facets.eval(h) * h.z * dr.select(reflected, fresnel, 1.0 - fresnel) * jacobian
        return dr.select((cos_i * wi.z > 0.0) & (cos_o * wo.z > 0.0), pdf, 0.0)

    def eval(self, context, si, wo, active=True):
        return self.inner.eval(context, si, wo, active)

    def pdf(self, context, si, wo, active=True):
        return dr.select(active, self.density(si.wi, wo), 0.0)

    def eval_pdf(self, context, si, wo, active=True):
        return self.eval(context, si, wo, active), self.pdf(context, si, wo, active)

    def sample(self, context, si, sample1, sample2, active=True):
        m, _ = self.facets.sample(si.wi, sample2)
        cos_i = dr.dot(si.wi, m)
        fresnel, cos_t, eta_it, eta_ti = mi.fresnel(cos_i, self.eta)
        reflected = sample1 <= fresnel
        sampled = mi.BSDFSample3f()
        sampled.wo = dr.select(reflected, mi.reflect(si.wi, m), mi.refract(si.wi, m, cos_t, eta_ti))
        right_side = reflected == (si.wi.z * sampled.wo.z > 0.0)
        value, pdf = self.eval_pdf(context, si, sampled.wo, active)
        good = active & right_side & (pdf > 0.0)
        sampled.pdf = dr.select(good, pdf, 0.0)
        sampled.eta = dr.select(reflected, 1.0, eta_it)
        sampled.sampled_type = dr.select(
            reflected, mi.UInt32(+mi.BSDFFlags.GlossyReflection), mi.UInt32(+mi.BSDFFlags.GlossyTransmission)
        )
        sampled.sampled_component = dr.select(reflected, mi.UInt32(0), mi.UInt32(1))
        return sampled, dr.select(good, value / pdf, 0.0)

    def traverse(self, callback):
        pass


mi.register_bsdf("judged", Model)
mi.register_bsdf("judged_glass", RoughGlass)


def plugin(description):
    descriptions.append(description)
    return {"type": "judged", "index": len(descriptions) - 1}


def rough_glass(dictionary):
    """For a rough dielectric's dictionary."""
    descriptions.append(dictionary)
    return {"type": "judged_glass", "index": len(descriptions) - 1}

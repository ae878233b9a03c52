"""Mitsuba's side of the scenes: the reflectance of glTF 2.0, appendix B, and the spot light of KHR_lights_punctual.

Neither is among Mitsuba's own. Written in its Python, both are compiled into the same kernel as the rest, so that they cost
what built-in ones would. Import after a variant is set.
"""

import drjit as dr
import mitsuba as mi


class Gltf(mi.BSDF):
    """Two-sided metallic-roughness surface: Schlick, height-correlated Smith GGX, alpha = roughness² and at least 1e-3."""

    def __init__(self, props):
        mi.BSDF.__init__(self, props)
        self.base = props.get_texture("base")
        self.channels = props.get_texture("channels") if "channels" in props else None  # roughness in green, metallic in blue
        self.roughness = mi.Float(props["roughness"])
        self.metallic = mi.Float(props["metallic"])
        self.specular = mi.Float(props["specular"])
        flags = mi.BSDFFlags.FrontSide | mi.BSDFFlags.BackSide
        diffuse = mi.BSDFFlags.DiffuseReflection | flags
        glossy = mi.BSDFFlags.GlossyReflection | flags
        self.m_components = [diffuse, glossy]
        self.m_flags = diffuse | glossy

    def look(self, si, active):
        base = self.base.eval(si, active)
        metallic, roughness = self.metallic, self.roughness
        if self.channels is not None:
            read = self.channels.eval(si, active)
            metallic, roughness = metallic * read.z, roughness * read.y
        alpha = dr.maximum(dr.square(roughness), 1e-3)
        dielectric = 0.04 * self.specular
        f0 = dr.lerp(mi.Color3f(dielectric), base, metallic)
        f90 = dr.lerp(self.specular, mi.Float(1), metallic)
        return base * (1 - metallic), f0, f90, dielectric, alpha

    def share(self, look, cosine):
        """Chance of the specular part, by how bright both parts are from here."""
        albedo, f0, f90, dielectric, _ = look
        weight = self.schlick(cosine)
        specular = mi.luminance(f0 + (f90 - f0) * weight)
        diffuse = mi.luminance(albedo) * (1 - (dielectric + (self.specular - dielectric) * weight))
        return dr.select(specular + diffuse > 0, specular / dr.maximum(specular + diffuse, 1e-20), 0)

    @staticmethod
    def schlick(cosine):
        x = dr.clip(1 - cosine, 0, 1)
        x2 = x * x
        return x2 * x2 * x

    def value_and_pdf(self, look, view, light, active):
        albedo, f0, f90, dielectric, alpha = look
        active = active & (view.z > 0) & (light.z > 0)
        half = dr.normalize(view + light)
        cosine = dr.dot(view, half)
        weight = self.schlick(cosine)
        a2 = alpha * alpha
        # In terms of the sine: 1 − cos² would lose the peak of small alphas.
        spread = half.x * half.x + half.y * half.y + a2 * half.z * half.z
        density = a2 / (dr.pi * spread * spread)
        lambda_view = dr.sqrt(a2 + (1 - a2) * view.z * view.z)
        lambda_light = dr.sqrt(a2 + (1 - a2) * light.z * light.z)
        seen = 0.5 / dr.maximum(light.z * lambda_view + view.z * lambda_light, 1e-20)
        fresnel = f0 + (f90 - f0) * weight
        through = 1 - (dielectric + (self.specular - dielectric) * weight)
        value = (albedo * (through / dr.pi) + fresnel * (density * seen)) * light.z
        # Visible normals: D G1 (v·h) / v.z, over 4 (v·h).
        visible = density / (2 * (view.z + lambda_view))
        share = self.share(look, view.z)
        pdf = dr.lerp(light.z / dr.pi, visible, share)
        return dr.select(active, value, 0), dr.select(active, pdf, 0)

    def sample(self, ctx, si, sample1, sample2, active=True):
        look = self.look(si, active)
        side = dr.mulsign(mi.Float(1), si.wi.z)
        view = mi.Vector3f(si.wi.x, si.wi.y, si.wi.z * side)
        share = self.share(look, view.z)
        specular = sample1 < share
        half = self.visible_normal(view, look[4], sample2)
        mirrored = 2 * dr.dot(view, half) * half - view
        light = dr.select(specular, mirrored, mi.warp.square_to_cosine_hemisphere(sample2))
        value, pdf = self.value_and_pdf(look, view, light, active)
        active = active & (pdf > 0)
        found = mi.BSDFSample3f()
        found.wo = mi.Vector3f(light.x, light.y, light.z * side)
        found.pdf = pdf
        found.eta = 1
        found.sampled_type = dr.select(
            specular, mi.UInt32(+mi.BSDFFlags.GlossyReflection), mi.UInt32(+mi.BSDFFlags.DiffuseReflection)
        )
        found.sampled_component = dr.select(specular, mi.UInt32(1), mi.UInt32(0))
        return found, dr.select(active, value / dr.maximum(pdf, 1e-30), 0) & active

    @staticmethod
    def visible_normal(view, alpha, sample):
        """A normal that the view sees, by the cap of Dupuy and Benyoub 2023, Sampling Visible GGX Normals, section 3."""
        bent = dr.normalize(mi.Vector3f(view.x * alpha, view.y * alpha, view.z))
        azimuth = 2 * dr.pi * sample.x
        z = (1 - sample.y) * (1 + bent.z) - bent.z
        sine = dr.safe_sqrt(1 - z * z)
        s, c = dr.sincos(azimuth)
        cap = mi.Vector3f(sine * c, sine * s, z) + bent
        return dr.normalize(mi.Vector3f(cap.x * alpha, cap.y * alpha, cap.z))

    def both_above(self, si, wo):
        side = dr.mulsign(mi.Float(1), si.wi.z)
        return mi.Vector3f(si.wi.x, si.wi.y, si.wi.z * side), mi.Vector3f(wo.x, wo.y, wo.z * side)

    def eval(self, ctx, si, wo, active=True):
        return self.eval_pdf(ctx, si, wo, active)[0]

    def pdf(self, ctx, si, wo, active=True):
        return self.eval_pdf(ctx, si, wo, active)[1]

    def eval_pdf(self, ctx, si, wo, active=True):
        return self.value_and_pdf(self.look(si, active), *self.both_above(si, wo), active)

    def eval_diffuse_reflectance(self, si, active=True):
        albedo, f0, _, _, _ = self.look(si, active)
        return albedo + f0

    def to_string(self):
        return "Gltf"


class Spot(mi.Emitter):
    """Spot of KHR_lights_punctual: intensity times saturate((cos − cos outer) / (cos inner − cos outer))²."""

    def __init__(self, props):
        mi.Emitter.__init__(self, props)
        self.position = mi.Point3f(props["position"])
        self.axis = mi.Vector3f(props["axis"])
        self.intensity = mi.Color3f(props["r"], props["g"], props["b"])
        self.scale = mi.Float(props["scale"])
        self.offset = mi.Float(props["offset"])
        self.m_flags = +mi.EmitterFlags.DeltaPosition

    def sample_direction(self, it, sample, active=True):
        ds = mi.DirectionSample3f()
        ds.p = self.position
        ds.n = 0
        ds.uv = 0
        ds.pdf = 1
        ds.time = it.time
        ds.delta = True
        ds.emitter = mi.EmitterPtr(self)
        way = self.position - it.p
        ds.dist = dr.norm(way)
        ds.d = way / ds.dist
        falloff = dr.square(dr.clip(-dr.dot(ds.d, self.axis) * self.scale + self.offset, 0, 1))
        return ds, (self.intensity * (falloff / dr.square(ds.dist))) & active

    def pdf_direction(self, it, ds, active=True):
        return mi.Float(0)

    def eval_direction(self, it, ds, active=True):
        return mi.Color3f(0)

    def eval(self, si, active=True):
        return mi.Color3f(0)

    def bbox(self):
        return mi.ScalarBoundingBox3f()

    def to_string(self):
        return "Spot"


mi.register_bsdf("vsgl_gltf", Gltf)
mi.register_emitter("vsgl_spot", Spot)

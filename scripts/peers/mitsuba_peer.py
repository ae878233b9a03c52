"""Mitsuba 3, in a process of its own: a job as JSON on standard input, one line of JSON for each picture on standard output.

Times are CPU seconds of this process, all threads, for one render of a scene that is loaded, by a kernel that is compiled:
every picture is rendered once before it is timed. Light of one bounce is the picture less one of direct light alone by the
same random numbers, so that both see the same points; the picture of direct light and the subtraction are not charged.
"""

import json
import os
import resource
import sys
import time

job = json.load(sys.stdin)
os.sched_setaffinity(0, sorted(os.sched_getaffinity(0))[: job["threads"]])

import drjit as dr  # noqa: E402
import mitsuba as mi  # noqa: E402
import numpy as np  # noqa: E402

dr.set_thread_count(job["threads"])
mi.set_variant("llvm_ad_rgb")
mi.set_log_level(mi.LogLevel.Error)

import gltf  # noqa: E402
import surface  # noqa: E402, F401
from denoiser import Denoiser  # noqa: E402
from pictures import read_exr, write_exr  # noqa: E402


def bitmap(found, factor, linear):
    picture = mi.Bitmap(found) if isinstance(found, str) else mi.Bitmap(mi.MemoryStream(found))
    if linear:
        picture.set_srgb_gamma(False)
    picture = picture.convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32, srgb_gamma=False)
    pixels = np.array(picture) * np.array(factor, np.float32)
    return {"type": "bitmap", "bitmap": mi.Bitmap(pixels.astype(np.float32)), "raw": True}


def bsdf(file, index):
    about = gltf.material(file, index)
    base = {"type": "rgb", "value": [float(f) for f in about["base"]]}
    if about["base_texture"] is not None:
        base = bitmap(about["base_texture"], about["base"], False)
    if about["specular"] == 0 and about["metallic"] == 0:
        return {"type": "twosided", "inner": {"type": "diffuse", "reflectance": base}}
    out = {"type": "vsgl_gltf", "base": base, "specular": float(about["specular"])}
    out |= {"roughness": float(about["roughness"]), "metallic": float(about["metallic"])}
    if about["metallic_roughness_texture"] is not None:
        out["channels"] = bitmap(about["metallic_roughness_texture"], [1, 1, 1], True)
    return out


def mesh(number, part, material):
    positions, normals, coordinates, indices, _ = part
    properties = mi.Properties()
    properties["bsdf"] = material
    out = mi.Mesh(
        f"part{number}", len(positions), len(indices), properties, normals is not None, coordinates is not None
    )
    parameters = mi.traverse(out)
    parameters["vertex_positions"] = mi.Float(positions.astype(np.float32).ravel())
    if normals is not None:
        parameters["vertex_normals"] = mi.Float(normals.astype(np.float32).ravel())
    if coordinates is not None:
        parameters["vertex_texcoords"] = mi.Float(coordinates.astype(np.float32).ravel())
    parameters["faces"] = mi.UInt(indices.astype(np.uint32).ravel())
    parameters.update()
    return out


def spot(light):
    inner, outer = (np.cos(np.radians(light[name + "_degrees"])) for name in ("inner", "outer"))
    scale = 1 / max(1e-6, inner - outer)
    r, g, b = (float(v) for v in light["intensity"])
    return {
        "type": "vsgl_spot",
        "position": [float(v) for v in light["position"]],
        "axis": [float(v) for v in light["axis"]],
        "r": r,
        "g": g,
        "b": b,
        "scale": float(scale),
        "offset": float(-outer * scale),
    }


def load():
    file = gltf.File(job["scene"])
    camera = job["camera"]
    eye = np.array(camera["eye"])
    width, height = job["size"]
    sensor = {
        "type": "perspective",
        "fov": camera["fov_degrees"],
        "fov_axis": "y",
        "near_clip": 1e-3 * job["extent"],
        "far_clip": 1e3 * job["extent"],
        "to_world": mi.ScalarTransform4f().look_at(
            eye.tolist(), (eye + np.array(camera["forward"])).tolist(), camera["up"]
        ),
        "film": {
            "type": "hdrfilm",
            "width": width,
            "height": height,
            "pixel_format": "rgb",
            "component_format": "float32",
            "rfilter": {"type": "box"},
        },
        "sampler": {"type": "multijitter"},
    }
    scene = {"type": "scene", "sensor": sensor}
    materials = {}
    for number, part in enumerate(gltf.parts(file)):
        if part[4] not in materials:
            materials[part[4]] = mi.load_dict(bsdf(file, part[4]))
        scene[f"part{number}"] = mesh(number, part, materials[part[4]])
    for number, light in enumerate(job["lights"]):
        scene[f"light{number}"] = spot(light)
    return mi.load_dict(scene)


def clock():
    used = resource.getrusage(resource.RUSAGE_SELF)
    return np.array([used.ru_utime + used.ru_stime, time.monotonic()])


def many(scene, integrator, spp, seed):
    """All channels in f64, in several passes where one would not fit memory; CPU and wall seconds."""
    passes = [min(spp - at, job["pass_spp"]) for at in range(0, spp, job["pass_spp"])]
    total, begun = 0.0, clock()
    for number, part in enumerate(passes):
        picture = mi.render(scene, integrator=integrator, spp=part, seed=1000 * seed + number)
        total = total + np.array(picture, dtype=np.float64) * (part / spp)
    return total, clock() - begun


def denoised(scene, integrator, filters, wanted):
    """Light with guides, cleaned; CPU and wall seconds of both."""
    begun = clock()
    channels = many(scene, integrator, wanted["spp"], wanted["seed"])[0]
    picture = filters(channels[..., :3], channels[..., 3:6], channels[..., 6:9])
    return channels, picture, clock() - begun


def mean_of_four(pixels):
    return (pixels[::2, ::2] + pixels[1::2, ::2] + pixels[::2, 1::2] + pixels[1::2, 1::2]) / 4


scene = load()
whole = {"type": "path", "max_depth": 3, "rr_depth": 100, "hide_emitters": True}
direct = mi.load_dict({**whole, "max_depth": 2})
guided = mi.load_dict({"type": "aov", "aovs": "albedo:albedo,normal:sh_normal", "light": whole})
whole = mi.load_dict(whole)
filters = None
for wanted in job["pictures"]:
    spp, seed, kind = wanted["spp"], wanted["seed"], wanted["kind"]
    straight = many(scene, direct, spp, seed)[0]
    if kind == "denoised":
        if filters is None:
            filters = Denoiser(*job["size"], job["threads"])
        runs = [denoised(scene, guided, filters, wanted) for _ in range(1 + wanted["repeat"])]
        channels, picture = runs[0][:2]
        bounced = filters(channels[..., :3] - straight, channels[..., 3:6], channels[..., 6:9])
        times = [r[2] for r in runs[1:]]
    else:
        runs = [many(scene, whole, spp, seed) for _ in range(1 + wanted["repeat"])]
        picture = runs[0][0]
        bounced = picture - straight
        times = [r[1] for r in runs[1:]]
    layers = {"whole": picture, "direct": straight, "indirect": bounced}
    for name, pixels in layers.items():
        write_exr(f"{wanted['output']}_{name}.exr", pixels)
    out = {"spp": spp, "seed": seed, "cpu": [t[0] for t in times], "wall": [t[1] for t in times]}
    print(json.dumps(out), flush=True)
if job.get("mean"):
    # Two halves of a reference: their mean, and the same at half the size.
    for name in ("whole", "direct", "indirect"):
        pixels = sum(read_exr(f"{w['output']}_{name}.exr").astype(np.float64) for w in job["pictures"]) / len(job["pictures"])
        write_exr(f"{job['mean']}_{name}.exr", pixels)
        write_exr(f"{job['mean']}_{name}_small.exr", mean_of_four(pixels))

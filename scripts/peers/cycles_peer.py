"""Blender's Cycles, in a process of its own: a job as JSON on standard input, one line of JSON for each picture on standard
output.

Times are CPU seconds of this process, all threads, for one render of a scene that the renderer holds already: its data
persist, and every picture is rendered once before it is timed. Denoising is part of the render where it is asked for.
"""

import json
import os
import resource
import sys
import time

job = json.load(sys.stdin)
answers = os.dup(1)
os.dup2(2, 1)  # Blender talks on standard output.
os.sched_setaffinity(0, sorted(os.sched_getaffinity(0))[: job["threads"]])

import bpy  # noqa: E402
import numpy as np  # noqa: E402
from mathutils import Matrix, Vector  # noqa: E402
import addon_utils  # noqa: E402, found once bpy is there

from pictures import read_exr, write_exr  # noqa: E402


def turned(v):
    """glTF's axes to Blender's."""
    return Vector((v[0], -v[2], v[1]))


def frame(position, backward, up):
    """Matrix of an object that looks along its −z."""
    z = turned(backward).normalized()
    x = turned(up).cross(z).normalized()
    y = z.cross(x)
    turn = Matrix((x, y, z)).transposed().to_4x4()
    return Matrix.Translation(turned(position)) @ turn


def any_up(axis):
    return [0, 0, 1] if abs(axis[1]) > 0.9 else [0, 1, 0]


def add_camera(scene):
    camera = bpy.data.cameras.new("camera")
    about = job["camera"]
    camera.sensor_fit = "VERTICAL"
    camera.angle = np.radians(about["fov_degrees"])
    camera.clip_start = 1e-3 * job["extent"]
    camera.clip_end = 1e3 * job["extent"]
    item = bpy.data.objects.new("camera", camera)
    item.matrix_world = frame(about["eye"], [-v for v in about["forward"]], about["up"])
    scene.collection.objects.link(item)
    scene.camera = item


def add_spot(scene, about):
    """A spot with a hard edge at the outer angle; nodes make the falloff of KHR_lights_punctual inside."""
    light = bpy.data.lights.new("spot", "SPOT")
    light.energy = 4 * np.pi
    light.shadow_soft_size = 0
    light.spot_size = 2 * np.radians(about["outer_degrees"])
    light.spot_blend = 0
    light.use_nodes = True
    nodes, links = light.node_tree.nodes, light.node_tree.links
    emission = next(n for n in nodes if n.type == "EMISSION")
    strongest = max(about["intensity"])
    emission.inputs["Color"].default_value = [*(float(v / strongest) for v in about["intensity"]), 1]
    inner, outer = (np.cos(np.radians(about[name + "_degrees"])) for name in ("inner", "outer"))
    scale = 1 / max(1e-6, inner - outer)
    coordinates = nodes.new("ShaderNodeTexCoord")
    apart = nodes.new("ShaderNodeSeparateXYZ")
    links.new(coordinates.outputs["Normal"], apart.inputs[0])

    def math(operation, first, second, clamp=False):
        node = nodes.new("ShaderNodeMath")
        node.operation, node.use_clamp = operation, clamp
        for socket, value in zip(node.inputs, (first, second)):
            if isinstance(value, float):
                socket.default_value = value
            else:
                links.new(value, socket)
        return node.outputs[0]

    cosine = math("ABSOLUTE", apart.outputs["Z"], 0.0)
    falloff = math("ADD", math("MULTIPLY", cosine, float(scale)), float(-outer * scale), clamp=True)
    strength = math("MULTIPLY", math("MULTIPLY", falloff, falloff), float(strongest))
    links.new(strength, emission.inputs["Strength"])
    item = bpy.data.objects.new("spot", light)
    item.matrix_world = frame(about["position"], [-v for v in about["axis"]], any_up(about["axis"]))
    scene.collection.objects.link(item)


def plain():
    """What glTF takes where a primitive names no material: a rough white metal."""
    material = bpy.data.materials.new("plain")
    material.use_nodes = True
    node = next(n for n in material.node_tree.nodes if n.type == "BSDF_PRINCIPLED")
    node.inputs["Base Color"].default_value = (1, 1, 1, 1)
    node.inputs["Metallic"].default_value = node.inputs["Roughness"].default_value = 1
    return material


def load():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    addon_utils.enable("io_scene_gltf2")
    addon_utils.enable("cycles")
    bpy.ops.import_scene.gltf(filepath=job["scene"])
    scene = bpy.context.scene
    for item in list(scene.objects):
        if item.type in ("LIGHT", "CAMERA"):
            bpy.data.objects.remove(item)
    for mesh in bpy.data.meshes:
        if not any(mesh.materials):
            mesh.materials.clear()
            mesh.materials.append(plain())
    for material in bpy.data.materials:
        for node in material.node_tree.nodes if material.node_tree else []:
            if node.type == "BSDF_PRINCIPLED":
                node.distribution = "GGX"  # glTF's has no multiple scattering
                strength = node.inputs["Emission Strength"]
                for link in list(strength.links):
                    material.node_tree.links.remove(link)
                strength.default_value = 0
    for item in scene.objects:
        if item.type == "MESH":
            item.cycles.shadow_terminator_offset = 0
            item.cycles.shadow_terminator_geometry_offset = 0
    add_camera(scene)
    for about in job["lights"]:
        add_spot(scene, about)
    if scene.world is None:
        scene.world = bpy.data.worlds.new("dark")
    scene.world.use_nodes = True
    for node in scene.world.node_tree.nodes:
        if node.type == "BACKGROUND":
            node.inputs["Strength"].default_value = 0
    return scene


def settle(scene):
    """Cycles on the CPU: direct light and one bounce, nothing clamped, blurred or left out."""
    scene.render.engine = "CYCLES"
    scene.render.resolution_x, scene.render.resolution_y = job["size"]
    scene.render.resolution_percentage = 100
    scene.render.threads_mode = "FIXED"
    scene.render.threads = job["threads"]
    scene.render.use_persistent_data = True
    scene.render.use_compositing = False
    scene.render.use_sequencer = False
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.use_adaptive_sampling = False
    cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = 1
    cycles.transmission_bounces = cycles.volume_bounces = cycles.transparent_max_bounces = 0
    cycles.caustics_reflective = True
    cycles.caustics_refractive = False
    cycles.blur_glossy = 0
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    cycles.pixel_filter_type = "BOX"
    cycles.denoiser = "OPENIMAGEDENOISE"
    cycles.denoising_input_passes = "RGB_ALBEDO_NORMAL"
    cycles.denoising_prefilter = "ACCURATE"
    cycles.denoising_quality = "HIGH"
    cycles.denoising_use_gpu = False


def ask_for_layers(scene, wanted):
    """Light of one bounce apart; not beside a denoiser, which cleans the whole alone."""
    view = scene.view_layers[0]
    view.use_pass_diffuse_direct = view.use_pass_diffuse_indirect = view.use_pass_diffuse_color = wanted
    view.use_pass_glossy_direct = view.use_pass_glossy_indirect = view.use_pass_glossy_color = wanted


def render():
    before, wall = resource.getrusage(resource.RUSAGE_SELF), time.monotonic()
    bpy.ops.render.render()
    wall = time.monotonic() - wall
    after = resource.getrusage(resource.RUSAGE_SELF)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, wall


def untimed(scene, output, denoised):
    """Renders, and writes the layers."""
    settings = scene.render.image_settings
    settings.media_type = "MULTI_LAYER_IMAGE"
    settings.file_format = "OPEN_EXR_MULTILAYER"
    settings.color_depth = "32"
    settings.exr_codec = "ZIP"
    path = output + "_passes.exr"
    scene.render.filepath = path
    bpy.ops.render.render(write_still=True)
    layer = scene.view_layers[0].name
    read = lambda name: read_exr(path, f"{layer}.{name}")  # noqa: E731
    write_exr(output + "_whole.exr", read("Combined"))
    if not denoised:
        for kind, passes in (("direct", "Direct"), ("indirect", "Indirect")):
            light = read(f"Diffuse {passes}") * read("Diffuse Color") + read(f"Glossy {passes}") * read("Glossy Color")
            write_exr(f"{output}_{kind}.exr", light)
    os.remove(path)


scene = load()
settle(scene)
for wanted in job["pictures"]:
    scene.cycles.samples = wanted["spp"]
    scene.cycles.seed = wanted["seed"]
    clean = wanted["kind"] == "denoised"
    scene.cycles.use_denoising = clean
    ask_for_layers(scene, not clean)
    untimed(scene, wanted["output"], clean)
    times = [render() for _ in range(wanted["repeat"])]
    out = {"spp": wanted["spp"], "seed": wanted["seed"], "cpu": [t[0] for t in times], "wall": [t[1] for t in times]}
    os.write(answers, (json.dumps(out) + "\n").encode())

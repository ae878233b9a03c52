"""Triangles and materials of a glTF 2.0 file, in world space: as much as the ground truth's scenes need.

Triangle lists, nodes with matrices or TRS, metallic-roughness with its textures, KHR_materials_specular's factor. No skins,
animations, morph targets, normal maps, alpha. Needs numpy.
"""

import base64
import json
import struct
from pathlib import Path
from urllib.parse import unquote

import numpy as np

COMPONENT = {5120: np.int8, 5121: np.uint8, 5122: np.int16, 5123: np.uint16, 5125: np.uint32, 5126: np.float32}
WIDTH = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT4": 16}


class File:
    """A .gltf or .glb file with its buffers."""

    def __init__(self, path):
        self.path = Path(path)
        data = self.path.read_bytes()
        binary = None
        if data[:4] == b"glTF":
            length = struct.unpack("<I", data[12:16])[0]
            self.json = json.loads(data[20 : 20 + length])
            binary = data[20 + length + 8 :]
        else:
            self.json = json.loads(data)
        self.buffers = [self.bytes_of(b["uri"]) if "uri" in b else binary for b in self.json.get("buffers", [])]

    def bytes_of(self, uri):
        if uri.startswith("data:"):
            return base64.b64decode(uri.split(",", 1)[1])
        return (self.path.parent / unquote(uri)).read_bytes()

    def view(self, index):
        view = self.json["bufferViews"][index]
        start = view.get("byteOffset", 0)
        return self.buffers[view["buffer"]][start : start + view["byteLength"]], view.get("byteStride", 0)

    def accessor(self, index):
        """Rows of numbers; normalised integers become floats."""
        about = self.json["accessors"][index]
        if "sparse" in about or "bufferView" not in about:
            raise ValueError(f"{self.path}: sparse accessors are not read here")
        kind = np.dtype(COMPONENT[about["componentType"]])
        width = WIDTH[about["type"]]
        data, stride = self.view(about["bufferView"])
        rows = np.ndarray(
            (about["count"], width),
            kind.newbyteorder("<"),
            data,
            about.get("byteOffset", 0),
            (stride or width * kind.itemsize, kind.itemsize),
        )
        if about.get("normalized"):
            return np.maximum(rows / float(np.iinfo(kind).max), -1.0)
        return np.array(rows)

    def image(self, texture):
        """Path of the file of a texture, or its bytes where it lies inside a buffer."""
        image = self.json["images"][self.json["textures"][texture]["source"]]
        if "bufferView" in image:
            return self.view(image["bufferView"])[0]
        if image["uri"].startswith("data:"):
            return self.bytes_of(image["uri"])
        return str((self.path.parent / unquote(image["uri"])).resolve())


def local_matrix(node):
    if "matrix" in node:
        return np.array(node["matrix"], float).reshape(4, 4).T
    x, y, z, w = node.get("rotation", (0, 0, 0, 1))
    turn = np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ])  # fmt: skip
    out = np.eye(4)
    out[:3, :3] = turn * np.array(node.get("scale", (1, 1, 1)))
    out[:3, 3] = node.get("translation", (0, 0, 0))
    return out


def placed(file):
    """(mesh, matrix) of every node of the scene that has a mesh."""
    nodes = file.json["nodes"]
    open_nodes = [(n, np.eye(4)) for n in file.json["scenes"][file.json.get("scene", 0)]["nodes"]]
    while open_nodes:
        index, above = open_nodes.pop()
        matrix = above @ local_matrix(nodes[index])
        if "mesh" in nodes[index]:
            yield nodes[index]["mesh"], matrix
        open_nodes += [(child, matrix) for child in nodes[index].get("children", [])]


def parts(file):
    """Every primitive in world space: positions, normals or None, texture coordinates or None, indices, material or None."""
    for mesh, matrix in placed(file):
        linear = matrix[:3, :3]
        for primitive in file.json["meshes"][mesh]["primitives"]:
            if primitive.get("mode", 4) != 4:
                raise ValueError(f"{file.path}: only triangle lists are read here")
            attributes = primitive["attributes"]
            positions = file.accessor(attributes["POSITION"]).astype(float) @ linear.T + matrix[:3, 3]
            normals = None
            if "NORMAL" in attributes:
                normals = file.accessor(attributes["NORMAL"]).astype(float) @ np.linalg.inv(linear)
                normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-30)
            coordinates = file.accessor(attributes["TEXCOORD_0"]) if "TEXCOORD_0" in attributes else None
            if "indices" in primitive:
                indices = file.accessor(primitive["indices"]).reshape(-1, 3)
            else:
                indices = np.arange(len(positions)).reshape(-1, 3)
            if np.linalg.det(linear) < 0:
                indices = indices[:, ::-1]
            yield positions, normals, coordinates, indices, primitive.get("material")


def material(file, index):
    """Factors and textures of a material, defaults filled in."""
    about = {} if index is None else file.json["materials"][index]
    pbr = about.get("pbrMetallicRoughness", {})
    specular = about.get("extensions", {}).get("KHR_materials_specular", {})

    def texture(name):
        return file.image(pbr[name]["index"]) if name in pbr else None

    return {
        "base": pbr.get("baseColorFactor", [1, 1, 1, 1])[:3],
        "base_texture": texture("baseColorTexture"),
        "metallic": pbr.get("metallicFactor", 1.0),
        "roughness": pbr.get("roughnessFactor", 1.0),
        "metallic_roughness_texture": texture("metallicRoughnessTexture"),
        "specular": specular.get("specularFactor", 1.0),
    }

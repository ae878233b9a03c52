"""Linear pictures as EXR files of 32-bit floats. Needs numpy and OpenEXR."""

import numpy as np
import OpenEXR


def write_exr(path, pixels):
    """Rows of r, g, b."""
    header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
    pixels = np.ascontiguousarray(pixels, dtype=np.float32)
    with OpenEXR.File(header, {"RGB": pixels}) as file:
        file.write(str(path))


def read_exr(path, layer=""):
    """Rows of r, g, b of a layer, whichever part of the file it is in."""
    with OpenEXR.File(str(path), separate_channels=True) as file:
        channels = {name: found for part in file.parts for name, found in part.channels.items()}
        prefix = layer + "." if layer else ""
        return np.stack([np.array(channels[prefix + c].pixels, np.float32) for c in "RGB"], axis=-1)

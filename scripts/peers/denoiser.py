"""Intel's Open Image Denoise at its best quality: guides filtered first, then the light by clean guides."""

import numpy as np
import pyoidn


class Denoiser:
    """Filters for pictures of one size, built once; what is charged is their use."""

    def __init__(self, width, height, threads):
        self.device = pyoidn.Device()
        self.device.set_int("numThreads", threads)
        self.device.commit()
        names = ("color", "albedo", "normal", "output")
        self.pixels = {name: np.zeros((height, width, 3), np.float32) for name in names}
        self.guides = [self.filter({name: name, "output": name}) for name in ("albedo", "normal")]
        self.light = self.filter({name: name for name in names}, hdr=True)

    def filter(self, images, hdr=False):
        out = pyoidn.Filter(self.device, pyoidn.OIDN_FILTER_TYPE_RT)
        for slot, name in images.items():
            out.set_image(slot, self.pixels[name], pyoidn.OIDN_FORMAT_FLOAT3)
        if hdr:
            out.set_bool("hdr", True)
            out.set_bool("cleanAux", True)
        out.set_quality(pyoidn.OIDN_QUALITY_HIGH)
        out.commit()
        self.check()
        return out

    def check(self):
        error = self.device.get_error()
        if error:
            raise RuntimeError(f"Open Image Denoise: {error}")

    def __call__(self, color, albedo, normal):
        for name, value in (("color", np.maximum(color, 0)), ("albedo", np.clip(albedo, 0, 1)), ("normal", normal)):
            self.pixels[name][:] = value
        for one in (*self.guides, self.light):
            one.execute()
        self.check()
        return self.pixels["output"].copy()

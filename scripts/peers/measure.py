"""Runs vsgl and the peers on one view, and judges their pictures: a value `{cpu, wall, errors}` for each."""

import hashlib
import json
import resource
import shlex
import subprocess
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
VSGL = HERE.parent.parent / "target/release/vsgl"
LAYERS = {"whole": "onebounce", "direct": "direct", "indirect": "indirect"}
REFERENCE_SPP = 512  # of each of the two halves
PASS_SPP = 64
REPEAT = 3
ENOUGH = 4.0  # CPU seconds of one setting after which it is not repeated
FEW_SPP = 16  # up to which peers repeat a picture; longer ones are once more than the first, which warms up
PACKAGES = {"mitsuba": "mitsuba", "cycles": "bpy"}
FILES = {
    "mitsuba": [HERE / f"{name}.py" for name in ("mitsuba_peer", "surface", "denoiser")],
    "cycles": [HERE / "cycles_peer.py"],
}


class View:
    """A scene of the ground truth at a size, with the reference to judge by."""

    def __init__(self, assets, name, about, size, threads, folder):
        self.assets, self.name, self.size, self.threads = assets, name, size, threads
        self.scene = str(assets / about["scene"])
        words = shlex.split(about["vsgl"])
        at = words.index("--size")
        self.native = tuple(int(n) for n in words[at + 1].split("x"))
        self.flags = words[:at] + words[at + 2 :]
        self.folder = folder / f"{name}-{size[0]}x{size[1]}"
        self.folder.mkdir(parents=True, exist_ok=True)

    def key(self, method, **settings):
        """What a result is known by; where the reference is made, that too."""
        out = {"scene": self.name, "size": list(self.size), "threads": self.threads, "method": method, **settings}
        if self.size != self.native:
            out["reference"] = fingerprint(*FILES["mitsuba"]) + f" {2 * REFERENCE_SPP}"
        return out

    def reference(self, layer):
        if self.size == self.native:
            return self.assets / f"ground-truth/{self.name}_{LAYERS.get(layer, layer)}.exr"
        return self.folder / f"reference_{layer}.exr"

    def words(self):
        """Camera, lights and size of the scene as vsgl understands the file and the flags."""
        done = run([VSGL, "info", self.scene, *self.flags, "--size", "{}x{}".format(*self.size), "--json"])
        told = json.loads(done)
        low, high = (told["scene"]["bounds"][end] for end in ("low", "high"))
        if any(light["kind"] != "spot" for light in told["lights"]):
            raise SystemExit(f"compare-peers: {self.name} has other lights than spots")
        return {
            "scene": self.scene,
            "camera": told["camera"],
            "lights": told["lights"],
            "extent": max(h - l for h, l in zip(high, low)),
            "size": list(self.size),
            "threads": self.threads,
            "pass_spp": PASS_SPP,
        }


def run(command, **more):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, **more)
    if done.returncode:
        raise SystemExit(
            f"compare-peers: {' '.join(map(str, command[:3]))} … ended with {done.returncode}\n{done.stderr[-2000:]}"
        )
    return done.stdout


def fingerprint(*files):
    """Of programs: other code is other figures."""
    return hashlib.sha256(b"".join(file.read_bytes() for file in files)).hexdigest()[:12]


def errors(picture, reference, layer=""):
    """{"pixel": {mape, bias}, "box": {…}} against a reference, in percent."""
    told = json.loads(run([VSGL, "compare", picture, reference, "--layer", layer, "--box", "8", "--json"]))
    names = ("mape", "bias")
    return {scale: {n: s["metrics"][n] for n in names} for scale, s in zip(("pixel", "box"), told["scales"])}


def child_cpu(command):
    """CPU and wall seconds of a program, and what it printed."""
    before, begun = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    printed = run(command)
    wall, after = time.monotonic() - begun, resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, wall, printed


class Vsgl:
    """The program, timed from outside: its CPU time less that of loading and of writing the file."""

    def __init__(self, view, store):
        self.view, self.store, self.program = view, store, fingerprint(VSGL)
        self.out = view.folder / "vsgl.exr"

    def command(self, size, settings, outputs):
        command = [VSGL, "render", self.view.scene, *self.view.flags, "--backend", "cpu", "--quiet"]
        command += ["--threads", str(self.view.threads), "--size", "{}x{}".format(*size), *settings]
        return command + [word for out in outputs for word in ("-o", out)]

    def overhead(self):
        """CPU seconds of loading, and of writing a picture: a render of 8x8 pixels, and one file more."""
        key = self.view.key("vsgl overhead", program=self.program)
        if found := self.store.get(key):
            return found["load"], found["write"]
        cheap = ["--lights", "1", "--rsm", "1", "--occlusion", "none"]
        more = self.view.folder / "more.exr"

        def least(size, outputs):
            return min(child_cpu(self.command(size, cheap, outputs))[0] for _ in range(4))

        load = least((8, 8), [self.out])
        write = max(0.0, least(self.view.size, [self.out, more]) - least(self.view.size, [self.out]))
        more.unlink()
        self.store.put(key, {"load": load, "write": write})
        return load, write

    def measure(self, method, settings):
        """`method` is the label; `settings` the flags."""
        key = self.view.key(method, settings=settings, program=self.program)
        if found := self.store.get(key):
            return found
        load, write = self.overhead()
        runs = []
        while len(runs) < REPEAT and sum(r[0] for r in runs) < ENOUGH:
            runs.append(child_cpu(self.command(self.view.size, settings, [self.out])))
        found = {"cpu": sorted(r[0] - load - write for r in runs), "wall": sorted(r[1] for r in runs)}
        shadowless = settings[settings.index("--occlusion") + 1] == "none" if "--occlusion" in settings else False
        if shadowless:
            indirect = self.view.reference("indirect_unoccluded")
            found["errors"] = {"indirect": errors(self.out, indirect, "indirect")}
        else:
            found["errors"] = {
                layer: errors(self.out, self.view.reference(layer), "" if layer == "whole" else layer)
                for layer in LAYERS
            }
        self.out.unlink()
        self.store.put(key, found)
        return found


class Peers:
    """The other renderers, each in a process for a view."""

    def __init__(self, view, store, python, variables, pins):
        self.view, self.store, self.python, self.variables, self.pins = view, store, python, variables, pins

    def about(self, program):
        """What other figures would come from."""
        return {"version": self.pins[PACKAGES[program]], "code": fingerprint(*FILES[program])}

    def ask(self, program, job):
        done = run([self.python, HERE / f"{program}_peer.py"], input=json.dumps(job), env=self.variables)
        return [json.loads(line) for line in done.splitlines() if line.startswith("{")]

    def measure(self, program, method, wanted, layers):
        """`wanted` are pictures `{kind, spp}`; results in their order, those known not rendered again."""
        keys = [self.view.key(method, spp=w["spp"], **self.about(program)) for w in wanted]
        todo = [(k, w) for k, w in zip(keys, wanted) if self.store.get(k) is None]
        if todo:
            output = lambda w: str(self.view.folder / f"{program}_{w['kind']}_{w['spp']}")  # noqa: E731
            pictures = [
                {"seed": 1, "repeat": REPEAT if w["spp"] <= FEW_SPP else 1, "output": output(w), **w} for _, w in todo
            ]
            told = self.ask(program, {**self.view.words(), "pictures": pictures})
            if len(told) != len(todo):
                raise SystemExit(f"compare-peers: {program} gave {len(told)} of {len(todo)} pictures")
            for (key, w), t in zip(todo, told):
                judged = {}
                for layer in LAYERS:
                    file = Path(f"{output(w)}_{layer}.exr")
                    if layer in layers:
                        judged[layer] = errors(file, self.view.reference(layer))
                    file.unlink(missing_ok=True)
                self.store.put(key, {"cpu": sorted(t["cpu"]), "wall": sorted(t["wall"]), "errors": judged})
        return [self.store.get(k) for k in keys]

    def make_reference(self):
        """Where the ground truth has another size: a reference by Mitsuba in two halves, from which its noise is known."""
        key = self.view.key("reference", version=self.pins["mitsuba"])
        if (found := self.store.get(key)) and self.view.reference("indirect").exists():
            return found
        folder = self.view.folder
        halves = [
            {"kind": "path", "spp": REFERENCE_SPP, "seed": 100 + n, "repeat": 0, "output": str(folder / f"half{n}")}
            for n in (1, 2)
        ]
        self.ask("mitsuba", {**self.view.words(), "pictures": halves, "mean": str(folder / "reference")})
        found = {}
        for layer in LAYERS:
            between = errors(folder / f"half1_{layer}.exr", folder / f"half2_{layer}.exr")
            # The mean of two halves has half the difference of both as its noise.
            noise = {scale: between[scale]["mape"] / 2 for scale in between}
            found[layer] = {"noise": noise}
            small = folder / f"reference_{layer}_small.exr"
            if tuple(2 * n for n in self.view.native) == self.view.size:
                truth = self.view.assets / f"ground-truth/{self.view.name}_{LAYERS[layer]}.exr"
                found[layer]["truth"] = errors(small, truth)
            for file in (folder / f"half1_{layer}.exr", folder / f"half2_{layer}.exr", small):
                file.unlink()
        self.store.put(key, found)
        return found

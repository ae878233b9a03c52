"""A virtual environment outside the repository with pinned versions of the peers, and LLVM for Mitsuba."""

import glob
import json
import os
import re
import shutil
import subprocess
import sys
import venv
from pathlib import Path

# bpy fits one version of Python each: 5.0.1 is for 3.11.
PINS = {"mitsuba": "3.9.1", "numpy": "1.26.4", "OpenEXR": "3.5.3", "pyoidn": "2.5.1.0", "bpy": "5.0.1"}
BLENDER_PYTHON = (3, 11)
# Dr.Jit asks for fminimum, which older ones cannot compile.
LLVM_LEAST, LLVM_PACKAGE = 16, "libllvm19"


class Missing(Exception):
    """Something that the comparison cannot do without, in words for the user."""


def default_folder():
    cache = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    return Path(cache) / "vsgl" / "peers"


def prepare(folder, say):
    """Makes the environment, or finds it made. Returns its Python, its variables, and which peers it has."""
    folder.mkdir(parents=True, exist_ok=True)
    place = folder / "venv"
    python = place / "bin" / "python"
    wanted = dict(PINS)
    blender = sys.version_info[:2] == BLENDER_PYTHON
    if not blender:
        del wanted["bpy"]
        wanted["numpy"] = "2.2.6"  # bpy asks for an older one, which newer Pythons do not have
        have, need = (".".join(map(str, v)) for v in (sys.version_info[:2], BLENDER_PYTHON))
        say(
            f"this is Python {have}, and bpy {PINS['bpy']} is for {need} alone: going on without Blender's Cycles"
            f" (python{need} scripts/compare-peers has it)"
        )
    if installed(python) != wanted:
        say(f"installing {', '.join(f'{k} {v}' for k, v in wanted.items())} in {place}")
        venv.create(place, with_pip=True, clear=True)
        command = [python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check"]
        done = subprocess.run([*command, *(f"{k}=={v}" for k, v in wanted.items())], capture_output=True, text=True)
        if done.returncode:
            last = done.stderr.strip().splitlines()[-3:]
            raise Missing(
                "the peers could not be installed; is the network, or a mirror of PyPI (PIP_INDEX_URL), in reach?\n  "
                + "\n  ".join(last)
            )
        (place / "wanted.json").write_text(json.dumps(wanted))
    variables = dict(os.environ)
    llvm = find_llvm(folder) or fetch_llvm(folder, say)
    variables["DRJIT_LIBLLVM_PATH"] = llvm
    return python, variables, blender


def installed(python):
    try:
        return json.loads((python.parent.parent / "wanted.json").read_text())
    except (OSError, ValueError):
        return None


def version_of(path):
    found = re.search(r"libLLVM(?:-|\.so\.)(\d+)", Path(path).name)
    return int(found.group(1)) if found else 0


def find_llvm(folder):
    """A library of LLVM that is new enough: the user's choice, else the newest at the usual places."""
    if chosen := os.environ.get("DRJIT_LIBLLVM_PATH"):
        return chosen
    places = [
        "/usr/lib/*-linux-gnu",
        "/usr/lib64",
        "/usr/lib/llvm*/lib",
        "/usr/lib",
        "/usr/local/lib",
        "/opt/homebrew/opt/llvm/lib",
    ]
    places += [f"{folder}/llvm/usr/lib/*-linux-gnu"]
    found = [p for place in places for p in glob.glob(place + "/libLLVM*.so*") + glob.glob(place + "/libLLVM*.dylib")]
    found = [p for p in found if version_of(p) >= LLVM_LEAST]
    return max(found, key=version_of, default=None)


def fetch_llvm(folder, say):
    """On Debian and its kin: the package's files beside the environment, without installing it."""
    advice = f"Mitsuba needs LLVM {LLVM_LEAST} or newer, shared: install {LLVM_PACKAGE}, or set DRJIT_LIBLLVM_PATH"
    if not shutil.which("apt-get") or not shutil.which("dpkg"):
        raise Missing(advice)
    say(f"no LLVM of {LLVM_LEAST} or newer: unpacking {LLVM_PACKAGE} in {folder / 'llvm'}")
    place = folder / "llvm"
    place.mkdir(exist_ok=True)
    done = subprocess.run(["apt-get", "download", LLVM_PACKAGE], cwd=place, capture_output=True, text=True)
    packages = list(place.glob("*.deb"))
    if done.returncode or not packages:
        raise Missing(advice)
    for package in packages:
        subprocess.run(["dpkg", "-x", package, place], check=True)
        package.unlink()
    found = find_llvm(folder)
    if not found:
        raise Missing(advice)
    return found

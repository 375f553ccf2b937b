# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Builds layers with Bazel, and says which file goes where in a prefix."""

import dataclasses
import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import urllib.parse

import exports

NAMES = ("math", "dynamics", "hqp", "robot", "control", "gait", "sim")


class BuildError(Exception):
    """A build that failed, as one line."""


@dataclasses.dataclass(frozen=True)
class Entry:
    """Content of one file in the prefix: exactly one of the members is set."""

    copy: str = ""  # A file's path.
    text: str = ""
    link: str = ""  # Target of a symbolic link.


def _bazel_command(program):
    """Returns the Bazel that runs this program, as the start of a command.

    POISE_BAZEL names a Bazel that is not on PATH.
    """
    names = [os.environ.get("POISE_BAZEL", ""), "bazel", "bazelisk"]
    bazel = next(filter(None, map(shutil.which, filter(None, names))), None)
    if bazel is None:
        raise BuildError("there is no bazel on PATH; run tools/setup.sh")
    # Another output base would compile everything a second time.
    base, found, _ = os.path.abspath(program).partition("/execroot/")
    return [bazel] + ([f"--output_base={base}"] if found else [])


def build(workspace, names, program):
    """Builds layers; returns their descriptions, and of those they need."""
    targets = [f"//tools/rules/install:{name}" for name in names]
    with tempfile.TemporaryDirectory() as folder:
        events = pathlib.Path(folder, "events.json")
        # Without --config=opt: the layers are optimised anyway, and the output
        # folder of Bazel depends on the configuration around them.
        command = [*_bazel_command(program), "build", "--show_result=0",
                   f"--build_event_json_file={events}", *targets]
        result = subprocess.run(command, cwd=workspace, check=False)
        if result.returncode:
            raise BuildError(
                f"bazel build {' '.join(targets)} failed with exit code "
                f"{result.returncode}, must be 0; its messages are above")
        found = _descriptions(events.read_text())
    missing = [name for name in names if name not in found]
    if missing:
        raise BuildError(
            f"bazel build made no description of {','.join(missing)}; "
            "run bazel clean and this command again")
    return found


def _descriptions(events):
    """Returns {layer: description} from Bazel's list of what it built."""
    found = {}
    for line in events.splitlines():
        files = json.loads(line).get("namedSetOfFiles", {}).get("files", [])
        for file in files:
            path = urllib.parse.unquote(file.get("uri", "")[len("file://"):])
            if path.endswith(".layer.json"):
                layer = json.loads(pathlib.Path(path).read_text())
                layer["root"] = path.partition("/bazel-out/")[0]
                found[layer["name"]] = layer
    return {name: found[name] for name in NAMES if name in found}


def entries(layers, version, libraries="lib", prefix=None):
    """Returns {path in the prefix: Entry}; exports.py explains the arguments."""
    major = version.split(".", maxsplit=1)[0]
    result = {}
    for name, layer in layers.items():
        root = pathlib.Path(layer["root"])
        for include, path in layer["headers"].items():
            result[f"include/{include}"] = Entry(copy=str(root / path))
        library = f"{libraries}/libpoise_{name}"
        result[f"{library}.so.{major}"] = Entry(
            copy=str(root / layer["shared"]))
        result[f"{library}.so"] = Entry(link=f"libpoise_{name}.so.{major}")
        result[f"{library}.a"] = Entry(copy=str(root / layer["static"]))
        result[f"{libraries}/pkgconfig/poise_{name}.pc"] = Entry(
            text=exports.pkg_config(layer, version, libraries, prefix))
        result[f"{libraries}/cmake/poise/poise_{name}.cmake"] = Entry(
            text=exports.cmake_targets(layer, major, libraries))
        defines = layer["defines"]
    result["include/poise/math/installed_alignment.h"] = Entry(
        text=exports.alignment_header(defines))
    result[f"{libraries}/cmake/poise/poiseConfig.cmake"] = Entry(
        text=exports.cmake_config(NAMES))
    result[f"{libraries}/cmake/poise/poiseConfigVersion.cmake"] = Entry(
        text=exports.cmake_version(version))
    return result

# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Compiles a program for each peer, all with the same flags.

An object file is named by a digest of all that it depends on, so that it is
compiled once.
"""

import collections
import concurrent.futures
import hashlib
import os
import subprocess

FLAGS = ("-std=c++17", "-O3", "-DNDEBUG", "-w")

# Parts of this workspace that a program is linked with: all sources of folders,
# single sources, and libraries that pkg-config finds.
Parts = collections.namedtuple("Parts", "folders sources libraries",
                               defaults=((),))
SOLVER = Parts(("hqp", "hqp/fast"), (
    "math/rank.cc", "tests/peers/bounded_rows.cc", "tests/peers/measure.cc",
    "tests/peers/tick_file.cc"))
MATH_OF_DYNAMICS = (
    "math/inertia.cc", "math/pose.cc", "math/quaternion.cc", "math/se3.cc",
    "math/se3_jacobian.cc", "math/so3.cc", "math/so3_jacobian.cc",
    "math/spatial.cc")
DYNAMICS = Parts(("dynamics", "dynamics/simd"), (
    *MATH_OF_DYNAMICS, "tests/peers/tree_file.cc",
    "tests/util/random_tree.cc"))
CONTROL = Parts(
    ("dynamics", "dynamics/simd", "hqp", "hqp/fast", "robot",
     "robot/collision", "robot/control", "robot/control/easing",
     "robot/control/posture", "robot/control/tasks", "robot/feet",
     "robot/mesh", "robot/profile", "robot/urdf"),
    (*MATH_OF_DYNAMICS, "math/rank.cc", "math/rpy.cc",
     "tests/peers/measure_controllers.cc", "tests/peers/poise_controller.cc",
     "tests/peers/state_file.cc", "tests/util/load_humanoid.cc"),
    ("tinyxml2", "urdfdom", "yaml-cpp"))
NOT_LINKED = ("_test.cc", "_benchmark.cc")

# Folders of the headers that these sources include.
OUR_HEADERS = (*CONTROL.folders, "math", "tests/peers", "tests/util")


class BuildError(Exception):
    """A source that does not compile, as one line."""


def run(command, text=None):
    try:
        result = subprocess.run(command, input=text, capture_output=True,
                                text=True, check=False)
    except FileNotFoundError as error:
        raise BuildError(f"{command[0]} is not installed; "
                         "tools/setup.sh installs it") from error
    if result.returncode != 0:
        lines = result.stderr.splitlines() or ["no message"]
        first = next((line for line in lines if "error" in line
                      or "undefined reference" in line), lines[-1])
        raise BuildError(first)
    return result.stdout


def our_sources(root, parts):
    """Returns the sources of Poise that a program is linked with."""
    sources = [path for folder in parts.folders
               for path in sorted((root / folder).glob("*.cc"))
               if not str(path).endswith(NOT_LINKED)]
    return sources + [root / name for name in parts.sources]


class Builder:
    """Compiles in a folder; `root` is Poise's workspace."""

    def __init__(self, root, out, parts, flags):
        self.root = root
        self.out = out
        self.parts = parts
        self.flags = (*FLAGS, *flags)
        (out / "objects").mkdir(parents=True, exist_ok=True)
        libraries = ["pkg-config", *parts.libraries]
        self.cflags = run([*libraries, "eigen3", "--cflags"]).split()
        self.libs = (run([*libraries, "--libs"]).split()
                     if parts.libraries else [])
        self.compiler = run(["g++", "--version"])
        self.our_include = self.link_includes("ours", {"poise": root})
        self.our_headers = self.digest_of(
            path for folder in OUR_HEADERS
            for path in sorted((root / folder).glob("*.h")))

    def link_includes(self, name, links):
        """Returns a folder in which the links have their names."""
        folder = self.out / "include" / name
        folder.mkdir(parents=True, exist_ok=True)
        for link, target in links.items():
            path = folder / link
            if path.is_symlink():
                path.unlink()
            path.symlink_to(target)
        return folder

    def generate(self, name, headers):
        """Returns a folder with the headers of a peer's own build."""
        folder = self.out / "include" / f"{name}-generated"
        folder.mkdir(parents=True, exist_ok=True)
        for path, text in headers:
            (folder / path).parent.mkdir(parents=True, exist_ok=True)
            (folder / path).write_text(text)
        return folder

    @staticmethod
    def digest_of(paths):
        digest = hashlib.sha256()
        for path in paths:
            digest.update(f"{path}\n".encode())
            digest.update(path.read_bytes())
        return digest.hexdigest()

    def compile(self, text, includes, headers):
        """Returns the object of a source, compiled unless it exists."""
        command = ["g++", *self.flags, *self.cflags,
                   *(f"-I{folder}" for folder in includes)]
        key = "\n".join([self.compiler, *command, headers, text])
        name = hashlib.sha256(key.encode()).hexdigest()[:20]
        path = self.out / "objects" / f"{name}.o"
        if not path.exists():
            part = path.with_suffix(".part")
            run([*command, "-x", "c++", "-c", "-", "-o", str(part)], text)
            part.rename(path)
        return path

    def jobs_of(self, peer, folder, boost):
        """Returns the arguments of compile() for a peer and its adapter.

        `folder` has the checkouts, `boost` has Boost's headers or is None.
        """
        checkouts = [(each, folder / each.name) for each in peer.checkouts()]
        # A generated header may replace one of a checkout.
        theirs = [self.generate(peer.name, [
            header for each, _ in checkouts for header in each.generated])]
        theirs += [self.link_includes(peer.name, {
            link: checkout / target for each, checkout in checkouts
            for link, target in each.links.items()})]
        theirs += [boost] if boost else []
        headers = self.digest_of(
            path for include in (theirs[0], *sorted(theirs[1].iterdir()))
            for path in sorted(include.rglob("*.h*")) if path.is_file())
        jobs = [(self.adapter(name).read_text(), (self.our_include, *theirs),
                 self.our_headers + headers) for name in peer.adapters]
        for each, checkout in checkouts:
            for source in each.sources:
                path = checkout / source
                if not path.is_file():
                    raise BuildError(f"{path} does not exist, want {each.url} "
                                     f"at {each.commit}")
                jobs.append((each.text(path), (*theirs, path.parent), headers))
        return jobs

    def adapter(self, name):
        return self.root / "tests/peers" / name

    def program(self, name, jobs=(), adapter=None):
        """Returns a program, linked with the parts of Poise.

        `jobs` are those of a peer, see jobs_of(). Poise's own program has an
        adapter instead.
        """
        sources = our_sources(self.root, self.parts)
        sources += [self.adapter(adapter)] if adapter else []
        jobs = [*jobs, *((path.read_text(), (self.our_include,),
                          self.our_headers) for path in sources)]
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            objects = list(pool.map(lambda job: self.compile(*job), jobs))
        program = self.out / name
        run(["g++", *map(str, objects), "-o", str(program), *self.libs])
        return program

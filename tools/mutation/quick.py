# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Tries a mutant of a .cc file without Bazel, some five times as fast.

Bazel has built everything once; here one source is compiled again, by Bazel's
own command but on precompiled headers, linked to its shared library, and the
tests, which link dynamically, are run with that library in front.
"""

import pathlib
import re
import resource
import shlex
import shutil
import subprocess
import tempfile

_MEMORY = 8 << 30  # A mutant may allocate for ever.


def parse_commands(aquery):
    """{source: (object, compiler's arguments)} from aquery's text."""
    commands = {}
    for action in aquery.split("\naction "):
        match = re.search(r"Command Line: \(exec (.*?)\)\n", action + "\n", re.S)
        if not match:
            continue
        arguments = shlex.split(match.group(1).replace("\\\n", " "))
        if "-c" not in arguments or "-o" not in arguments:
            continue
        source = arguments[arguments.index("-c") + 1]
        target = arguments[arguments.index("-o") + 1]
        if target.endswith(".pic.o"):
            commands[source] = (target, arguments)
    return commands


class QuickBuild:
    """One source, ready to be compiled and tested with slips in it."""

    def __init__(self, root, source, command, text, environment):
        self._root = pathlib.Path(root).resolve()  # Bazel's execution root.
        self._object, arguments = command
        self._environment = environment
        self._folder = pathlib.Path(tempfile.mkdtemp(prefix="poise-mutant-"))
        self._flags = self._without_outputs(arguments)
        headers = re.findall(r"^#include .*$", text, re.M)
        prefix = self._folder / "prefix.h"
        prefix.write_text("\n".join(headers) + "\n")
        self._run(
            self._flags + ["-x", "c++-header", str(prefix), "-o", f"{prefix}.gch"]
        )
        self._original = self._compile(text)
        self.works = self._original is not None and self._link()

    def close(self):
        shutil.rmtree(self._folder, ignore_errors=True)

    def build(self, text):
        """Whether it compiles, and to other code: True, False, or None."""
        code = self._compile(text)
        if code is None:
            return None
        if code == self._original:
            return False
        return self._link() or None

    def passes(self, label, seconds):
        """Whether a test passes with the library of the last build()."""
        package, name = label[2:].split(":")
        binary = self._bin() / package / name
        workspace = pathlib.Path(f"{binary}.runfiles") / "poise"
        scratch = self._folder / "scratch"
        scratch.mkdir(exist_ok=True)
        environment = dict(
            self._environment, PATH="/usr/local/bin:/usr/bin:/bin",
            LD_LIBRARY_PATH=str(self._folder), TEST_TMPDIR=str(scratch),
            TEST_SRCDIR=str(workspace.parent), TEST_WORKSPACE="poise",
            GTEST_FAIL_FAST="1",
        )
        try:
            return subprocess.run(
                [str(binary)], cwd=workspace, env=environment, timeout=seconds,
                stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                preexec_fn=_limit_memory,
            ).returncode == 0
        except subprocess.TimeoutExpired:
            return False

    def _bin(self):
        parts = pathlib.Path(self._object).parts
        return self._root.joinpath(*parts[:3])  # bazel-out/k8-fastbuild/bin

    def _library(self):
        """Where the mutated library goes: under the name that tests look for."""
        folder = pathlib.Path(self._object).parent  # .../hqp/_objs/cascade
        built = self._root / folder.parent.parent / f"lib{folder.name}.so"
        for link in (self._bin() / "_solib_k8").iterdir():
            if link.resolve() == built.resolve():
                return self._folder / link.name
        return self._folder / built.name

    def _link(self):
        others = [
            str(o) for o in sorted((self._root / self._object).parent.glob("*.pic.o"))
            if o.name != pathlib.Path(self._object).name
        ]
        return self._run(
            ["/usr/bin/g++", "-shared", "-o", str(self._library()),
             str(self._folder / "mutant.o")] + others
        )

    def _compile(self, text):
        source, code = self._folder / "mutant.cc", self._folder / "mutant.o"
        source.write_text(text)
        done = self._run(
            self._flags + ["-include", str(self._folder / "prefix.h"),
                           "-c", str(source), "-o", str(code)]
        )
        return code.read_bytes() if done else None

    def _run(self, command):
        return subprocess.run(
            command, cwd=self._root, stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        ).returncode == 0

    @staticmethod
    def _without_outputs(arguments):
        kept, i = [], 0
        while i < len(arguments):
            if arguments[i] in ("-MF", "-c", "-o"):
                i += 2
                continue
            if arguments[i] != "-MD":
                kept.append(arguments[i])
            i += 1
        return kept


def _limit_memory():
    resource.setrlimit(resource.RLIMIT_AS, (_MEMORY, _MEMORY))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Tries a mutant without Bazel, some five times as fast.

Bazel has built everything once; here one source is compiled again, by Bazel's
own command but on precompiled headers, linked to its shared library, and the
tests, which link dynamically, are run with that library in front. For a header,
all in its layer that its own tests are made of is compiled again.
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
    """Returns {source: (object, compiler's arguments)} from aquery's text."""
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


class _Unit:
    """A source, compiled with Bazel's command on precompiled headers."""

    def __init__(self, root, folder, source, command, headers):
        self.object, arguments = command
        self.source = source
        self._root, self._folder = root, folder
        self._name = source.replace("/", "_")
        self._flags = _without_files(arguments)
        prefix = folder / f"{self._name}.h"
        prefix.write_text("\n".join(headers) + "\n")
        self._prefix = ["-include", str(prefix)]
        _run(root, self._flags + [
            "-x", "c++-header", str(prefix), "-o", f"{prefix}.gch"
        ])

    def compile(self, path=None, flags=()):
        """Compiles the source or its replacement; returns the code, or None."""
        self.code = self._folder / f"{self._name}.o"
        done = _run(self._root, [self._flags[0], *flags] + self._flags[1:] + (
            self._prefix + ["-c", str(path or self.source), "-o", str(self.code)]
        ))
        return self.code.read_bytes() if done else None

    def link_library(self):
        """Links the shared library under the name that tests load."""
        folder = pathlib.Path(self.object).parent  # .../hqp/_objs/cascade
        built = self._root / folder.parent.parent / f"lib{folder.name}.so"
        name = built.name
        for link in (_bin(self._root, self.object) / "_solib_k8").iterdir():
            if link.resolve() == built.resolve():
                name = link.name
        others = [
            str(o) for o in sorted((self._root / self.object).parent.glob("*.pic.o"))
            if o.name != pathlib.Path(self.object).name
        ]
        return _run(self._root, [
            "/usr/bin/g++", "-shared", "-o", str(self._folder / name),
            str(self.code), *others,
        ])


class _Build:
    """A folder with the outputs of a mutant, searched before Bazel's."""

    def __init__(self, root, an_object, environment):
        self._root = pathlib.Path(root).resolve()  # Bazel's execution root.
        self._bin = _bin(self._root, an_object)
        self._environment = environment
        self._folder = pathlib.Path(tempfile.mkdtemp(prefix="poise-mutant-"))

    def close(self):
        shutil.rmtree(self._folder, ignore_errors=True)

    def passes(self, label, seconds):
        """Returns whether a test passes with the libraries of the last build()."""
        package, name = label[2:].split(":")
        built = self._bin / package / name
        own = self._folder / name
        workspace = pathlib.Path(f"{built}.runfiles") / "poise"
        scratch = self._folder / "scratch"
        scratch.mkdir(exist_ok=True)
        environment = dict(
            self._environment, PATH="/usr/local/bin:/usr/bin:/bin",
            LD_LIBRARY_PATH=f"{self._folder}:{self._bin}/_solib_k8",
            TEST_TMPDIR=str(scratch), TEST_SRCDIR=str(workspace.parent),
            TEST_WORKSPACE="poise", GTEST_FAIL_FAST="1",
        )
        try:
            return subprocess.run(
                [str(own if own.exists() else built)], cwd=workspace,
                env=environment, timeout=seconds, stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL, preexec_fn=_limit_memory,
            ).returncode == 0
        except subprocess.TimeoutExpired:
            return False


class SourceBuild(_Build):
    """One source, prepared to compile and test its mutants."""

    def __init__(self, root, source, command, text, environment):
        super().__init__(root, command[0], environment)
        headers = re.findall(r"^#include .*$", text, re.M)
        self._unit = _Unit(self._root, self._folder, source, command, headers)
        self._original = self._compile(text)
        self.works = self._original is not None and self._unit.link_library()

    def build(self, text):
        """Returns True for different code, False for equal code, None for an error."""
        code = self._compile(text)
        if code is None:
            return None
        if code == self._original:
            return False
        return self._unit.link_library() or None

    def _compile(self, text):
        mutant = self._folder / "mutant.cc"
        mutant.write_text(text)
        return self._unit.compile(mutant)


class HeaderBuild(_Build):
    """A header, and the sources of its own layer that some tests take it from:
    the tests', and those of the libraries that they are linked with."""

    def __init__(self, root, header, commands, tests, environment):
        super().__init__(root, next(iter(commands.values()))[0], environment)
        self._header = header
        self._tests, self._libraries = [], []
        linked = set()
        for label in tests:
            package, name = label[2:].split(":")
            source = f"{package}/{name}.cc"
            parameters = self._bin / package / f"{name}-2.params"
            if source not in commands or not parameters.is_file():
                self.works = False
                return
            arguments = parameters.read_text().split("\n")
            linked.update(a for a in arguments if a.startswith("-l"))
            if self._reads_header(commands[source][0]):
                unit = self._make_unit(source, commands[source])
                self._tests.append((unit, name, arguments))
        for source, command in commands.items():
            folder = pathlib.Path(command[0]).parent
            package = "/".join(pathlib.Path(source).parts[:-1])
            mangled = package.replace("_", "_U").replace("/", "_S")
            name = folder.name.replace("_", "_U")
            if f"-l{mangled}_Slib{name}" in linked and self._reads_header(command[0]):
                self._libraries.append(self._make_unit(source, command))
        self._originals = self._compile()
        self.works = (
            len(self._originals) > 0 and None not in self._originals and self._link()
        )

    def build(self, text):
        """Returns True for different code, False for equal code, None for an error."""
        place = self._folder / "poise" / self._header
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_text(text)
        codes = self._compile(["-iquote", str(self._folder)])
        if None in codes:
            return None
        if codes == self._originals:
            return False
        return self._link() or None

    def _dependencies(self, an_object):
        listed = (self._root / an_object).with_suffix(".d").read_text()
        return [
            path for path in listed.replace("\\\n", " ").split()[1:]
            if not path.startswith(("/", "external/"))
            and (self._root / path).is_file()
        ]

    def _reads_header(self, an_object):
        # Bazel offers the header under poise/, in a folder of its target's.
        return any(
            path.endswith(f"/poise/{self._header}")
            for path in self._dependencies(an_object)
        )

    def _make_unit(self, source, command):
        """On what its own files take from elsewhere: no slip is in that."""
        headers = []
        for path in self._dependencies(command[0]):
            headers += re.findall(
                r"^#include <.*$", (self._root / path).read_text(), re.M
            )
        unique = list(dict.fromkeys(headers))
        return _Unit(self._root, self._folder, source, command, unique)

    def _compile(self, flags=()):
        codes = []
        for unit in self._libraries + [unit for unit, _, _ in self._tests]:
            codes.append(unit.compile(flags=flags))
            if codes[-1] is None:
                break
        return codes

    def _link(self):
        if not all(unit.link_library() for unit in self._libraries):
            return False
        for unit, name, arguments in self._tests:
            changed = {
                unit.object: str(unit.code),
                f"{self._bin.relative_to(self._root)}/{unit.source[:-3]}":
                    str(self._folder / name),
            }
            line = [changed.get(a, a) for a in arguments if a]
            if not _run(self._root, ["/usr/bin/g++", f"-L{self._folder}"] + line):
                return False
        return True


def _bin(root, an_object):
    return root.joinpath(*pathlib.Path(an_object).parts[:3])  # .../k8-fastbuild/bin


def _run(folder, command):
    return subprocess.run(
        command, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
    ).returncode == 0


def _without_files(arguments):
    """Without those written and, as GCC takes one only, a precompiled header."""
    kept, i = [], 0
    while i < len(arguments):
        if arguments[i] in ("-MF", "-c", "-o", "-include"):
            i += 2
            continue
        if arguments[i] not in ("-MD", "-Winvalid-pch"):
            kept.append(arguments[i])
        i += 1
    return kept


def _limit_memory():
    resource.setrlimit(resource.RLIMIT_AS, (_MEMORY, _MEMORY))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

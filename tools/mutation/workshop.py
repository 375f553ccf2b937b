# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""A copy of the tree in which mutants are built and tested by Bazel."""

import os
import pathlib
import re
import subprocess
import time

KILLED, SURVIVED, INVALID, SAME = "killed", "survived", "invalid", "same code"
_LEFT_OUT = "lint|benchmark|local|browser|manual|slow"


class BazelError(Exception):
    pass


class Workshop:
    """The copy, an output base of its own, and what tests which file.

    The first build may take what it can from the disk cache that the user's
    bazelrc names; no mutant's output ever goes there.
    """

    def __init__(self, workspace, folder, bazel_flags=()):
        self.workspace = pathlib.Path(workspace)
        self.folder = pathlib.Path(folder)
        self.tree = self.folder / "tree"
        self.log = self.folder / "bazel.log"
        self._flags = list(bazel_flags)
        self._stages = {}
        self._objects = {}
        self.folder.mkdir(parents=True, exist_ok=True)

    def copy(self):
        """Makes the copy what the user's tree is now, uncommitted files too."""
        listed = subprocess.run(
            ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
            cwd=self.workspace, check=True, stdout=subprocess.PIPE,
        ).stdout.decode()
        wanted = {p for p in listed.split("\0") if (self.workspace / p).is_file()}
        for path in wanted:
            self._update(self.tree / path, self.workspace / path)
        for root, folders, files in os.walk(self.tree):
            folders[:] = [f for f in folders if not f.startswith("bazel-")]
            for file in files:
                path = pathlib.Path(root, file)
                if str(path.relative_to(self.tree)) not in wanted:
                    path.unlink()

    @staticmethod
    def _update(copy, original):
        content = original.read_bytes()
        if not copy.is_file() or copy.read_bytes() != content:
            copy.parent.mkdir(parents=True, exist_ok=True)
            copy.write_bytes(content)
            copy.chmod(original.stat().st_mode)

    def stages(self, path, reach):
        """The tests that depend on a file: its own, its layer's, the rest."""
        if path not in self._stages:
            package, name = os.path.split(path)
            stem = name.rsplit(".", 1)[0]
            label = f"//{package}:{name}"
            tests = set(self._query(
                f'kind("cc_test rule", rdeps(//..., {label})) except '
                f'attr(tags, "{_LEFT_OUT}", //...)'
            ))
            near = set(self._query(
                f'kind("cc_test rule", rdeps(//{package}:all, {label}, 2)) except '
                f'attr(tags, "{_LEFT_OUT}", //...)'
            ))
            own = {t for t in tests if t.startswith(f"//{package}:{stem}")} or near
            layer = {t for t in tests if t.startswith(f"//{package}")} - own
            self._stages[path] = [own, layer, tests - own - layer]
        wanted = {"file": 1, "layer": 2, "all": 3}[reach]
        return [sorted(stage) for stage in self._stages[path][:wanted] if stage]

    def baseline(self, path, reach):
        """Builds and tests the file as it is; how long its slowest test took."""
        slowest = 0.0
        for tests in self.stages(path, reach):
            code, output = self._bazel("test", *tests, cached=True)
            if code != 0:
                raise BazelError(
                    f"{path}: its tests fail without a mutant; see {self.log}"
                )
            times = re.findall(r"PASSED in ([\d.]+)s", output)
            slowest = max([slowest] + [float(t) for t in times])
        self._objects[path] = self._find_objects(path)
        return slowest

    def attempt(self, path, text, reach, limit):
        """Tests the tree with the file replaced: (verdict, by whom, seconds)."""
        file = self.tree / path
        original = file.read_text()
        start = time.monotonic()
        try:
            file.write_text(text)
            verdict, by = self._judge(path, reach, limit)
        finally:
            file.write_text(original)
        return verdict, by, time.monotonic() - start

    def _judge(self, path, reach, limit):
        first = True
        for tests in self.stages(path, reach):
            code, output = self._bazel(
                "test", *tests, "--notest_keep_going", f"--test_timeout={limit}",
                "--run_under=prlimit --as=8589934592",
            )
            if code == 1:
                return INVALID, ""
            if code == 3:
                failed = re.search(r"^(//\S+) .*(FAILED|TIMEOUT)", output, re.M)
                return KILLED, failed.group(1) if failed else tests[0]
            if code != 0:
                raise BazelError(f"bazel ended with {code}; see {self.log}")
            if first and self._is_same_code(path):
                return SAME, ""
            first = False
        return SURVIVED, ""

    def _find_objects(self, path):
        """What the compiler made of a source; {} for a header."""
        package, name = os.path.split(path)
        if not name.endswith(".cc"):
            return {}
        folder = self.tree / "bazel-bin" / package / "_objs"
        return {
            str(o): o.read_bytes() for o in folder.glob(f"*/{name[:-3]}*.o")
        }

    def _is_same_code(self, path):
        objects = self._objects.get(path)
        return bool(objects) and objects == self._find_objects(path)

    def _query(self, expression):
        code, output = self._bazel("query", expression, "--keep_going")
        if code not in (0, 3):
            raise BazelError(f"bazel query failed; see {self.log}")
        return [line for line in output.splitlines() if line.startswith("//")]

    def _bazel(self, command, *arguments, cached=False):
        line = ["bazel", f"--output_base={self.folder / 'output'}", command]
        if command == "test":
            line += [
                "--noshow_progress", "--color=no", "--test_output=summary",
                "--test_summary=short", *self._flags,
            ]
            if not cached:
                line.append("--disk_cache=")
        with open(self.log, "w") as log:
            process = subprocess.run(
                line + list(arguments), cwd=self.tree, text=True,
                stdout=subprocess.PIPE, stderr=log,
            )
        with open(self.log, "a") as log:
            log.write(process.stdout)
        if process.returncode == 8:
            raise KeyboardInterrupt
        return process.returncode, process.stdout

    def close(self):
        subprocess.run(
            ["bazel", f"--output_base={self.folder / 'output'}", "shutdown"],
            cwd=self.tree, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
        )

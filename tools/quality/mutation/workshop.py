# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""A copy of the tree in which mutants are built and tested by Bazel."""

import os
import pathlib
import re
import subprocess
import time

import quick

KILLED, SURVIVED, INVALID, SAME = "killed", "survived", "invalid", "same code"
_LEFT_OUT = "lint|benchmark|local|browser|manual|slow|fuzzer"
_MEMORY = 8 << 30  # Bytes; a mutant may allocate for ever.


class BazelError(Exception):
    pass


class Workshop:
    """The copy, its output base, and the tests of each file.

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
        self._quick = (None, None)  # The source that is ready, and its build.
        self._commands = {}
        self.folder.mkdir(parents=True, exist_ok=True)

    def copy(self):
        """Updates the copy from the user's tree, with uncommitted files."""
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
        """Returns the tests that depend on a file: its own, those of its layer, the rest."""
        if path not in self._stages:
            package, name = os.path.split(path)
            stem = name.rsplit(".", 1)[0]
            layer_name = package.split("/")[0]
            label = f"//{package}:{name}"
            tests = set(self._query(
                f'kind("cc_test rule", rdeps(//..., {label})) except '
                f'attr(tags, "{_LEFT_OUT}", //...)'
            ))
            near = set(self._query(
                f'kind("cc_test rule", rdeps(//{layer_name}/..., {label}, 2)) except '
                f'attr(tags, "{_LEFT_OUT}", //...)'
            ))
            own = {t for t in tests if t.startswith(f"//{package}:{stem}")} or near
            layer = {t for t in tests if re.match(f"//{layer_name}[/:]", t)} - own
            self._stages[path] = [own, layer, tests - own - layer]
        wanted = {"file": 1, "layer": 2, "all": 3}[reach]
        return [sorted(stage) for stage in self._stages[path][:wanted] if stage]

    def baseline(self, path, reach):
        """Builds and tests the unchanged file; returns the time of its slowest test."""
        slowest = 0.0
        for tests in self.stages(path, reach):
            code, output = self._bazel("test", *tests, cached=True)
            if code != 0:
                raise BazelError(
                    f"{path}: its tests fail without a mutant; see {self.log}"
                )
            times = re.findall(r"PASSED in ([\d.]+)s", output)
            slowest = max([slowest] + [float(t) for t in times])
        return slowest

    def attempt(self, path, text, reach, limit):
        """Tests the tree with the file replaced; returns (verdict, test, seconds)."""
        start = time.monotonic()
        stages = self.stages(path, reach)
        build = self._quick_build(path, stages, limit)
        verdict, by = SAME, ""
        if build is not None:
            quick_stages = stages if path.endswith(".cc") else stages[:1]
            verdict, by = self._judge_quickly(build, text, quick_stages, limit)
            stages = stages[len(quick_stages):]
        if verdict in (SAME, SURVIVED) and stages:
            # Code that is unchanged for a header's own tests may differ for
            # other tests, which call more of the header.
            last, by = self._judge(path, text, stages, limit)
            verdict = last if last != SAME else verdict
        return verdict, by, time.monotonic() - start

    def _quick_build(self, path, stages, limit):
        """Of a source with all tests, of a header with the tests of its own; None
        if these do not pass in this way without a mutant."""
        ready, build = self._quick
        if ready != path:
            if build is not None:
                build.close()
            build = self._make_quick_build(path, stages)
            tests = sum(stages if path.endswith(".cc") else stages[:1], [])
            if build is not None and not (
                build.works and all(build.passes(test, limit) for test in tests)
            ):
                build.close()
                build = None
            self._quick = (path, build)
        return build

    def _make_quick_build(self, path, stages):
        layer = path.split("/")[0]
        if layer not in self._commands:
            self._commands[layer] = quick.parse_commands(self._bazel(
                "aquery", f'mnemonic("CppCompile", //{layer}/...)'
            )[1])
        commands = self._commands[layer]
        root = self.tree / "bazel-out/.."
        if path.endswith(".h") and stages:
            try:
                return quick.HeaderBuild(
                    root, path, commands, stages[0], self._test_environment()
                )
            except FileNotFoundError:
                return None  # Not all of it was compiled here.
        if path not in commands:
            return None
        return quick.SourceBuild(
            root, path, commands[path], (self.tree / path).read_text(),
            self._test_environment(),
        )

    def _test_environment(self):
        """Returns the test environment of .bazelrc and flags, without shrinking."""
        words = (self.tree / ".bazelrc").read_text().split() + self._flags
        found = {}
        for word in words:
            match = re.match(r"--test_env=(\w+)(?:=(.*))?$", word)
            if match and match.group(1) in ("RC_PARAMS", "POISE_SHARED"):
                name, value = match.groups()
                found[name] = os.environ.get(name, "") if value is None else value
        found["RC_PARAMS"] = found.get("RC_PARAMS", "") + " noshrink=1"
        return found

    def _judge_quickly(self, build, text, stages, limit):
        built = build.build(text)
        if built is None:
            return INVALID, ""
        if not built:
            return SAME, ""
        for test in sum(stages, []):
            if not build.passes(test, limit):
                return KILLED, test
        return SURVIVED, ""

    def _judge(self, path, text, stages, limit):
        file = self.tree / path
        original = file.read_text()
        verdict = SAME
        try:
            file.write_text(text)
            for tests in stages:
                code, output = self._bazel(
                    "test", *tests, "--notest_keep_going",
                    f"--test_timeout={limit}",
                    f"--run_under=prlimit --as={_MEMORY}",
                )
                if code == 1:
                    return INVALID, ""
                if code == 3:
                    failed = re.search(r"^(//\S+) .*(FAILED|TIMEOUT)", output, re.M)
                    return KILLED, failed.group(1) if failed else tests[0]
                if code != 0:
                    raise BazelError(f"bazel ended with {code}; see {self.log}")
                if not re.search(r"^Executed 0 out of ", output, re.M):
                    verdict = SURVIVED  # Not all came out as it had been.
        finally:
            file.write_text(original)
        return verdict, ""

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
        if self._quick[1] is not None:
            self._quick[1].close()
        subprocess.run(
            ["bazel", f"--output_base={self.folder / 'output'}", "shutdown"],
            cwd=self.tree, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
        )

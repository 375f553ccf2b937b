#!/usr/bin/env python3
# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Runs the shell commands of README, CONTRIBUTING and docs in a clean clone.

Usage: run_pages.py [--list] [--optimised] [--disk-cache DIR] [PAGE...]
Takes the code blocks of the pages in their order, clones the present commit into
a temporary folder, and runs each command there once, with a home folder of its
own. That folder gets your .bazelrc. NOT_RUN below names the commands that are
left out, with reasons.
  --list            prints the commands, and which of them do not run
  --optimised       runs only the commands that build with --config=opt, which
                    are left out otherwise
  --disk-cache DIR  Bazel's cache of built files; without it, all is built anew
  PAGE              runs the commands of these pages only, as docs/hqp.md
Exit code: 0 if each command ended as it must, 1 if one did not, 2 for bad input.
"""

import argparse
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

import pages

ROOT = pathlib.Path(__file__).resolve().parents[3]

# Beginnings of commands that do not run here, each with the reason.
NOT_RUN = {
    "tools/setup.sh && bazel test //...": ".ci/run runs it",
    "bazel test //math/... //dynamics/...": "a part of bazel test //...",
    "bazel test --config=lint //...": "a part of bazel test //...",
    "bazel test --config=sanitize //...": ".ci/run runs it, by layers",
    "POISE_TOLERANCE_SCALE=0": "prints residuals as failures of tests",
    "POISE_SHARED=DIR": ".ci/run runs it, if it has such a folder",
    ".ci/run": "it runs this",
    "sudo apt install": "changes the system; package_test.sh does it in a root",
    "tools/quality/migrate_includes": "needs a project of the reader; has a test",
    "bazel run //tests:hqp_night": "takes hours",
    "bazel run --config=opt //tests/benchmarks:hqp_benchmark":
        "measures for minutes",
    "bazel run //tests/exact:judge": "takes an hour",
    "bazel run //tests/peers:compare": "needs checkouts of other libraries",
    "bazel run //tools:mutate -- --ledger": ".ci/run reads the ledger",
    "bazel run //tools:push_map": "takes an hour",
    "bazel run //tools:robustness -- --robots DIR":
        ".ci/run runs it, if it has robots",
    "bazel test //hqp/...": "a part of bazel test //...",
    "bazel test //python:tests": ".ci/run runs it",
}

# Commands that build with --config=opt, or need what those build.
OPTIMISED = r"--config=opt|poise-env"

# Commands that end with another exit code than 0: the robot falls, or a budget cuts
# ticks off.
EXIT_CODES = {
    "bazel run //tools:push -- --scenario strong_push_without_zmp": 1,
    "bazel run //tools:hqp -- --budget-us 80 --max-iterations 500 "
    "push-out/strong_push/solves_0.000_1.060/solve_*.json": 1,
}


def prepare(clone, home):
    """Makes the reader's own files that the pages speak of."""
    shutil.copy(ROOT / "robot/models/humanoid.urdf", clone / "my_robot.urdf")
    project = home / "my_robot"
    project.mkdir()
    page = (ROOT / "docs/quickstart/cmake.md").read_text()
    _, lists = next(pages.blocks(page, "cmake"))
    (project / "CMakeLists.txt").write_text(lists)
    shutil.copy(ROOT / "docs/examples/dynamics/main.cc", project)


def prepare_page(name, clone):
    """Makes the files that only this page speaks of."""
    if name == "docs/scenarios.md":
        text = (ROOT / name).read_text()
        _, scenario = next(pages.blocks(text, "yaml"))
        (clone / "mine.yaml").write_text(scenario)


def reason_not_to_run(command, optimised):
    """Returns why a command does not run, or None."""
    if bool(re.search(OPTIMISED, command)) != optimised:
        return f"runs {'without' if optimised else 'with'} --optimised"
    return next((reason for start, reason in NOT_RUN.items()
                 if command.startswith(start)), None)


def run(command, folder, home):
    """Runs a command; returns its exit code, its output and its seconds."""
    start = time.monotonic()
    result = subprocess.run(
        ["bash", "-euo", "pipefail", "-c", command], cwd=folder, text=True,
        env={**os.environ, "HOME": str(home)}, stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
    return result.returncode, result.stdout, time.monotonic() - start


def page_commands(names):
    """Returns (page, number, command) of the pages, each command once."""
    found = {}
    for path in sorted(pages.pages(ROOT), key=lambda p: p.name != "README.md"):
        name = str(path.relative_to(ROOT))
        if "notebook" in path.parts or path.parent != ROOT and (
                not name.startswith("docs/")) or names and name not in names:
            continue
        for number, command in pages.block_commands(path.read_text()):
            found.setdefault(command, (name, number, command))
    return list(found.values())


def run_all(commands, optimised, work, disk_cache):
    """Runs the commands in a new clone; returns how many ended wrongly."""
    clone, home = work / "poise", work / "home"
    subprocess.run(["git", "clone", "--quiet", ROOT, clone], check=True)
    home.mkdir()
    options = pathlib.Path.home() / ".bazelrc"
    text = options.read_text() if options.is_file() else ""
    if disk_cache:
        text += f"\nbuild --disk_cache={disk_cache}\n"
    (home / ".bazelrc").write_text(text)
    prepare(clone, home)
    failed, page = 0, None
    for name, number, command in commands:
        if reason_not_to_run(command, optimised):
            continue
        if name != page:
            page = name
            prepare_page(name, clone)
        folder = home / "my_robot" if command.startswith("cmake ") else clone
        code, output, seconds = run(command, folder, home)
        wanted = EXIT_CODES.get(command, 0)
        print(f"{seconds:6.1f} s  {name}:{number}: {command}", flush=True)
        if code != wanted:
            failed += 1
            print("\n".join(output.splitlines()[-30:]))
            print(f"run_pages: {name}:{number}: exit code {code}, must be "
                  f"{wanted}: {command}", flush=True)
    return failed


def remove(work):
    """Stops the clone's Bazel and removes all that was made."""
    if (work / "poise").is_dir():
        run("bazel shutdown", work / "poise", work / "home")
    subprocess.run(["chmod", "-R", "u+w", work], check=False)
    shutil.rmtree(work)


def parsed_arguments():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--list", action="store_true")
    parser.add_argument("--optimised", action="store_true")
    parser.add_argument("--disk-cache", metavar="DIR", type=os.path.abspath)
    parser.add_argument("pages", metavar="PAGE", nargs="*")
    arguments = parser.parse_args()
    for name in arguments.pages:
        if not (ROOT / name).is_file():
            parser.error(f"no page '{name}', must be a path from the root of "
                         "the tree, as docs/hqp.md")
    return arguments


def main():
    arguments = parsed_arguments()
    commands = page_commands(arguments.pages)
    reasons = [reason_not_to_run(command, arguments.optimised)
               for _, _, command in commands]
    for (name, number, command), reason in zip(commands, reasons):
        if arguments.list or reason:
            print(f"{name}:{number}: {command}" +
                  (f"  [does not run: {reason}]" if reason else ""))
    if arguments.list:
        return 0
    work = pathlib.Path(tempfile.mkdtemp(prefix="poise_pages."))
    try:
        failed = run_all(commands, arguments.optimised, work,
                         arguments.disk_cache)
    finally:
        remove(work)
    ran = reasons.count(None)
    print(f"pages: {ran - failed} commands ended as they must, {failed} did not")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())

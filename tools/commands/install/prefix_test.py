#!/usr/bin/env python3
# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Tests that a prefix gets all files or none, with a few small files."""

import errno
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import unittest
from unittest import mock

import install
import prefix as prefixes
from layers import Entry

ENTRIES = {
    "include/poise/math/so3.h": Entry(text="// so3\n"),
    "lib/libpoise_math.so.0": Entry(text="shared"),
    "lib/libpoise_math.so": Entry(link="libpoise_math.so.0"),
}
MORE = {"lib/libpoise_hqp.so.0": Entry(text="hqp")}


def tree(folder):
    """Returns {path: content} of all files and empty folders."""
    found = {}
    for path in sorted(folder.rglob("*")):
        if path.is_file():
            found[str(path.relative_to(folder))] = path.read_text()
        elif not any(path.iterdir()):
            found[str(path.relative_to(folder))] = None
    return found


class PrefixTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        self.prefix = self.root / "new" / "prefix"

    def test_installs_and_uninstalls(self):
        prefixes.install(self.prefix, ENTRIES, "0.9.0")
        self.assertEqual(tree(self.prefix)["lib/libpoise_math.so"], "shared")
        (self.prefix / "lib/libpoise_math.so").unlink()
        self.assertEqual(prefixes.uninstall(self.prefix), (3, 1))
        self.assertEqual(tree(self.prefix), {})

    def test_uninstall_keeps_files_and_folders_of_others(self):
        (self.prefix / "lib").mkdir(parents=True)
        (self.prefix / "share").mkdir()
        (self.prefix / "share/notes").write_text("mine")
        before = tree(self.prefix)
        prefixes.install(self.prefix, ENTRIES, "0.9.0")
        prefixes.uninstall(self.prefix)
        self.assertEqual(tree(self.prefix), before)

    def test_removes_files_that_are_not_made_any_more(self):
        prefixes.install(self.prefix, ENTRIES, "0.9.0")
        prefixes.install(self.prefix, MORE, "0.9.0")
        self.assertEqual(sorted(tree(self.prefix)),
                         ["include/poise/math", "lib/libpoise_hqp.so.0",
                          prefixes.MANIFEST])
        prefixes.uninstall(self.prefix)
        self.assertEqual(tree(self.prefix), {})

    def test_knows_which_layers_are_installed(self):
        self.assertEqual(prefixes.installed_layers(self.prefix), [])
        prefixes.install(self.prefix, {
            **ENTRIES, "lib/cmake/poise/poise_math.cmake": Entry(text="x"),
            "lib/cmake/poise/poiseConfig.cmake": Entry(text="x")}, "0.9.0")
        self.assertEqual(prefixes.installed_layers(self.prefix), ["math"])

    def test_installs_again_over_itself(self):
        prefixes.install(self.prefix, ENTRIES, "0.9.0")
        before = tree(self.prefix)
        prefixes.install(self.prefix, ENTRIES, "0.9.0")
        self.assertEqual(tree(self.prefix), before)

    def test_refuses_to_replace_a_file_of_another(self):
        (self.prefix / "lib").mkdir(parents=True)
        (self.prefix / "lib/libpoise_math.so").write_text("mine")
        with self.assertRaisesRegex(prefixes.PrefixError, "is not in"):
            prefixes.install(self.prefix, ENTRIES, "0.9.0")
        self.assertEqual(tree(self.prefix), {"lib/libpoise_math.so": "mine"})

    def test_refuses_a_folder_where_a_file_must_go(self):
        (self.prefix / "lib/libpoise_math.so").mkdir(parents=True)
        with self.assertRaisesRegex(prefixes.PrefixError, "is a folder"):
            prefixes.install(self.prefix, ENTRIES, "0.9.0")

    def test_refuses_a_manifest_with_a_path_outside(self):
        for path in ("/etc/passwd", "../passwd"):
            manifest = self.prefix / prefixes.MANIFEST
            manifest.parent.mkdir(parents=True, exist_ok=True)
            manifest.write_text(f"# Files of Poise 0.9.0\n{path}\n")
            with self.assertRaisesRegex(prefixes.PrefixError, path):
                prefixes.uninstall(self.prefix)

    def test_refuses_a_manifest_that_is_not_text(self):
        manifest = self.prefix / prefixes.MANIFEST
        manifest.parent.mkdir(parents=True)
        manifest.write_bytes(b"\xff\xfe\x00")
        with self.assertRaisesRegex(prefixes.PrefixError, "not a manifest"):
            prefixes.uninstall(self.prefix)

    def test_failure_leaves_no_new_folder(self):
        entries = {**ENTRIES, "lib/x": Entry(copy=str(self.root / "none"))}
        with self.assertRaises(FileNotFoundError):
            prefixes.install(self.prefix, entries, "0.9.0")
        self.assertEqual(list(self.root.iterdir()), [])

    def test_file_where_a_folder_must_go_undoes_all(self):
        self.prefix.mkdir(parents=True)
        (self.prefix / "lib").write_text("mine")
        with self.assertRaises(OSError):
            prefixes.install(self.prefix, ENTRIES, "0.9.0")
        self.assertEqual(tree(self.prefix), {"lib": "mine"})

    def test_failure_at_any_move_restores_the_earlier_installation(self):
        prefixes.install(self.prefix, {**ENTRIES, **MORE}, "0.9.0")
        before = tree(self.prefix)
        newer = {path: Entry(text="new") for path in ENTRIES}
        newer["opt/deep/file"] = Entry(text="new")
        move = pathlib.Path.replace
        for allowed in range(20):
            calls = []

            def limited(source, target, calls=calls, allowed=allowed):
                calls.append(target)
                if len(calls) == allowed + 1:
                    raise KeyboardInterrupt
                return move(source, target)

            with mock.patch.object(pathlib.Path, "replace", limited):
                try:
                    prefixes.install(self.prefix, newer, "0.9.1")
                    break
                except KeyboardInterrupt:
                    self.assertEqual(tree(self.prefix), before)
        self.assertGreater(allowed, 5)
        self.assertEqual(tree(self.prefix)["opt/deep/file"], "new")

    def test_a_failed_undo_keeps_the_replaced_files_and_names_them(self):
        prefixes.install(self.prefix, ENTRIES, "0.9.0")
        newer = {path: Entry(text="new") for path in ENTRIES}
        move, calls = pathlib.Path.replace, []

        def blocked(source, target):
            # The disk gives up after the first file was replaced.
            calls.append(target)
            if len(calls) > 2:
                raise OSError(errno.EIO, "Input/output error", str(source))
            return move(source, target)

        with mock.patch.object(pathlib.Path, "replace", blocked):
            with self.assertRaises(prefixes.UndoError) as caught:
                prefixes.install(self.prefix, newer, "0.9.1")
        (spare,) = self.prefix.glob(".poise-install-*/old")
        self.assertIn("// so3\n", [f.read_text() for f in spare.iterdir()])
        self.assertIn(str(spare), str(caught.exception))
        prefixes.install(self.prefix, newer, "0.9.1")  # As the message says.
        self.assertEqual(
            {path: "new" for path in ENTRIES},
            {path: text for path, text in tree(self.prefix).items()
             if path != prefixes.MANIFEST})

    def test_folders_of_others_with_such_a_name_stay(self):
        notes = self.prefix / ".poise-install-notes" / "thesis.txt"
        notes.parent.mkdir(parents=True)
        notes.write_text("mine")
        # The folder of an installation that still runs, and of one that was
        # killed: 4194305 is above the largest number of a process.
        for process in (os.getppid(), 4194305):
            file = self.prefix / f".poise-install-{process}-ab_1" / "old"
            file.parent.mkdir()
            file.write_text("kept")
        prefixes.install(self.prefix, ENTRIES, "0.9.0")
        prefixes.uninstall(self.prefix)
        self.assertEqual(tree(self.prefix), {
            ".poise-install-notes/thesis.txt": "mine",
            f".poise-install-{os.getppid()}-ab_1/old": "kept"})

    def test_an_interrupt_in_the_last_step_undoes_all(self):
        def last():
            done.append(sorted(tree(self.prefix)))
            raise KeyboardInterrupt

        done = []
        with self.assertRaises(KeyboardInterrupt):
            prefixes.install(self.prefix, ENTRIES, "0.9.0", last)
        self.assertIn(prefixes.MANIFEST, done[0])
        self.assertEqual(list(self.root.iterdir()), [])


class CommandTest(unittest.TestCase):
    def install_with_signal(self, folder, number, word):
        """Installs 99 files slowly, in another process. Sends it a signal when
        it prints the word: "moved" after each move, "tidies" after the last
        one. Returns its exit code."""
        code = (
            "import pathlib, shutil, sys, time, install, prefix, layers\n"
            "move = pathlib.Path.replace\n"
            "remove = shutil.rmtree\n"
            "def slow_move(source, target):\n"
            "    move(source, target)\n"
            "    print('moved', flush=True)\n"
            "    time.sleep(0.01)\n"
            "def slow_remove(*arguments, **options):\n"
            "    print('tidies', flush=True)\n"
            "    time.sleep(0.2)\n"
            "    remove(*arguments, **options)\n"
            "pathlib.Path.replace = slow_move\n"
            "shutil.rmtree = slow_remove\n"
            "x = layers.Entry(text='x')\n"
            "files = {f'lib/{i}': x for i in range(99)}\n"
            "install._make_interruptible()\n"
            "try:\n"
            f"    prefix.install(pathlib.Path({folder!r}), files, '0.9.0',\n"
            "                   install._ignore_signals)\n"
            "except KeyboardInterrupt:\n"
            "    sys.exit(130)\n")
        with subprocess.Popen(
                [sys.executable, "-c", code], stdout=subprocess.PIPE, text=True,
                cwd=pathlib.Path(__file__).resolve().parent) as child:
            while child.stdout.readline().strip() != word:
                self.assertIsNone(child.poll())
            child.send_signal(number)
            child.stdout.read()
            return child.wait(timeout=60)

    def test_signal_undoes_all(self):
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            with tempfile.TemporaryDirectory() as folder:
                self.assertEqual(
                    self.install_with_signal(folder, number, "moved"), 130)
                self.assertEqual(os.listdir(folder), [])

    def test_kill_leaves_what_can_be_installed_again_and_uninstalled(self):
        for again in (True, False):
            with tempfile.TemporaryDirectory() as folder:
                self.install_with_signal(folder, signal.SIGKILL, "moved")
                prefix = pathlib.Path(folder)
                if again:
                    prefixes.install(prefix, ENTRIES, "0.9.0")
                    self.assertEqual(
                        set(tree(prefix)), {*ENTRIES, prefixes.MANIFEST})
                prefixes.uninstall(prefix)
                self.assertEqual(os.listdir(folder), [])

    def test_signal_after_the_last_move_changes_nothing(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            with tempfile.TemporaryDirectory() as folder:
                self.assertEqual(
                    self.install_with_signal(folder, number, "tidies"), 0)
                self.assertEqual(len(tree(pathlib.Path(folder))), 100)

    def test_bad_input_is_one_line_and_exit_code_2(self):
        program = pathlib.Path(install.__file__).resolve()
        for arguments, word in (
                ([], "--prefix"), (["--prefix", "/etc/passwd"], "is a file"),
                (["--prefix", "x", "--layers", "wings"], "'wings'"),
                (["--prefix", "x", "--layers", ""], "no layer"),
                (["--prefix", "/nowhere", "--uninstall"], "does not exist")):
            result = subprocess.run(
                [sys.executable, program, *arguments], text=True, check=False,
                capture_output=True)
            self.assertEqual(result.returncode, 2, arguments)
            self.assertEqual(result.stderr.count("\n"), 1, result.stderr)
            self.assertIn(word, result.stderr)


if __name__ == "__main__":
    unittest.main()

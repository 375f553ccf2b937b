# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Puts files into a prefix, all or none, and removes them again.

The files are first written into a folder inside the prefix, and then moved,
which cannot fail for lack of space. If a move fails or a signal arrives, each
move is undone, last first. If that fails too, the replaced files stay in the
folder, and the error names it. A manifest lists the files and the folders made.
The first move puts a manifest of all old and new files there, so that after a
crash the same command installs, and --uninstall removes, what is there.
"""

import os
import pathlib
import re
import shutil
import tempfile

MANIFEST = "share/poise/install_manifest.txt"
_HEADER = "# Files of Poise "
# Start of the name of the folder inside the prefix. The process's number follows.
_SPARE = ".poise-install-"


class PrefixError(Exception):
    """A prefix that cannot be used, as one line."""


def read_manifest(prefix):
    """Returns (version, paths) of what is installed, or (None, [])."""
    path = prefix / MANIFEST
    if not path.is_file():
        return None, []
    lines = path.read_text(encoding="utf-8", errors="replace").splitlines()
    if not lines or not lines[0].startswith(_HEADER):
        raise PrefixError(f"{path} is not a manifest of Poise: its first line "
                          f"must begin with '{_HEADER}'; remove the file")
    paths = [line for line in lines[1:] if line]
    for line in paths:
        if line.startswith("/") or ".." in line.split("/"):
            raise PrefixError(f"{path} lists '{line}', which is not inside the "
                              "prefix; remove the line")
    return lines[0][len(_HEADER):], paths


def installed_layers(prefix):
    """Returns the names of the layers that a prefix has."""
    _, paths = read_manifest(prefix)
    return [name for path in paths for name in re.findall(
        r"^lib/cmake/poise/poise_(\w+)\.cmake$", path)]


class UndoError(Exception):
    """An installation that was stopped and could not be undone, as one line."""


class _Journal:
    """Changes of a prefix that can be undone."""

    def __init__(self, prefix, spare):
        self.prefix = prefix
        self.spare = spare  # Folder for files that are replaced.
        self.folders = []  # Made, relative to the prefix.
        self._undo = []

    def make_folder(self, relative):
        """Makes a folder and those above."""
        path = self.prefix / relative
        if path.is_dir():
            return
        if relative.parent != relative:
            self.make_folder(relative.parent)
        path.mkdir()
        self.folders.append(relative)
        self._undo.append(path.rmdir)

    def remove(self, relative):
        path = self.prefix / relative
        if not os.path.lexists(path):
            return
        kept = self.spare / str(len(self._undo))
        self._undo.append(lambda: os.path.lexists(kept) and kept.replace(path))
        path.replace(kept)

    def move(self, source, relative):
        path = self.prefix / relative
        self.make_folder(relative.parent)
        self.remove(relative)
        self._undo.append(lambda: os.path.lexists(source) or path.unlink())
        source.replace(path)

    def replace(self, source, relative):
        """Moves a small file; at no moment there is neither the old nor the new
        one."""
        path = self.prefix / relative
        self.make_folder(relative.parent)
        kept = self.spare / str(len(self._undo))
        if path.exists():
            shutil.copyfile(path, kept)
            self._undo.append(lambda: kept.replace(path))
        else:
            self._undo.append(lambda: path.unlink(missing_ok=True))
        source.replace(path)

    def undo(self):
        """Undoes what it can. Raises an UndoError if something is left."""
        failed = []
        while self._undo:
            try:
                self._undo.pop()()
            except OSError as error:
                failed.append(f"{error.filename}: {error.strerror}")
        if failed:
            raise UndoError(
                f"{'; '.join(failed)}; so {self.prefix} has a part of the new "
                f"files, and the replaced ones are in {self.spare}; correct "
                "the cause and run the command again")


def _write(path, entry):
    path.parent.mkdir(parents=True, exist_ok=True)
    if entry.link:
        path.symlink_to(entry.link)
        return
    if entry.copy:
        shutil.copyfile(entry.copy, path)
    else:
        path.write_text(entry.text, encoding="utf-8")
    path.chmod(0o644)


def _check_free(prefix, entries, installed):
    """Refuses to replace a file that is not Poise's."""
    for relative in [*entries, MANIFEST]:
        path = prefix / relative
        if path.is_dir() and not path.is_symlink():
            raise PrefixError(f"{path} is a folder, must be a file; remove it "
                              "or choose another --prefix")
        if os.path.lexists(path) and relative not in installed and (
                relative != MANIFEST):
            raise PrefixError(f"{path} exists and is not in "
                              f"{prefix / MANIFEST}; remove it or choose "
                              "another --prefix")


def _manifest(version, files, folders):
    lines = sorted(files) + sorted((f"{f}/" for f in folders), reverse=True)
    return "\n".join([_HEADER + version, *lines, ""])


def _is_left(folder):
    """Returns whether a folder is of this run, or of one that was killed."""
    match = re.fullmatch(rf"{re.escape(_SPARE)}(\d+)-\w+", folder.name)
    return match is not None and (int(match[1]) == os.getpid() or
                                  not os.path.exists(f"/proc/{match[1]}"))


def _remove_left(prefix):
    """Removes this run's folder of replaced files, and those of runs that were
    killed."""
    for folder in filter(_is_left, prefix.glob(f"{_SPARE}*")):
        shutil.rmtree(folder, ignore_errors=True)


def install(prefix, entries, version, when_done=lambda: None):
    """Installs entries, {path: layers.Entry}, and removes all older files.

    Calls when_done() as the last step that can be undone.
    """
    _, installed = read_manifest(prefix)
    _check_free(prefix, entries, installed)
    made = []
    for folder in [prefix, *prefix.parents]:
        if folder.exists():
            break
        made.append(folder)
    prefix.mkdir(parents=True, exist_ok=True)
    spare = None
    try:
        spare = pathlib.Path(tempfile.mkdtemp(
            prefix=f"{_SPARE}{os.getpid()}-", dir=prefix))
        _install(prefix, entries, version, spare, installed, when_done)
    except UndoError:
        raise
    except BaseException:
        if spare is not None:
            shutil.rmtree(spare, ignore_errors=True)
        for folder in made:
            folder.rmdir()
        raise
    _remove_left(prefix)


def _install(prefix, entries, version, spare, installed, when_done):
    old_files = {path for path in installed if not path.endswith("/")}
    folders = {path.rstrip("/") for path in installed if path.endswith("/")}
    stale = old_files - set(entries)
    files = set(entries) | {MANIFEST}
    missing = {str(folder) for path in files
               for folder in pathlib.PurePath(path).parents
               if not (prefix / folder).is_dir()}
    staged = spare / "new"
    (spare / "old").mkdir()
    for relative, entry in entries.items():
        _write(staged / relative, entry)
    journal = _Journal(prefix, spare / "old")

    def write_manifest(files, folders):
        new = spare / "manifest"
        new.write_text(_manifest(version, files, folders), encoding="utf-8")
        journal.replace(new, pathlib.PurePath(MANIFEST))

    try:
        write_manifest(files | old_files, folders | missing)
        for relative in sorted(stale - {MANIFEST}):
            journal.remove(pathlib.PurePath(relative))
        for relative in entries:
            journal.move(staged / relative, pathlib.PurePath(relative))
        write_manifest(files, folders | set(map(str, journal.folders)))
        when_done()
    except BaseException:
        journal.undo()
        raise


def uninstall(prefix):
    """Removes all installed files, and folders made for them if empty.

    Returns the numbers of files removed, and of files that were not there.
    """
    version, paths = read_manifest(prefix)
    if version is None:
        raise PrefixError(f"{prefix / MANIFEST} does not exist, so Poise is "
                          "not installed there; choose the --prefix of the "
                          "installation")
    _remove_left(prefix)
    # The manifest goes last: after an interruption, the same command goes on.
    files = [path for path in paths if not path.endswith("/")]
    removed = 0
    for relative in sorted(files, key=lambda path: path == MANIFEST):
        if os.path.lexists(prefix / relative):
            (prefix / relative).unlink()
            removed += 1
    folders = {path.rstrip("/") for path in paths if path.endswith("/")}
    for relative in sorted(folders, key=len, reverse=True):
        folder = prefix / relative
        if folder.is_dir() and not any(folder.iterdir()):
            folder.rmdir()
    return removed, len(files) - removed

# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""The peers: where their sources come from and how they are compiled."""

import dataclasses
import pathlib
import re


@dataclasses.dataclass(frozen=True)
class Peer:
    """A solver, its checkout and its adapter.

    `proof` is a file of each checkout. `links` maps the name that the
    sources include to a folder of the checkout. `sources` are compiled
    without the lines that match `dropped`. `generated` are headers that the
    peer's own build would write, as pairs of a path and a text.
    """

    name: str
    url: str
    commit: str
    adapter: str
    proof: str
    links: dict
    sources: tuple = ()
    dropped: str = ""
    needs_boost: bool = False
    generated: tuple = ()

    def is_in(self, folder):
        return (folder / self.name / self.proof).is_file()

    def missing(self, folder):
        """Returns the line about a missing checkout."""
        return (f"{self.name}: {folder / self.name / self.proof} does not "
                f"exist, skipped; to compare, check out {self.url} at "
                f"{self.commit} as {folder / self.name}")

    def text(self, path):
        """Returns the text of a source that is compiled."""
        text = path.read_text(encoding="utf-8", errors="replace")
        if not self.dropped:
            return text
        return re.sub(self.dropped, "", text, flags=re.M)


PEERS = (
    Peer(
        name="lexls",
        url="https://github.com/jrl-umi3218/lexls",
        commit="f13b6b668146aabbf838b1e2fc3fe9b65d752db5",
        adapter="lexls_peer.cc",
        proof="include/lexls/lexlsi.h",
        links={"lexls": "include/lexls"},
    ),
    Peer(
        name="soth",
        url="https://github.com/stack-of-tasks/soth",
        commit="d2485f4a29d2af65e4badd72b5a2fe7ae30792fc",
        adapter="soth_peer.cc",
        proof="src/HCOD.hpp",
        links={"soth": "src"},
        sources=tuple(
            f"src/{name}.cpp" for name in (
                "Algebra", "Allocator", "BaseY", "BasicStage", "Bound",
                "Givens", "HCOD", "Stage", "debug")),
        # With this macro, SOTH formats all its matrices in each step.
        dropped=r"^#define SOTH_DEBUG.*$",
        needs_boost=True,
    ),
)

_MACROS = "#pragma once\n" + "".join(
    f"#define PINOCCHIO_{name}\n" for name in (
        "DLLAPI", "DEPRECATED", "DEPRECATED_HEADER(message)",
        "DEPRECATED_MESSAGE(message)"))

DYNAMICS_PEERS = (
    Peer(
        name="pinocchio",
        url="https://github.com/stack-of-tasks/pinocchio",
        commit="v3.7.0",
        adapter="pinocchio_peer.cc",
        proof="include/pinocchio/multibody/model.hpp",
        links={"pinocchio": "include/pinocchio"},
        needs_boost=True,
        generated=(("pinocchio/config.hpp", _MACROS),
                   ("pinocchio/deprecated.hpp", _MACROS),
                   ("pinocchio/warning.hpp", "#pragma once\n")),
    ),
)


def boost_folder(folder):
    """Returns the folder that has boost/version.hpp, or None."""
    for candidate in (folder / "boost", pathlib.Path("/usr/include")):
        if (candidate / "boost" / "version.hpp").is_file():
            return candidate
    return None

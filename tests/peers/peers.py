# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""The peers: where their sources come from and how they are compiled."""

import dataclasses
import pathlib
import re


@dataclasses.dataclass(frozen=True)
class Peer:
    """A solver or a library, its checkout and its adapters.

    `proof` is a file of each checkout. `links` maps the name that the
    sources include to a folder of the checkout. `adapters` are sources in
    tests/peers. `sources` are compiled without the lines that match
    `dropped`. `generated` are headers that the peer's own build would write,
    as pairs of a path and a text. `needs` are other peers, whose checkouts
    this one uses.
    """

    name: str
    url: str
    commit: str
    proof: str
    links: dict
    adapters: tuple = ()
    sources: tuple = ()
    dropped: str = ""
    needs_boost: bool = False
    generated: tuple = ()
    needs: tuple = ()

    def checkouts(self):
        """Returns this peer and the others whose checkouts it uses."""
        return (self, *self.needs)

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
        proof="include/lexls/lexlsi.h",
        links={"lexls": "include/lexls"},
        adapters=("lexls_peer.cc",),
    ),
    Peer(
        name="soth",
        url="https://github.com/stack-of-tasks/soth",
        commit="d2485f4a29d2af65e4badd72b5a2fe7ae30792fc",
        proof="src/HCOD.hpp",
        links={"soth": "src"},
        adapters=("soth_peer.cc",),
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
        proof="include/pinocchio/multibody/model.hpp",
        links={"pinocchio": "include/pinocchio"},
        adapters=("pinocchio_peer.cc", "pinocchio_model.cc"),
        needs_boost=True,
        generated=(("pinocchio/config.hpp", _MACROS),
                   ("pinocchio/deprecated.hpp", _MACROS),
                   ("pinocchio/warning.hpp", "#pragma once\n")),
    ),
)

_EIQUADPROG = Peer(
    name="eiquadprog",
    url="https://github.com/stack-of-tasks/eiquadprog",
    commit="11a688b4aec48d1d3d5d5679e14997e566ca381e",
    proof="include/eiquadprog/eiquadprog-fast.hpp",
    links={"eiquadprog": "include/eiquadprog"},
    sources=("src/eiquadprog-fast.cpp",),
)

# TSID's wrapper of a robot can read URDF files, by Pinocchio's parser. The
# adapter makes the model itself, so the parser is replaced.
_NO_PARSER = """#pragma once
#include <stdexcept>
namespace pinocchio::urdf {
template <typename... Arguments>
void buildModel(Arguments&&...) {
  throw std::logic_error("built without a parser of URDF files");
}
}
"""

CONTROLLER_PEERS = (
    Peer(
        name="tsid",
        url="https://github.com/stack-of-tasks/tsid",
        commit="v1.10.0",
        proof="include/tsid/formulations/"
              "inverse-dynamics-formulation-acc-force.hpp",
        links={"tsid": "include/tsid"},
        adapters=("tsid_peer.cc", "pinocchio_model.cc"),
        sources=tuple(
            f"src/{name}.cpp" for name in (
                "contacts/contact-6d", "contacts/contact-base",
                "contacts/measured-force-base",
                "formulations/contact-level",
                "formulations/inverse-dynamics-formulation-acc-force",
                "formulations/inverse-dynamics-formulation-base",
                "math/constraint-base", "math/constraint-bound",
                "math/constraint-equality", "math/constraint-inequality",
                "math/utils", "robots/robot-wrapper",
                "solvers/solver-HQP-base",
                "solvers/solver-HQP-eiquadprog-fast",
                "tasks/task-actuation", "tasks/task-actuation-bounds",
                "tasks/task-angular-momentum-equality", "tasks/task-base",
                "tasks/task-com-equality", "tasks/task-joint-bounds",
                "tasks/task-joint-posture", "tasks/task-motion",
                "tasks/task-se3-equality")),
        needs_boost=True,
        generated=(("tsid/config.hh", "#define TSID_DLLAPI\n"),
                   ("tsid/deprecated.hh", "#define TSID_DEPRECATED\n"),
                   ("pinocchio/parsers/urdf.hpp", _NO_PARSER)),
        needs=(_EIQUADPROG, *DYNAMICS_PEERS),
    ),
)


def boost_folder(folder):
    """Returns the folder that has boost/version.hpp, or None."""
    for candidate in (folder / "boost", pathlib.Path("/usr/include")):
        if (candidate / "boost" / "version.hpp").is_file():
            return candidate
    return None

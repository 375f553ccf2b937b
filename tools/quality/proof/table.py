# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""The rows of docs/proof.md: each public function, its tests, its mutants."""

import collections
import json

from evidence import KINDS, LAYERS, PROOFS
from mutants import make_mutants

# What has a derivative or is a projection, so that Ceres has something to say.
_DIFFERENTIABLE = {
    "math/so3.h": ["ExpSo3", "LogSo3"],
    "math/so3_jacobian.h": [
        "LeftJacobianSo3", "RightJacobianSo3", "InverseLeftJacobianSo3",
        "InverseRightJacobianSo3",
    ],
    "math/se3.h": ["ExpSe3", "LogSe3"],
    "math/se3_jacobian.h": [
        "LeftJacobianSe3", "RightJacobianSe3", "InverseLeftJacobianSe3",
        "InverseRightJacobianSe3",
    ],
    "math/quaternion.h": ["ExpQuaternion", "LogQuaternion"],
    "dynamics/center_of_mass.h": ["ComputeCenterOfMass"],
    "dynamics/centroidal.h": ["ComputeCentroidalMomentum"],
    "dynamics/derivatives.h": ["ComputeRneaDerivatives"],
    "dynamics/energy.h": ["PotentialEnergy"],
    "dynamics/integrate.h": ["Integrate"],
    "dynamics/jacobian.h": ["ComputeFrameJacobian", "FrameBias"],
    "dynamics/kinematics.h": [
        "ComputePoses", "ComputeVelocities", "ComputeAccelerations",
    ],
    "hqp/reference/cascade.h": ["Cascade::Solve"],
}


class Row:
    def __init__(self, path, name):
        self.path = path
        self.name = name
        self.tests = {kind: [] for kind in KINDS}
        self.through = None  # The row of a proved function that leads to it.
        self.killed = self.survived = self.equivalent = self.mutants = 0
        self.may_be_untried = False
        self.is_changed = False  # Since its mutants were tried.

    @property
    def layer(self):
        return self.path.split("/")[0]

    @property
    def tried(self):
        return self.killed + self.survived

    @property
    def has_proof(self):
        return any(self.tests[kind] for kind in PROOFS)

    @property
    def complaint(self):
        where = f"{self.path}: {self.name}"
        if not self.has_proof and not self.through:
            return f"{where}: has no oracle, no property, no check by Ceres"
        if self.name in _DIFFERENTIABLE.get(self.path, ()) and (
            not self.tests["Ceres"]
        ):
            return f"{where}: can be differentiated, but Ceres does not check it"
        if self.tried and not self.killed:
            return f"{where}: none of the {self.tried} mutants tried died"
        if self.is_untried != self.may_be_untried:
            return f"{where}: " + (
                f"none of its {self.mutants} mutants was tried" if self.is_untried
                else "was tried; take it out of tools/quality/proof/untried.txt"
            )
        return None

    @property
    def is_untried(self):
        return not self.tried and self.equivalent < self.mutants

    @property
    def score(self):
        if self.tried:
            changed = ", changed since" if self.is_changed else ""
            return f"{self.killed} of {self.tried}{changed}"
        if not self.mutants:
            return "none"
        return "not tried" if self.is_untried else "equivalent"

    def cells(self):
        cells = [self.tests[k][0].name if self.tests[k] else "" for k in KINDS]
        if self.through:
            cells[0] = f"by `{self.through.name}`"
        return [f"`{self.name}`", *cells, self.score]


def make_rows(workspace):
    rows = [Row(*key) for key in workspace.public_functions()]
    tests = workspace.tests()
    for row in rows:
        for test in tests:
            if test.names(row.path, row.name, workspace.classes(row.path)):
                row.tests[test.kind].append(test)
        stem = row.path.rsplit(".", 1)[0]
        for kind in KINDS:  # A function's own tests come first.
            row.tests[kind].sort(
                key=lambda t: ("Alloc" in t.name, not t.path.startswith(stem))
            )
    _find_ways_through(workspace, rows)
    _count_mutants(workspace, rows)
    file = workspace.root / "tools/quality/proof/untried.txt"
    excused = {l for l in file.read_text().splitlines() if l and l[0] != "#"}
    for row in rows:
        row.may_be_untried = f"{row.path} {row.name}" in excused
        excused.discard(f"{row.path} {row.name}")
    if excused:
        raise SystemExit(f"{file}: no such function: {', '.join(sorted(excused))}")
    return rows


def _find_ways_through(workspace, rows):
    """For what has no proof of its own: the nearest proved function that leads to it."""
    bodies = collections.defaultdict(list)  # (layer, name): [(headers, words)]
    for layer in LAYERS:
        for path in workspace.library_files(layer):
            headers = workspace.headers(path) | {path}
            source = workspace.source(path)
            for function in source.functions:
                bodies[layer, function.qualified].append(
                    (headers, source.words(function))
                )
    callable_by = collections.defaultdict(list)  # Word: [(header or file, name)]
    for layer in LAYERS:
        for path in workspace.library_files(layer):
            for function in workspace.source(path).functions:
                for word in function.qualified.split("::")[-2:]:
                    callable_by[word].append((path, function.qualified))
    distance = {}
    for start in rows:
        if not start.has_proof or "operator" in start.name:
            continue
        reached, new, steps = {start.name}, {start.name}, 0
        while new:
            steps += 1
            found = set()
            for name in new:
                for headers, words in bodies[start.layer, name]:
                    for word in words & callable_by.keys():
                        found.update(
                            n for path, n in callable_by[word] if path in headers
                        )
            new = found - reached
            reached |= new
            for row in rows:
                if row.name in new and not row.has_proof and (
                    row.layer == start.layer
                    and steps < distance.get((row.path, row.name), 99)
                ):
                    row.through = start
                    distance[row.path, row.name] = steps


def read_results(workspace):
    """{file: {function: counts}} of the last run of //tools:mutate.

    With the digest of the function as it was then; none where nobody knows.
    """
    return json.loads((workspace.root / "docs/mutation.json").read_text())


def _count_mutants(workspace, rows):
    """Sums over a function's own mutants and those of what it alone can call."""
    results = read_results(workspace)
    possible = collections.Counter()
    for layer in LAYERS:
        for path in workspace.library_files(layer):
            for mutant in make_mutants(path, workspace.source(path).text):
                possible[path, mutant.function] += 1
    public = {row.name for row in rows}
    for row in rows:
        for path in workspace.defining_files(row.path, row.name):
            words = collections.defaultdict(set)
            source = workspace.source(path)
            for function in source.functions:
                words[function.qualified] |= source.words(function)
            private = {n.split("::")[-1]: n for n in words if n not in public}
            counted, new = {row.name}, {row.name}
            while new:
                called = set().union(*(words[n] for n in new))
                new = {private[w] for w in called if w in private} - counted
                counted |= new
            digests = source.digests()
            for name in counted:
                result = results.get(path, {}).get(name, {})
                row.is_changed |= bool(result) and (
                    result.get("digest") != digests.get(name)
                )
                row.killed += result.get("killed", 0)
                row.survived += result.get("survived", 0)
                row.equivalent += result.get("equivalent", 0)
                # What does not compile is no slip that anybody could make.
                row.mutants += possible[path, name] - result.get("invalid", 0)

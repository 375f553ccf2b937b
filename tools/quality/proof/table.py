# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""The rows of the table: each public function, its tests, its mutants."""

import collections

from evidence import KINDS, LAYERS, PROOFS
from ledger import Counts, add_up
from mutants import make_mutants

# Functions that have a derivative or are a projection, so that Ceres can check
# them.
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
        self.mutants = Counts(0, 0, 0)
        self.is_changed = False  # Since its mutants were tried.

    @property
    def layer(self):
        return self.path.split("/")[0]

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
        if self.mutants.tried and not self.mutants.killed:
            return f"{where}: none of {self.mutants.tried} tried mutants was killed"
        return None

    def cells(self):
        cells = [self.tests[k][0].name if self.tests[k] else "" for k in KINDS]
        if self.through:
            cells[0] = f"by `{self.through.name}`"
        changed = ", changed since" if self.is_changed else ""
        return [f"`{self.name}`", *cells, f"{self.mutants}{changed}"]


def tree_tally(workspace, ledger):
    """Returns the results of the ledger for each function of the tree."""
    pool = []
    for layer in LAYERS:
        for path in workspace.library_files(layer):
            text = workspace.source(path).text
            if "\nint main(" not in text:
                pool += make_mutants(path, text)
    return ledger.tally(pool)


def make_rows(workspace, tally):
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
    _count_mutants(workspace, rows, tally)
    return rows


def _find_ways_through(workspace, rows):
    """Finds the nearest tested caller of each function without a test of its own."""
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


def _count_mutants(workspace, rows, tally):
    """Sums the mutants of a function and of the helpers that only it calls."""
    public = {row.name for row in rows}
    for row in rows:
        counted = {row.name}
        for path in workspace.defining_files(row.path, row.name):
            words = collections.defaultdict(set)
            source = workspace.source(path)
            for function in source.functions:
                words[function.qualified] |= source.words(function)
            private = {n.split("::")[-1]: n for n in words if n not in public}
            new = {row.name}
            while new:
                called = set().union(*(words[n] for n in new))
                new = {private[w] for w in called if w in private} - counted
                counted |= new
        found = [tally[row.layer, n] for n in counted if (row.layer, n) in tally]
        row.mutants = add_up(counts for counts, _ in found)
        row.is_changed = any(is_changed for _, is_changed in found)

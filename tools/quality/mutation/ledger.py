# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""The ledger: known results of mutants, independent of their file.

A line of ledger.tsv has four columns, with tabs between them:

  function  digest  equivalent  why no test can notice this mutant
  function  digest  survived    why no test notices it today
  function  digest  counts      LAYER: KILLED of TRIED of POSSIBLE

The digest of a mutant is that of its expression and its change, with local
names numbered (expressions.py).  The digest of counts is that of all mutants
of the function at the time when they were tried.  Counts leave out mutants
that do not compile, that compile to the same code, and that are equivalent.
"""

import collections
import re
from typing import NamedTuple

from expressions import hash_words

EQUIVALENT, SURVIVED = "equivalent", "survived"
_COUNTS = re.compile(r"(\w+): (\d+) of (\d+) of (\d+)$")
UNEXPLAINED = "Nobody has looked into this one yet."
_HEAD = """\
# Results of mutants, see ledger.py. `bazel run //tools:mutate -- --ledger`
# shows each entry with its source line, `-- --stale` those whose code is gone.
"""


class Entry(NamedTuple):
    verdict: str
    reason: str


class Counts(NamedTuple):
    killed: int
    tried: int
    possible: int
    digest: str = ""  # Of the function as it was when its mutants were tried.

    def __str__(self):
        return f"{self.killed} of {self.tried} of {self.possible}"


def add_up(counts):
    counts = list(counts)
    return Counts(*(sum(c[i] for c in counts) for i in range(3)))


def group(mutants):
    """Returns {(layer, function): its mutants}."""
    groups = collections.defaultdict(list)
    for mutant in mutants:
        groups[mutant.layer, mutant.place].append(mutant)
    return groups


def digest_of(mutants):
    return hash_words(sorted(m.digest for m in mutants))


class Ledger:
    def __init__(self):
        self.entries = {}  # (function, digest): Entry
        self.counts = {}  # (layer, function): Counts

    @staticmethod
    def read(path):
        ledger = Ledger()
        for number, line in enumerate(path.read_text().splitlines(), start=1):
            if line and not line.startswith("#"):
                try:
                    ledger._read_line(line)
                except ValueError as error:
                    raise ValueError(f"{path}:{number}: {error}") from None
        return ledger

    def _read_line(self, line):
        cells = line.split("\t")
        if len(cells) != 4 or not all(cells):
            raise ValueError(f"has {len(cells)} columns, must have 4 with text")
        function, digest, verdict, text = cells
        if verdict == "counts":
            match = _COUNTS.match(text)
            if not match:
                raise ValueError(f"'{text}', must be LAYER: N of N of N")
            numbers = [int(n) for n in match.groups()[1:]]
            if numbers != sorted(numbers):
                raise ValueError(f"'{text}', must not decrease")
            key = (match.group(1), function)
            if key in self.counts:
                raise ValueError(f"counts {function} of {match.group(1)} twice")
            self.counts[key] = Counts(*numbers, digest)
        elif verdict in (EQUIVALENT, SURVIVED):
            if (function, digest) in self.entries:
                raise ValueError(f"has {function}, {digest} twice")
            self.entries[function, digest] = Entry(verdict, text)
        else:
            raise ValueError(
                f"verdict '{verdict}', must be equivalent, survived or counts"
            )

    def write(self, path):
        lines = [
            (function, 0, c.digest, "counts", f"{layer}: {c}")
            for (layer, function), c in self.counts.items()
        ] + [
            (function, 1, digest, entry.verdict, entry.reason)
            for (function, digest), entry in self.entries.items()
        ]
        path.write_text(_HEAD + "".join(
            "\t".join((function, *rest)) + "\n"
            for function, _, *rest in sorted(lines)
        ))

    def is_equivalent(self, mutant):
        entry = self.entries.get(mutant.key)
        return entry is not None and entry.verdict == EQUIVALENT

    def stale(self, pool):
        """Returns the stale entries as lines to print."""
        keys = {mutant.key for mutant in pool}
        functions = set(group(pool))
        return [
            f"{function}: has no mutant {digest}, which the ledger calls "
            f"{entry.verdict}: {entry.reason}"
            for (function, digest), entry in sorted(self.entries.items())
            if (function, digest) not in keys
        ] + [
            f"{function}: is no function of {layer} that has mutants"
            for layer, function in sorted(self.counts.keys() - functions)
        ]

    def __len__(self):
        return len(self.entries) + len(self.counts)

    def tally(self, pool):
        """Returns {(layer, function): (Counts, whether it changed)} of the tree."""
        found = {}
        for key, mutants in group(pool).items():
            possible = sum(1 for m in mutants if not self.is_equivalent(m))
            counts = self.counts.get(key, Counts(0, 0, possible))
            is_changed = bool(counts.digest) and (
                counts.digest != digest_of(mutants)
            )
            if is_changed:
                counts = counts._replace(possible=max(counts.tried, possible))
            found[key] = counts, is_changed
        return found

    def record(self, pool, verdict_of):
        """Takes in what was tried: verdict_of(mutant) is "killed", "survived",
        None if nobody tried, or another word if the mutant does not count.

        A run that tried fewer mutants of a function than the ledger counts does
        not replace these counts, but corrects them.
        """
        for key, mutants in group(pool).items():
            verdicts = {m: verdict_of(m) for m in mutants}
            tried = [m for m in mutants if verdicts[m] in ("killed", "survived")]
            if not tried:
                continue
            survivors = [m for m in tried if verdicts[m] == "survived"]
            fresh = [m for m in survivors if m.key not in self.entries]
            caught = [
                m for m in tried if verdicts[m] == "killed" and m.key in self.entries
            ]
            for mutant in caught:
                del self.entries[mutant.key]
            tried = [m for m in tried if not self.is_equivalent(m)]
            survivors = [m for m in survivors if not self.is_equivalent(m)]
            for mutant in fresh:
                self.entries[mutant.key] = Entry(SURVIVED, UNEXPLAINED)
            old = self.counts.get(key)
            if old and old.tried > len(tried):
                self.counts[key] = _correct(old, len(caught), len(fresh))
            else:
                self.counts[key] = Counts(
                    len(tried) - len(survivors), len(tried),
                    sum(1 for m in mutants if not self.is_equivalent(m)
                        and verdicts[m] in ("killed", "survived", None)),
                    digest_of(mutants),
                )


def _correct(counts, caught, fresh):
    """Returns the counts after known survivors were killed and new ones found.

    Nobody knows which mutants the counts include.  A fresh survivor is taken for
    one that had not been tried, as long as there are any, then for one that had
    been killed.
    """
    untried = min(fresh, counts.possible - counts.tried)
    killed = counts.killed + caught - (fresh - untried)
    tried = counts.tried + untried
    return counts._replace(killed=max(0, min(killed, tried)), tried=tried)

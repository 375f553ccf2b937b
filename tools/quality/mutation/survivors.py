# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Reads what is said of mutants: equivalent.txt, of those that no test can
notice, and survivors.txt, of those that one could, and none does."""


def read_entries(path):
    """[(place, line, line with the slip)] of a file of entries, each four lines or
    more, and an empty one after it:
        math/so3.cc ExpSo3
        - the line as it is
        + the line with the slip
        Why no test can tell them apart.
    """
    body = "\n".join(
        line for line in path.read_text().splitlines() if not line.startswith("#")
    )
    entries = []
    for block in filter(None, (b.strip("\n") for b in body.split("\n\n"))):
        lines = block.split("\n")
        if (
            len(lines) < 4
            or not lines[1].startswith("- ")
            or not lines[2].startswith("+ ")
            or not lines[3].strip()
        ):
            raise ValueError(
                f"{path}: '{lines[0]}': want place, '- line', '+ line' and a reason"
            )
        entries.append((lines[0].strip(), lines[1][2:].strip(), lines[2][2:].strip()))
    return entries


def explained(path, pool):
    """The mutants of `pool` that have an entry in the file at `path`."""
    if not path.is_file():
        return set()
    table = {}
    for mutant in pool:
        key = (f"{mutant.path} {mutant.function}".strip(), mutant.before, mutant.after)
        table.setdefault(key, set()).add(mutant)
    found = set()
    paths = {mutant.path for mutant in pool}
    for key in read_entries(path):
        if key[0].split()[0] in paths and key not in table:
            raise ValueError(f"{path}: no such mutant any more: {' / '.join(key)}")
        found |= table.get(key, set())
    return found

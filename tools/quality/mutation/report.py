# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Prints figures of mutants: always killed of tried of possible."""

import collections

from ledger import SURVIVED, add_up


def show_results(selected, results, ledger):
    """Prints what a run tried, of all possible mutants, by file and function."""
    table = collections.defaultdict(collections.Counter)
    for mutant in selected:
        if ledger.is_equivalent(mutant):
            continue
        entry = results.get(mutant)
        verdict = entry["verdict"] if entry else "untried"
        for line in ("", f"  {mutant.place}"):
            table[mutant.path, line][verdict] += 1
    print(f"{'killed':>8} {'tried':>8} {'possible':>8}")
    for (path, line), counts in sorted(table.items()):
        tried = counts["killed"] + counts["survived"]
        if tried:
            possible = tried + counts["untried"]
            print(f"{counts['killed']:8} {tried:8} {possible:8}  {line or path}")


def show_ledger(selected, ledger):
    """Prints the ledger by function, by layer and by mutant."""
    for mutant in selected:
        entry = ledger.entries.get(mutant.key)
        if entry:
            print(f"{entry.verdict}: {mutant.describe()}\n  {entry.reason}")
    tally = ledger.tally(selected)
    print(f"{'killed':>8} {'tried':>8} {'possible':>8}")

    def show(counts, name):
        print(
            f"{counts.killed:8} {counts.tried:8} {counts.possible:8}  {name}"
        )

    for layer in sorted({layer for layer, _ in tally}):
        rows = {f: row for (l, f), row in tally.items() if l == layer}
        show(add_up(counts for counts, _ in rows.values()), layer)
        for function, (counts, is_changed) in sorted(rows.items()):
            show(counts, f"  {function}" + (", changed since" if is_changed else ""))
    changed = add_up(counts for counts, is_changed in tally.values() if is_changed)
    total = add_up(counts for counts, _ in tally.values())
    print(
        f"{total.killed} killed of {total.tried} tried of {total.possible} possible; "
        f"{changed.killed} of {changed.tried} of {changed.possible} in functions "
        "that were changed since"
    )


def summarize(pool, verdict_of, ledger):
    """Returns the known results for the present sources, by file and function."""
    files = {}
    for mutant in pool:
        row = files.setdefault(mutant.path, {}).setdefault(
            mutant.place,
            {"possible": 0, "killed": 0, "survived": 0, "equivalent": 0, "invalid": 0},
        )
        verdict = verdict_of(mutant)
        if ledger.is_equivalent(mutant) or verdict == "same code":
            row["equivalent"] += 1
            continue
        if verdict == "invalid":
            row["invalid"] += 1
            continue
        row["possible"] += 1
        if verdict:
            row[verdict] += 1
        if verdict == SURVIVED:
            row.setdefault("survivors", []).append(
                {"before": mutant.before, "after": mutant.after}
            )
    return {
        path: tried for path, rows in files.items() if (tried := {
            name: row for name, row in rows.items()
            if any(n for k, n in row.items() if k != "possible")
        })
    }

# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Says in sentences what differs between two lists of abi_list.py."""


def _without_arguments(name):
    return name.split("(")[0]


def _compare_functions(library, old, new):
    """Yields what broke in the functions of a library."""
    added = sorted(set(new) - set(old))
    for name in sorted(set(old) - set(new)):
        same = [other for other in added if "(" in name and
                _without_arguments(other) == _without_arguments(name)]
        if same:
            yield (f"{library}: {_without_arguments(name)} has other "
                   f"arguments: was {name}, is {'; '.join(same)}.")
        else:
            yield f"{library} no longer exports {name}."


def _compare_class(name, old, new):
    """Yields what broke in the layout of a class."""
    moved = []
    for what, was in old.items():
        if what not in new:
            yield f"{name}: {what} is gone; it was {was}."
        elif new[what] != was:
            kind, _, place = was.partition(" at byte ")
            if place and new[what].partition(" at byte ")[0] == kind:
                moved.append((what, was))
            else:
                yield f"{name}: {what} is {new[what]}; before, it was {was}."
    # One sentence: a new member, or one that has grown, moves all after it.
    if moved:
        what, was = moved[0]
        more = f", and {len(moved) - 1} more moved" if moved[1:] else ""
        yield f"{name}: {what} is {new[what]}; before, it was {was}{more}."
    for what in new:
        # Classes of users that override functions lack the new one.
        if what not in old and what.startswith("virtual"):
            yield f"{name}: {what} is new; it is {new[what]}."


def broken(old, new):
    """Returns what programs compiled with the old interface would miss."""
    found = []
    for library, names in old["functions"].items():
        if library in new["functions"]:
            found += _compare_functions(library, names,
                                        new["functions"][library])
        else:
            found.append(f"{library} is gone.")
    for name, layout in old["classes"].items():
        if name in new["classes"]:
            found += _compare_class(name, layout, new["classes"][name])
        else:
            found.append(f"{name} is gone, or no public class uses it.")
    return found


def additions(old, new):
    """Returns the number of new functions and classes."""
    count = len(set(new["classes"]) - set(old["classes"]))
    for library, names in new["functions"].items():
        count += len(set(names) - set(old["functions"].get(library, [])))
    return count

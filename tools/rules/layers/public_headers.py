# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Finds the public headers of the layers, by rule, in the source tree."""

import re

LAYERS = ("math", "dynamics", "hqp", "robot", "sim")
# Folders whose headers are for their own layer only, see CONTRIBUTING.md.
PRIVATE = ("dynamics/simd", "hqp/fast")


def test_headers(build):
    """Returns the headers of the testonly rules of a BUILD file."""
    found = set()
    for rule in re.findall(r"^\w+\((?:.|\n)*?^\)", build, re.M):
        if re.search(r"^    testonly = True,$", rule, re.M):
            hdrs = re.search(r"hdrs = \[([^\]]*)\]", rule)
            found.update(re.findall(r'"([^"]+)"', hdrs[1]) if hdrs else ())
    return found


def headers(root):
    """Returns the sorted paths of the public headers: each header of a layer that
    is neither in a private folder nor of a testonly rule."""
    found = []
    for layer in LAYERS:
        for path in (root / layer).rglob("*.h"):
            name = str(path.relative_to(root))
            if name.startswith(tuple(f"{folder}/" for folder in PRIVATE)):
                continue
            build = (path.parent / "BUILD").read_text()
            if path.name not in test_headers(build):
                found.append(name)
    return sorted(found)


def includes(text):
    """Returns the paths of Poise's headers that a header includes."""
    return re.findall(r'^#include "poise/([^"]+)"', text, re.M)


def needed(root, public):
    """Returns the sorted headers that are not public, but that public headers
    include, also through each other."""
    found, left = set(), list(public)
    while left:
        for name in includes((root / left.pop()).read_text()):
            if name not in found and name not in public:
                found.add(name)
                left.append(name)
    return sorted(found)


def unaligned(root, public):
    """Returns the sorted public headers that include Eigen, but neither they nor
    the headers that they include check its alignment (math/eigen_alignment.h)."""
    found = []
    for name in public:
        reached = [name, *needed(root, [name])]
        has_eigen = any(re.search(r"^#include <Eigen/", (root / path).read_text(),
                                  re.M) for path in reached)
        if has_eigen and "math/eigen_alignment.h" not in reached:
            found.append(name)
    return sorted(found)


def read_list(text):
    """Returns the headers that public_headers.bzl lists."""
    block = re.search(r"^PUBLIC_HEADERS = \[\n([^\]]*)\]", text, re.M)[1]
    return re.findall(r'^    "(.*)",$', block, re.M)

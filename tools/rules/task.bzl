"""The rule of a task: a library in robot/control/tasks."""

load("//tools/rules:cc.bzl", "poise_cc_library")

# Every task includes these headers, directly or indirectly.
_DEPS = [
    "//dynamics:tree",
    "//robot:robot",
    "//robot/control:task",
    "//robot/control/tasks:row_names",
]

def poise_task(name, deps = [], **kwargs):
    """A task of NAME.h and NAME.cc; deps are those that not every task has."""
    poise_cc_library(
        name = name,
        srcs = [name + ".cc"],
        hdrs = [name + ".h"],
        deps = _DEPS + deps,
        **kwargs
    )

"""The C++ rules of this workspace: one place for warnings and conventions."""

_COPTS = [
    "-Wall",
    "-Wextra",
    "-Wshadow",
    "-Wconversion",
    "-Wno-sign-conversion",
    "-Wnon-virtual-dtor",
    "-Woverloaded-virtual",
    # A false warning of GCC inside Eigen; clang does not have this warning.
    "-Wno-unknown-warning-option",
    "-Wno-maybe-uninitialized",
    # Clang does not have GCC's --param and -fexpensive-optimizations of .bazelrc.
    "-Wno-unused-command-line-argument",
    "-Wno-ignored-optimization-argument",
    "-Werror",
]

def _precompiled(name):
    """The copts and deps that load a header of //tools/rules/precompiled."""
    return struct(
        copts = _if_precompiled([
            "-include",
            "tools/rules/precompiled/{}.h".format(name),
            # Warns if the precompiled header cannot be used.
            "-Winvalid-pch",
            # A change of a header in it rebuilds its users.
            "-fpch-deps",
        ]),
        deps = _if_precompiled(["//tools/rules/precompiled:" + name]),
    )

def _if_precompiled(these):
    return select({
        "//tools/rules/precompiled:wanted_of_clang": [],
        "//tools/rules/precompiled:wanted": these,
        "//conditions:default": [],
    })

def _precompiled_eigen(deps):
    """Of what is not a test: by its optimization in .bazelrc."""
    if not deps:  # No Eigen either; some of it defines what libc declares.
        return struct(copts = [], deps = [])
    package = native.package_name()
    quick = package.split("/")[0] in ("python", "tests", "tools") or package in (
        "robot",
        "robot/feet",
        "robot/profile",
        "robot/urdf",
        "sim/log",
    )
    return _precompiled("eigen_og" if quick else "eigen")

def poise_cc_library(name, copts = [], deps = [], **kwargs):
    """A library whose headers are included as "poise/<package>/<header>".

    The prefix keeps them apart from a guest's own "math/..." or "robot/...".
    """
    header = _precompiled_eigen(deps)
    if kwargs.get("hdrs"):
        kwargs["include_prefix"] = "poise"
        kwargs["strip_include_prefix"] = "/"
    native.cc_library(
        name = name,
        copts = _COPTS + header.copts + copts,
        deps = deps + header.deps,
        **kwargs
    )

def poise_cc_binary(name, copts = [], deps = [], **kwargs):
    header = _precompiled_eigen(deps)
    native.cc_binary(
        name = name,
        copts = _COPTS + header.copts + copts,
        deps = deps + header.deps,
        **kwargs
    )

def poise_cc_test(
        name,
        size = "small",
        srcs = None,
        copts = [],
        deps = [],
        with_main = True,
        **kwargs):
    """A GoogleTest with the stock main(); the source defaults to <name>.cc."""
    header = _precompiled("test" if with_main else "eigen_og")
    native.cc_test(
        name = name,
        size = size,
        srcs = srcs or [name + ".cc"],
        copts = _COPTS + header.copts + copts,
        deps = deps + header.deps + (["@gtest_main"] if with_main else []),
        **kwargs
    )

def poise_cc_benchmark(name, srcs = None, copts = [], deps = [], **kwargs):
    """A Google Benchmark, and a test that every case of it runs once."""
    srcs = srcs or [name + ".cc"]
    header = _precompiled_eigen(deps)
    copts = _COPTS + header.copts + copts
    deps = deps + header.deps + ["@benchmark"]
    native.cc_binary(
        name = name,
        testonly = True,
        srcs = srcs,
        copts = copts,
        tags = ["manual"],
        deps = deps,
        **kwargs
    )
    native.cc_test(
        name = name + "_smoke_test",
        size = "small",
        srcs = srcs,
        args = ["--benchmark_min_time=0", "--benchmark_repetitions=1"],
        copts = copts,
        tags = ["benchmark"],
        deps = deps,
        **kwargs
    )

# The symbols of pybind11 are hidden, so those that contain them must be too.
_PYTHON_COPTS = ["-fvisibility=hidden"]

def poise_cc_python_library(name, copts = [], deps = [], **kwargs):
    """A part of a Python module, by pybind11."""
    header = _precompiled("python")
    if kwargs.get("hdrs"):
        kwargs["include_prefix"] = "poise"
        kwargs["strip_include_prefix"] = "/"
    native.cc_library(
        name = name,
        copts = _COPTS + header.copts + _PYTHON_COPTS + copts,
        deps = deps + header.deps,
        **kwargs
    )

def poise_cc_python_module(name, symbols, copts = [], linkopts = [], **kwargs):
    """A Python module as a shared library that exports its entry point alone.

    Poise's own layers are linked statically, Debian's libraries dynamically.

    Args:
      name: The name with its folder and suffix: "poise/_poise.so".
      symbols: A version script of the linker.
      copts: Flags of the compiler.
      linkopts: Flags of the linker.
      **kwargs: Arguments of cc_binary.
    """
    native.cc_binary(
        name = name,
        copts = _COPTS + _PYTHON_COPTS + copts,
        linkopts = linkopts + [
            "-Wl,--version-script=$(location {})".format(symbols),
            # Without a name, the linker records the path of its output.
            "-Wl,-soname," + name.split("/")[-1],
            "-Wl,--gc-sections",
        ],
        linkshared = True,
        linkstatic = True,
        deps = kwargs.pop("deps", []) + [symbols],
        **kwargs
    )

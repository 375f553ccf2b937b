"""The C++ rules of this workspace: one place for warnings and conventions."""

_COPTS = [
    "-Wall",
    "-Wextra",
    "-Wshadow",
    "-Wconversion",
    "-Wno-sign-conversion",
    "-Wnon-virtual-dtor",
    "-Woverloaded-virtual",
    # GCC raises this one wrongly inside Eigen; clang does not know it.
    "-Wno-unknown-warning-option",
    "-Wno-maybe-uninitialized",
    # Clang does not know GCC's --param of .bazelrc.
    "-Wno-unused-command-line-argument",
    "-Werror",
]

def poise_cc_library(name, copts = [], **kwargs):
    native.cc_library(name = name, copts = _COPTS + copts, **kwargs)

def poise_cc_binary(name, copts = [], **kwargs):
    native.cc_binary(name = name, copts = _COPTS + copts, **kwargs)

def poise_cc_test(
        name,
        size = "small",
        srcs = None,
        copts = [],
        deps = [],
        with_main = True,
        **kwargs):
    """A GoogleTest with the stock main(); the source defaults to <name>.cc."""
    native.cc_test(
        name = name,
        size = size,
        srcs = srcs or [name + ".cc"],
        copts = _COPTS + copts,
        deps = deps + (["@gtest_main"] if with_main else []),
        **kwargs
    )

def poise_cc_benchmark(name, srcs = None, copts = [], deps = [], **kwargs):
    """A Google Benchmark, and a test that every case of it runs once."""
    srcs = srcs or [name + ".cc"]
    deps = deps + ["@benchmark"]
    native.cc_binary(
        name = name,
        testonly = True,
        srcs = srcs,
        copts = _COPTS + copts,
        tags = ["manual"],
        deps = deps,
        **kwargs
    )
    native.cc_test(
        name = name + "_smoke_test",
        size = "small",
        srcs = srcs,
        args = ["--benchmark_min_time=0", "--benchmark_repetitions=1"],
        copts = _COPTS + copts,
        tags = ["benchmark"],
        deps = deps,
        **kwargs
    )

"""Lets Debian 12's bazel-bootstrap (4.2.3) work without a network.

The WORKSPACE suffix built into Bazel 4 declares rules_cc, rules_java,
rules_proto and remote_coverage_tools as downloads, and analysing any cc_test
loads all four.  Debian packages rules_java and rules_proto; its rules_cc
(0.0.4) is too new for its Bazel, and it has no coverage tools, so those two are
written here.  A release of Bazel needs none of this.
"""

_RULES_CC_DEFS = """
cc_binary = native.cc_binary
cc_import = native.cc_import
cc_library = native.cc_library
cc_test = native.cc_test
cc_toolchain = native.cc_toolchain
cc_toolchain_suite = native.cc_toolchain_suite
"""

_COVERAGE_BUILD = """
[sh_binary(
    name = name,
    srcs = ["unavailable.sh"],
    visibility = ["//visibility:public"],
) for name in ("coverage_report_generator", "lcov_merger")]
"""

_COVERAGE_SCRIPT = """#!/bin/sh
echo "bazel coverage: not available with Debian's bazel-bootstrap" >&2
exit 1
"""

def _generated_repository_impl(ctx):
    for path, content in ctx.attr.files.items():
        ctx.file(path, content, executable = path.endswith(".sh"))

_generated_repository = repository_rule(
    implementation = _generated_repository_impl,
    attrs = {"files": attr.string_dict(mandatory = True)},
)

def add_debian_bazel_repositories():
    """Overrides the downloads, when the running Bazel is Debian's."""
    if native.bazel_version:
        return  # Debian's is the one that does not know its own version.
    native.local_repository(name = "rules_java", path = "/usr/share/bazel/rules/java")
    native.local_repository(name = "rules_proto", path = "/usr/share/bazel/rules/proto")
    _generated_repository(
        name = "rules_cc",
        files = {"BUILD": "", "cc/BUILD": "", "cc/defs.bzl": _RULES_CC_DEFS},
    )
    _generated_repository(
        name = "remote_coverage_tools",
        files = {"BUILD": _COVERAGE_BUILD, "unavailable.sh": _COVERAGE_SCRIPT},
    )

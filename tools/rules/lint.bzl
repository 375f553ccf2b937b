"""lint_test(): the last line of every BUILD file that has C++."""

load("//tools/rules/install:install.bzl", "installed_part")
load(
    "//tools/rules/layers:layers.bzl",
    "PACKAGES",
    "PRIVATE_PACKAGES",
    "layer_of",
    "layer_test",
)

def _declare_installed_part():
    """Declares the headers and objects of this package for an installation."""
    package = native.package_name()
    if package not in PACKAGES[layer_of(package)]:
        fail("//{} is not in PACKAGES of tools/rules/layers/layers.bzl".format(package))
    installed_part(
        name = "installed_part",
        libraries = [
            ":" + rule["name"]
            for rule in native.existing_rules().values()
            if rule["kind"] == "cc_library" and not rule.get("testonly", False)
        ],
        private = package in PRIVATE_PACKAGES,
        tags = ["manual"],
        visibility = ["//tools/rules/install:__pkg__"],
    )

def lint_test():
    """Tests the format and, in a layer, the dependencies of the rules above."""
    if layer_of(native.package_name()):
        layer_test()
    if layer_of(native.package_name()) in PACKAGES:
        _declare_installed_part()
    sources = {}
    for rule in native.existing_rules().values():
        for attr in ("srcs", "hdrs"):
            for source in rule.get(attr) or []:
                if source.endswith(".h") or source.endswith(".cc"):
                    sources[source] = True
    if not sources:
        return
    native.sh_test(
        name = "format_test",
        size = "small",
        srcs = ["//tools/rules:format_test.sh"],
        args = ["$(rootpath {})".format(source) for source in sorted(sources)],
        data = sorted(sources) + ["//:.clang-format"],
        tags = ["lint"],
    )

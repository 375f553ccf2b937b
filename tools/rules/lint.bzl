"""lint_test(): the last line of every BUILD file that has C++."""

load("//tools/rules/layers:layers.bzl", "layer_of", "layer_test")

def lint_test():
    """Tests the format and, in a layer, the dependencies of the rules above."""
    if layer_of(native.package_name()):
        layer_test()
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

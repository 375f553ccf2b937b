"""poise_py_test(): a test in Python that imports poise."""

def poise_py_test(name, src = None, data = [], size = "small", args = [], slow = False):
    """Runs a script with `import poise`. Debian's Bazel cannot run a py_test.

    A sanitizer's runtime would have to be loaded before Python, so sanitized
    builds skip these tests.

    Args:
      name: The name of the test.
      src: The script; NAME.py by default.
      data: Files that the script needs, besides the package.
      size: As of any test.
      args: More arguments of the script.
      slow: Whether the default run leaves the test out. .ci/run then runs it
        as part of //python:slow_tests, which must list it.
    """
    src = src or name + ".py"
    native.sh_test(
        name = name,
        size = size,
        srcs = ["//python/tests:run.sh"],
        args = ["$(rootpath {})".format(src)] + args,
        data = data + [
            src,
            "//python:poise",
        ],
        tags = [
            "no-sanitizers",
            "python",
        ] + (["manual"] if slow else []),
    )

"""Tests in Python that import poise, and the suite of a package's tests."""

def poise_py_test(name, src = None, data = [], size = "small", args = []):
    """Runs a script with `import poise`. Debian's Bazel cannot run a py_test.

    Only //python:tests runs it, not //...: the module takes two minutes to compile.
    A sanitizer's runtime would have to be loaded before Python, so sanitized
    builds skip these tests.

    Args:
      name: The name of the test.
      src: The script; NAME.py by default.
      data: Files that the script needs, besides the package.
      size: As of any test.
      args: More arguments of the script.
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
            "manual",
            "no-sanitizers",
            "python",
        ],
    )

def poise_py_suite():
    """Declares :tests with the package's tests so far, for //python:tests."""
    native.test_suite(
        name = "tests",
        tags = ["manual"],
        tests = [
            name
            for name, rule in native.existing_rules().items()
            if "python" in rule["tags"]
        ],
        visibility = ["//python:__pkg__"],
    )

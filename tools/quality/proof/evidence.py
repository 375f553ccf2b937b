# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Reads the sources: public functions, tests, and which test names which."""

import collections
import functools
import re

from cpp_source import Source

LAYERS = ("math", "dynamics", "hqp")
KINDS = ("oracle", "property", "Ceres", "closed form")
# A closed form is listed in the table, but alone it is not a proof.
PROOFS = KINDS[:3]

# Words that mark an independent second derivation: another library, another
# algorithm, or a test that compares two ways to the same result.
_ORACLE_WORDS = {
    "mpreal", "mpfr", "KDL", "MultiBodyTree", "mjModel", "mj_forward",
    "Certify", "Certifier",
}
_ORACLE_NAME = re.compile(
    r"Agree|Match|BothSolvers|Same(Optimum|Nullities)|AreEigens|AsIn|Column|"
    r"(Is|Are)The(Sums?Of(Mag|Odd|Prod|Scal)|Dot|Largest|Outer|Base|Rows)|"
    r"SumsOver|ThePoints|AsTheLevels|Differen|Reproduce|Ulp"
)
# Names of tests that compare with numbers computed by hand.
_BY_HAND_NAME = re.compile(r"ByHand|OnPaper|IsFinite|Constructed")
# A certificate is not evidence where the certificate itself is tested.
_CERTIFICATE_TEST = re.compile(r"^hqp/certificate\w*_test\.cc$")
# Names of round trips and of invariants.
_PROPERTY_NAME = re.compile(r"ComeBack|KeepEach")
# Tests of allocation or of invalid input say nothing about the numbers.
_ASIDE_NAME = re.compile(r"Alloc|Throw|Refuse|NotFinite")
_TEST_MACROS = {
    "TEST", "TEST_F", "TEST_P", "TYPED_TEST", "RC_GTEST_PROP",
    "RC_GTEST_FIXTURE_PROP",
}


class Test:
    def __init__(self, path, suite, name, is_property, words, headers):
        self.path = path
        self.name = f"{suite}.{name}"
        self.words = words
        self.headers = headers
        if _ASIDE_NAME.search(name):
            self.kind = "closed form"
        elif "ceres" in words:
            self.kind = "Ceres"
        elif is_property or {"rc", "check"} <= words or _PROPERTY_NAME.search(name):
            self.kind = "property"
        elif _BY_HAND_NAME.search(self.name):
            self.kind = "closed form"
        elif _ORACLE_NAME.search(name) or (
            words & _ORACLE_WORDS and not _CERTIFICATE_TEST.search(path)
        ):
            self.kind = "oracle"
        else:
            self.kind = "closed form"

    def names(self, path, function, classes):
        """Returns whether a test calls a function of a header, judged by words.

        An operator is called without a word: so the test must name its class,
        or a free one's header must have a class that the test names.
        """
        if path not in self.headers:
            return False
        *scope, last = function.split("::")
        if last.startswith("operator"):
            return bool(set(scope or classes) & self.words)
        return last in self.words and set(scope) <= self.words


class Helpers:
    """Names that functions of a file and of tests/util use when called."""

    def __init__(self, sources):
        self._words = collections.defaultdict(set)
        for source in sources:
            self.add(source)

    def add(self, source):
        for function in source.functions:
            if function.name in _TEST_MACROS:
                continue
            words = source.words(function)
            self._words[function.name.split("::")[-1]] |= words
            scope = function.scope or "::".join(function.name.split("::")[:-1])
            if scope:
                # A test that makes or uses a class counts for all of its members.
                self._words[scope.split("::")[-1]] |= words

    def reach(self, words):
        reached, new = set(words), set(words)
        while new:
            new = set().union(*(self._words.get(w, set()) for w in new)) - reached
            reached |= new
        return reached

    def extended(self, sources):
        other = Helpers([])
        other._words = collections.defaultdict(
            set, {k: set(v) for k, v in self._words.items()}
        )
        for source in sources:
            other.add(source)
        return other


class Workspace:
    def __init__(self, root):
        self.root = root

    @functools.lru_cache(None)
    def source(self, path):
        return Source((self.root / path).read_text())

    @functools.lru_cache(None)
    def headers(self, path):
        """Returns the headers of the workspace that a file includes, also indirectly."""
        found, new = set(), {path}
        while new:
            included = set()
            for each in new:
                text = (self.root / each).read_text()
                included.update(re.findall(r'^#include "poise/([^"]+)"', text, re.M))
            new = {i for i in included - found if (self.root / i).is_file()}
            found |= new
        return found

    @functools.lru_cache(None)
    def classes(self, path):
        """Returns the classes on which the operators of a header work.

        A header without classes has the operators of a header that it includes.
        """
        text = self.source(path).text
        layer = path.split("/")[0]
        included = re.findall(rf'^#include "poise/({layer}/[^"]+)"', text, re.M)
        for each in [text, *(self.source(name).text for name in included)]:
            found = re.findall(r"^(?:struct|class|using) (\w+)", each, re.M)
            if found:
                return set(found)
        return set()

    @functools.lru_cache(None)
    def library_files(self, layer):
        return [
            str(path.relative_to(self.root))
            for path in sorted((self.root / layer).rglob("*"))
            if path.suffix in (".h", ".cc")
            and not path.stem.endswith(("_test", "_benchmark"))
        ]

    @functools.lru_cache(None)
    def test_headers(self, package):
        """Returns the headers of a package that only tests may use."""
        rules = (self.root / package / "BUILD").read_text().split("\n)\n")
        return {
            f"{package}/{header}"
            for rule in rules if "testonly = True" in rule
            for header in re.findall(r'"(\w+\.h)"', rule)
        }

    def public_functions(self):
        """Yields (header, qualified name), once for all overloads of a header."""
        found = {}
        for layer in LAYERS:
            for path in self.library_files(layer):
                package = path.rpartition("/")[0]
                if path.endswith(".cc") or path in self.test_headers(package):
                    continue
                for function in self.source(path).functions:
                    if function.is_public and not function.is_local and (
                        "~" not in function.name and function.name.isprintable()
                    ):
                        found[path, function.qualified] = None
        return list(found)

    def defining_files(self, path, name):
        """Returns the files with the bodies of a header's function."""
        layer, stem = path.split("/")[0], path.rsplit(".", 1)[0]

        def defines(file):
            return any(
                f.qualified == name and f.body != f.last
                for f in self.source(file).functions
            )

        files = [path] if defines(path) else []
        if f"{stem}.cc" in self.library_files(layer) and defines(f"{stem}.cc"):
            return files + [f"{stem}.cc"]
        return files + [
            file for file in self.library_files(layer)
            if file.endswith(".cc") and defines(file) and re.search(
                rf'^#include "poise/{re.escape(path)}"', self.source(file).text, re.M
            )
        ]

    def tests(self):
        util = [
            str(path.relative_to(self.root))
            for path in sorted((self.root / "tests/util").glob("*"))
            if path.suffix in (".h", ".cc") and not path.stem.endswith("_test")
        ]
        # Only the headers of tests/util that a test includes: there, words such as
        # Set or Solve name many functions.
        common = functools.lru_cache(None)(
            lambda paths: Helpers(self.source(path) for path in sorted(paths))
        )
        tests = []
        for folder in LAYERS + ("tests", "robot"):
            for path in sorted((self.root / folder).rglob("*_test.cc")):
                path = str(path.relative_to(self.root))
                source, headers = self.source(path), self.headers(path)
                # The helper's source may call functions that its header does not name.
                for header in list(headers):
                    helper = header.rsplit(".", 1)[0] + ".cc"
                    if helper in util:
                        headers = headers | self.headers(helper)
                fixtures = headers & self.test_headers(path.rpartition("/")[0])
                stems = {header.rsplit(".", 1)[0] for header in headers}
                used = {each for each in util if each.rsplit(".", 1)[0] in stems}
                helpers = common(frozenset(used)).extended(
                    [source] + [self.source(fixture) for fixture in fixtures]
                )
                for function in source.functions:
                    if function.name not in _TEST_MACROS:
                        continue
                    words = [
                        t.text
                        for t in source.tokens[function.first : function.last]
                        if t.kind == "word"
                    ]
                    macro, suite, name = words[:3]
                    tests.append(Test(
                        path, suite, name, macro.startswith("RC_"),
                        helpers.reach(set(words)), headers,
                    ))
        return tests

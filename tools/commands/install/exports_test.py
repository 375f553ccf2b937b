#!/usr/bin/env python3
# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Tests the files by which CMake and pkg-config find a layer."""

import pathlib
import re
import unittest

import exports

DYNAMICS = {"name": "dynamics", "needs": ["math"], "externals": ["eigen"],
            "defines": {"EIGEN_MAX_ALIGN_BYTES": "64"}}
ROBOT = {"name": "robot", "needs": ["math"], "defines": {"A": "1"},
         "externals": ["eigen", "urdfdom", "yaml_cpp"]}
ROOT = pathlib.Path(__file__).resolve().parents[3]


class ExportsTest(unittest.TestCase):
    def test_dynamics_needs_eigen_and_math_alone(self):
        text = exports.pkg_config(DYNAMICS, "0.9.0")
        self.assertIn("\nRequires: poise_math, eigen3\n", text)
        self.assertIn("\nVersion: 0.9.0\n", text)
        self.assertIn('"poise::math;Eigen3::Eigen"',
                      exports.cmake_targets(DYNAMICS, "0"))

    def test_targets_define_the_alignment(self):
        self.assertIn("-DEIGEN_MAX_ALIGN_BYTES=64",
                      exports.pkg_config(DYNAMICS, "0.9.0"))
        self.assertEqual(
            exports.cmake_targets(DYNAMICS, "0").count(
                '"EIGEN_MAX_ALIGN_BYTES=64"'), 2)
        self.assertIn("#define POISE_EIGEN_MAX_ALIGN_BYTES 64\n",
                      exports.alignment_header(DYNAMICS["defines"]))

    def test_private_library_is_linked_by_the_static_target_only(self):
        text = exports.cmake_targets(ROBOT, "0")
        self.assertEqual(text.count("PkgConfig::POISE_YAML_CPP;")
                         + text.count('PkgConfig::POISE_YAML_CPP"'), 2)
        self.assertEqual(text.count("$<LINK_ONLY:PkgConfig::POISE_URDFDOM>"), 1)

    def test_a_deeper_folder_of_libraries_leads_to_the_same_prefix(self):
        folder = "lib/x86_64-linux-gnu"
        text = exports.cmake_targets(DYNAMICS, "0", folder)
        self.assertIn('LIST_DIR}/../../../.." REALPATH', text)
        self.assertIn("}/lib/x86_64-linux-gnu/libpoise_dynamics.so.0", text)
        self.assertIn("}/lib/x86_64-linux-gnu/libpoise_dynamics.a", text)
        text = exports.pkg_config(DYNAMICS, "0.9.0", folder)
        self.assertIn("prefix=${pcfiledir}/../../..\n", text)
        self.assertIn("libdir=${prefix}/lib/x86_64-linux-gnu\n", text)
        self.assertIn("prefix=/usr\n", exports.pkg_config(
            DYNAMICS, "0.9.0", folder, "/usr"))

    def test_another_minor_version_is_compatible_from_1_on(self):
        early, late = (exports.cmake_version(v) for v in ("0.9.0", "1.9.0"))
        self.assertIn("MAJOR EQUAL 0 OR\n   NOT PACKAGE_FIND_VERSION_MINOR "
                      "EQUAL 9)", early)
        self.assertIn("MAJOR EQUAL 1)", late)

    def test_colcon_sees_the_same_version(self):
        version = (ROOT / "VERSION").read_text().strip()
        self.assertIn(f"<version>{version}</version>",
                      (ROOT / "package.xml").read_text())

    def test_no_path_is_absolute(self):
        for text in (exports.cmake_targets(ROBOT, "0"),
                     exports.pkg_config(ROBOT, "0.9.0"),
                     exports.cmake_config(["math"])):
            self.assertEqual(re.findall(r'(?<![\w}.>/$])/[a-z]\w*', text), [])

    def test_every_external_library_of_an_installed_layer_is_known(self):
        text = (ROOT / "tools/rules/layers/layers.bzl").read_text()
        packages = re.search(r"^PACKAGES = \{.*?^\}", text, re.M | re.S)[0]
        layers = re.findall(r'^    "([^"]+)":', packages, re.M)
        block = re.search(r"^EXTERNALS = \{.*?^\}", text, re.M | re.S)[0]
        values = [value for layer, found in re.findall(
            r'^    "([^"]+)": \[([^\]]*)\]', block, re.M)
            if layer in layers for value in re.findall(r'"(\w+)"', found)]
        self.assertGreater(len(values), 7)
        self.assertEqual(set(values) - set(exports.EXTERNALS), set())

    def test_setup_installs_what_each_layer_needs(self):
        setup = (ROOT / "tools/setup.sh").read_text()
        packages = {name: words.split() for name, words in re.findall(
            r"^(\w+)=\(([^()]*)\)$", setup, re.M)}
        block = re.search(r"^EXTERNALS = \{.*?^\}", (
            ROOT / "tools/rules/layers/layers.bzl").read_text(), re.M | re.S)[0]
        of_layer = dict(re.findall(r'^    "([^"]+)": \[([^\]]*)\]', block, re.M))
        for layer, arrays in (("math", ["kernels"]), ("dynamics", ["kernels"]),
                              ("hqp", ["kernels"]),
                              ("robot", ["kernels", "robot"]),
                              ("robot/control", ["kernels", "robot"]),
                              ("robot/gait", ["kernels", "robot"]),
                              ("sim", ["kernels", "robot", "sim"])):
            with self.subTest(layer=layer):
                names = re.findall(r'"(\w+)"', of_layer[layer])
                self.assertGreater(len(names), 0)
                self.assertEqual(
                    {exports.EXTERNALS[name].debian for name in names}
                    - {word for name in arrays for word in packages[name]},
                    set())

    def test_libraries_are_those_that_bazel_finds(self):
        text = (ROOT / "tools/rules/workspace/default.bzl").read_text()
        rules = {}
        for body in re.findall(r"system_repository\((.*?)\n    \)", text, re.S):
            rule = dict(re.findall(r'(\w+) = "([^"]+)"', body))
            rules[rule["name"]] = rule
        for name, external in exports.EXTERNALS.items():
            with self.subTest(name=name):
                self.assertEqual(external.debian, rules[name]["debian_package"])
                self.assertEqual(external.module,
                                 rules[name].get("pkg_config", ""))


if __name__ == "__main__":
    unittest.main()

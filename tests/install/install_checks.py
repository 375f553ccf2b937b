#!/usr/bin/env python3
# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Checks an installation; run by tools/quality/install_test.sh.

POISE_WORK is a temporary folder, in which prefix/ is the installation.
POISE_LAYERS is set if it has only some layers.
"""

import collections
import concurrent.futures
import os
import pathlib
import re
import shutil
import subprocess
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
WORK = pathlib.Path(os.environ["POISE_WORK"])
PREFIX = WORK / "prefix"
HAS_ALL_LAYERS = "POISE_LAYERS" not in os.environ
LAYERS = os.environ.get("POISE_LAYERS", "").split(",")
EXAMPLE = ROOT / "docs/examples/cmake"
REACH = ROOT / "docs/examples/arm_reach"
LIBRARIES = sorted(PREFIX.glob("lib/libpoise_*.so.0"))
# Libraries that any C++ program has.
RUNTIME = {"libstdc++.so.6", "libm.so.6", "libgcc_s.so.1", "libc.so.6",
           "ld-linux-x86-64.so.2"}
# As an -isystem folder, it would hide the C library's headers from those of C++.
SYSTEM_INCLUDES = pathlib.Path("/usr/include")
SENTENCE = "This file aligns Eigen's memory differently"


def run(*command, **options):
    """Returns the finished command, with its text output."""
    return subprocess.run(
        [str(word) for word in command], text=True, check=False,
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, **options)


def needed(library):
    return set(re.findall(r"\(NEEDED\).*\[(.+)\]",
                          run("readelf", "-d", library).stdout))


def page_blocks(language):
    """Returns the code blocks of the page for CMake in this language."""
    page = (ROOT / "docs/quickstart/cmake.md").read_text()
    return re.findall(rf"```{language}\n(.*?)```", page, re.S)


class Checks(unittest.TestCase):
    def succeed(self, *command, **options):
        result = run(*command, **options)
        self.assertEqual(result.returncode, 0, f"{command}\n{result.stdout}")
        return result.stdout

    def cmake(self, source, name, *options):
        """Configures and builds; returns the build folder."""
        build = WORK / name
        self.succeed("cmake", "-S", source, "-B", build,
                     "-DCMAKE_BUILD_TYPE=Release", *options)
        self.succeed("cmake", "--build", build)
        return build


class SymbolsTest(Checks):
    def test_each_symbol_is_exported_by_one_library(self):
        self.assertGreater(len(LIBRARIES), 6 if HAS_ALL_LAYERS else 0)
        owners = collections.defaultdict(list)
        for library in LIBRARIES:
            printed = self.succeed("nm", "-D", "--defined-only", library)
            symbols = [line.split()[-1] for line in printed.splitlines()]
            self.assertTrue(symbols, library)
            for symbol in symbols:
                owners[symbol].append(library.name)
        self.assertEqual(
            {s: where for s, where in owners.items() if len(where) > 1}, {})
        self.assertEqual([s for s in owners if "5poise" not in s], [])

    def test_private_functions_are_hidden(self):
        printed = "".join(self.succeed("nm", "-DC", "--defined-only", library)
                          for library in LIBRARIES)
        for name in ("ComputeRnea(", "Solver::Solve("):
            self.assertIn(name, printed)
        for header in [*ROOT.glob("dynamics/simd/*.h"),
                       *ROOT.glob("hqp/fast/*.h")]:
            text = header.read_text()
            for name in re.findall(r"^(?:void|bool|int|double) (\w+)\(", text,
                                   re.M):
                self.assertNotIn(f"poise::{name}(", printed)
            for name in re.findall(r"^(?:class|struct) (\w+) (?:final )?[:{]",
                                   text, re.M):
                self.assertNotIn(f"poise::{name}::", printed)

    def test_libraries_know_no_path_of_the_build(self):
        for library in LIBRARIES:
            printed = self.succeed("readelf", "-d", library)
            self.assertEqual(re.findall(
                r"\((?:RUNPATH|RPATH)\).*\[(.*)\]", printed), ["$ORIGIN"])
            self.assertIn(f"[{library.name}]", printed)
            content = library.read_bytes()
            for path in (b"/root", b"bazel-out", bytes(ROOT)):
                self.assertNotIn(path, content)

    def test_each_library_needs_its_own_dependencies_only(self):
        needs = {re.sub(r"libpoise_|\.so.*", "", library.name):
                 needed(library) - RUNTIME for library in LIBRARIES}
        self.assertEqual(needs["math"], set())
        self.assertEqual(needs["dynamics"], {"libpoise_math.so.0"})
        self.assertEqual(needs["hqp"], {"libpoise_math.so.0"})
        robot = {name for name in needs["robot"] if "poise" not in name}
        self.assertEqual({name for name in robot if not re.match(
            r"lib(urdfdom|console_bridge|tinyxml2|yaml-cpp)",
            name)}, set())
        if HAS_ALL_LAYERS:
            self.assertTrue(any("Bullet" in name for name in needs["sim"]))


class HeadersTest(Checks):
    def test_private_headers_are_not_installed(self):
        self.assertFalse((PREFIX / "include/poise/dynamics/simd").exists())
        self.assertFalse((PREFIX / "include/poise/hqp/fast").exists())

    def test_every_public_header_is_installed(self):
        layers = ("math", "dynamics", "hqp", "robot", "sim")
        tree = {f"{path.relative_to(ROOT)}" for layer in layers
                for path in (ROOT / layer).rglob("*.h")
                if not re.search(r"/simd/|/fast/|_fixture\.h$", str(path))}
        installed = {str(path.relative_to(PREFIX / "include/poise"))
                     for path in PREFIX.glob("include/poise/**/*.h")}
        # A library for tests, and a header that the installation writes.
        self.assertEqual(tree - installed, {"math/measure_accuracy.h"})
        self.assertEqual(installed - tree, {"math/installed_alignment.h"})

    def test_each_header_compiles_alone(self):
        headers = [path.relative_to(PREFIX / "include")
                   for path in sorted(PREFIX.glob("include/poise/**/*.h"))]
        flags = [f"-I{PREFIX}/include"]
        for word in run("pkg-config", "--cflags", "poise_sim",
                        env=ENVIRONMENT).stdout.split():
            if word.startswith("-D"):
                flags.append(word)
            elif (not word.startswith(f"-I{PREFIX}") and
                  pathlib.Path(word[2:]).resolve() != SYSTEM_INCLUDES):
                flags.append("-isystem" + word[2:])

        def compile_alone(job):
            mode, names = job
            result = run(*mode, "-fsyntax-only", "-Wall", "-Wextra",
                         "-Wconversion", "-pedantic", "-Werror", *flags,
                         "-x", "c++", "-",
                         input="".join(f'#include "{n}"\n' for n in names))
            return None if result.returncode == 0 else (
                f"{mode} {names[0]}: {result.stdout[:400]}")

        modes = [(compiler, f"-std={standard}")
                 for compiler in ("g++", "clang++")
                 for standard in ("c++17", "c++20")]
        jobs = [(mode, [header]) for mode in modes for header in headers]
        if os.environ.get("POISE_QUICK"):
            jobs = [(modes[0], [header]) for header in headers] + [
                (mode, headers) for mode in modes[1:]]
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            failed = [f for f in pool.map(compile_alone, jobs) if f]
        self.assertEqual(failed, [], f"{len(failed)} of {len(jobs)}")

    def test_each_header_with_eigen_notices_another_alignment(self):
        headers = [path.relative_to(PREFIX / "include")
                   for path in sorted(PREFIX.glob("include/poise/**/*.h"))]
        flags = [f for f in run("pkg-config", "--cflags", "poise_sim",
                                env=ENVIRONMENT).stdout.split()
                 if not f.startswith("-D")]

        def compile_without_definitions(header):
            return run("g++", "-std=c++17", "-fsyntax-only", *flags, "-x", "c++",
                       "-", input=f'#include "{header}"\n#ifdef EIGEN_CORE_H\n'
                       "#error Eigen is included\n#endif\n").stdout

        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            printed = dict(zip(headers, pool.map(compile_without_definitions,
                                                 headers)))
        with_eigen = {h for h in headers if "Eigen is included" in printed[h]}
        noticed = {h for h in headers if SENTENCE in printed[h]}
        self.assertGreater(len(with_eigen), len(headers) / 2)
        self.assertEqual(with_eigen - noticed, set())


ENVIRONMENT = {
    **os.environ, "PKG_CONFIG_PATH": str(PREFIX / "lib/pkgconfig"),
    "LD_LIBRARY_PATH": str(PREFIX / "lib")}
FIND = f"-DCMAKE_PREFIX_PATH={PREFIX}"


class ConsumerTest(Checks):
    def run_examples(self, name, *options):
        """Builds and runs a program of the dynamics and one of the solver."""
        build = self.cmake(EXAMPLE, name, FIND, *options)
        self.assertIn("shoulder", self.succeed(
            build / "arm_torques", EXAMPLE / "arm.urdf"))
        build = self.cmake(REACH, f"{name}_reach", FIND, *options)
        self.assertIn("error", self.succeed(build / "arm_reach"))

    def test_programs_without_march_native(self):
        self.run_examples("generic")

    def test_the_project_of_the_quickstart_page(self):
        source = WORK / "page"
        source.mkdir()
        (source / "CMakeLists.txt").write_text(page_blocks("cmake")[0])
        shutil.copy(ROOT / "docs/examples/dynamics/main.cc", source)
        self.assertIn("floating", self.succeed(
            self.cmake(source, "page_build", FIND) / "my_robot"))

    def test_quadruped(self):
        build = self.cmake(ROOT / "docs/examples/quadruped", "quadruped", FIND)
        self.assertIn("weight 147.150 N", self.succeed(build / "quadruped"))

    @unittest.skipUnless(HAS_ALL_LAYERS or "control" in LAYERS, "has no control")
    def test_controller_of_a_biped(self):
        build = self.cmake(ROOT / "tests/embedding", "balance", FIND)
        printed = self.succeed(build / "balance",
                               ROOT / "robot/models/humanoid.urdf",
                               ROOT / "robot/profiles/humanoid.yaml")
        self.assertRegex(printed, r"torque of the left knee: -?\d+\.\d+ N m")

    def test_programs_with_march_native(self):
        self.run_examples("native", "-DCMAKE_CXX_FLAGS=-march=native")

    def test_static_libraries_with_and_without_march_native(self):
        for example, program in ((EXAMPLE, "arm_torques"), (REACH, "arm_reach")):
            source = WORK / f"static_{program}"
            shutil.copytree(example, source)
            lists = source / "CMakeLists.txt"
            lists.write_text(re.sub(r"poise::(\w+)\)", r"poise::\1_static)",
                                    lists.read_text()))
            for name, flag in (("generic", ""), ("native", "-march=native")):
                build = self.cmake(source, f"static_{program}_{name}", FIND,
                                   f"-DCMAKE_CXX_FLAGS={flag}")
                self.assertFalse([lib for lib in needed(build / program)
                                  if "poise" in lib])
                self.succeed(build / program, *source.glob("arm.urdf"))

    def test_another_alignment_is_a_compile_time_error_with_a_sentence(self):
        for flag in ("-DEIGEN_MAX_ALIGN_BYTES=16", "-DEIGEN_MAX_ALIGN_BYTES=32",
                     "-DEIGEN_MAX_STATIC_ALIGN_BYTES=32",
                     "-DEIGEN_MALLOC_ALREADY_ALIGNED=1"):
            build = WORK / f"undone{flag}"
            self.succeed("cmake", "-S", EXAMPLE, "-B", build, FIND,
                         f"-DCMAKE_CXX_FLAGS={flag}")
            result = run("cmake", "--build", build)
            self.assertNotEqual(result.returncode, 0, flag)
            self.assertIn(SENTENCE, result.stdout)

    def test_missing_definitions_are_a_compile_time_error(self):
        result = run("g++", "-std=c++17", "-fsyntax-only", "-isystem",
                     "/usr/include/eigen3", f"-I{PREFIX}/include",
                     REACH / "main.cc")
        self.assertIn(SENTENCE, result.stdout)

    def test_pkg_config(self):
        flags = self.succeed("pkg-config", "--cflags", "--libs", "poise_hqp",
                             env=ENVIRONMENT).split()
        program = WORK / "by_pkg_config"
        self.succeed("g++", "-std=c++17", REACH / "main.cc", *flags,
                     "-o", program)
        self.succeed(program, env=ENVIRONMENT)

    def test_all_layers_are_found_and_an_unknown_one_is_not(self):
        source = WORK / "find"
        source.mkdir()
        lists = source / "CMakeLists.txt"
        start = "cmake_minimum_required(VERSION 3.22)\nproject(x CXX)\n"
        lists.write_text(start + "find_package(poise 0.9 REQUIRED)\n"
                         "file(WRITE main.cc \"int main() {}\")\n"
                         "add_executable(x main.cc)\n"
                         "target_link_libraries(x poise::sim poise::gait)\n")
        self.cmake(source, "find_all", FIND)
        for wanted, message in (
                ("REQUIRED COMPONENTS wings", "no component wings"),
                ("1.0 REQUIRED", r'version "1.0"'),
                ("0.8 REQUIRED", r'version "0.8"'),
                ("0.10 REQUIRED", r'version "0.10"')):
            lists.write_text(f"{start}find_package(poise {wanted})\n")
            result = run("cmake", "-S", source, "-B", WORK / "find_none", FIND)
            self.assertNotEqual(result.returncode, 0, wanted)
            self.assertIn(message, re.sub(r"\s+", " ", result.stdout))

    def test_a_layer_without_its_libraries_is_left_out_unless_required(self):
        source = WORK / "without_libraries"
        source.mkdir()
        lists = source / "CMakeLists.txt"
        start = "cmake_minimum_required(VERSION 3.22)\nproject(x CXX)\n"
        without = {**os.environ, "PKG_CONFIG_LIBDIR": str(source)}
        for components in ("", " REQUIRED COMPONENTS dynamics "
                           "OPTIONAL_COMPONENTS robot"):
            lists.write_text(
                f"{start}find_package(poise {components})\n"
                "if(poise_FOUND AND poise_dynamics_FOUND)\n"
                "  message(STATUS \"poise is found\")\nendif()\n"
                "foreach(name dynamics hqp robot sim)\n"
                "  if(TARGET poise::${name})\n"
                "    message(STATUS \"there is ${name}\")\n"
                "  endif()\nendforeach()\n")
            printed = self.succeed("cmake", "-S", source, "-B",
                                   source / "build", FIND, env=without)
            self.assertIn("poise is found", printed)
            self.assertIn("No target poise::robot: poise::robot needs ", printed)
            self.assertIn("there is dynamics", printed)
            self.assertNotIn("there is robot", printed)
        lists.write_text(
            f"{start}find_package(poise REQUIRED COMPONENTS robot)\n")
        result = run("cmake", "-S", source, "-B", source / "build", FIND,
                     env=without)
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("poise::robot needs ", result.stdout)
        self.assertIn("on Debian lib", re.sub(r"\s+", " ", result.stdout))


class FolderTest(Checks):
    """Poise as a folder of another CMake project."""

    def test_add_subdirectory_and_install(self):
        source = WORK / "folder_source"
        shutil.copytree(REACH, source)
        lists = source / "CMakeLists.txt"
        lists.write_text(re.sub(
            r"find_package.*", f"set(POISE_LAYERS hqp)\nadd_subdirectory({ROOT} poise)",
            lists.read_text()))
        build = self.cmake(source, "folder")
        self.succeed(build / "arm_reach")
        self.succeed("cmake", "--install", build, "--prefix", WORK / "copied")
        self.cmake(REACH, "copied_build", f"-DCMAKE_PREFIX_PATH={WORK / 'copied'}")

    # tools/quality/package_test.sh fetches it by Git, in a bare Debian.
    def test_fetch_content_of_the_quickstart_page(self):
        source = WORK / "fetched_source"
        source.mkdir()
        (source / "CMakeLists.txt").write_text(
            "cmake_minimum_required(VERSION 3.22)\nproject(x LANGUAGES CXX)\n"
            "add_executable(my_robot main.cc)\n" + page_blocks("cmake")[1])
        shutil.copy(ROOT / "docs/examples/dynamics/main.cc", source)
        build = self.cmake(source, "fetched", "-DURL_OF_POISE=unused",
                           "-DCOMMIT_OF_POISE=unused",
                           f"-DFETCHCONTENT_SOURCE_DIR_POISE={ROOT}")
        self.assertIn("floating", self.succeed(build / "my_robot"))


class CommandTest(Checks):
    def install(self, *arguments):
        return run("bazel", "run", "//tools:install", "--", *arguments,
                   cwd=ROOT)

    def test_failure_half_way_undoes_all(self):
        prefix = WORK / "blocked"
        (prefix / "lib").mkdir(parents=True)
        (prefix / "lib/pkgconfig").write_text("in the way")
        result = self.install("--prefix", prefix, "--layers", "math")
        self.assertEqual(result.returncode, 1, result.stdout)
        self.assertIn("nothing was installed", result.stdout)
        self.assertEqual([str(path.relative_to(prefix)) for path in
                          sorted(prefix.rglob("*"))], ["lib", "lib/pkgconfig"])

    def test_uninstall_leaves_an_empty_folder(self):
        prefix = WORK / "removed"
        result = self.install("--prefix", prefix, "--layers", "dynamics")
        self.assertEqual(result.returncode, 0, result.stdout)
        self.assertTrue((prefix / "lib/libpoise_math.so.0").exists())
        self.assertFalse((prefix / "lib/libpoise_hqp.so.0").exists())
        result = self.install("--prefix", prefix, "--uninstall")
        self.assertEqual(result.returncode, 0, result.stdout)
        self.assertEqual(list(prefix.iterdir()), [])


if __name__ == "__main__":
    unittest.main(verbosity=2)

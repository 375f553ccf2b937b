"""Every external repository this workspace uses, in one place."""

load("//tools/rules/workspace:debian_bazel.bzl", "add_debian_bazel_repositories")
load("//tools/rules/workspace:system_repository.bzl", "system_repository")

def add_default_repositories():
    add_debian_bazel_repositories()

    system_repository(
        name = "eigen",
        pkg_config = "eigen3",
        atleast_version = "3.4",
        debian_package = "libeigen3-dev",
    )
    system_repository(
        name = "urdfdom",
        pkg_config = "urdfdom",
        atleast_version = "3.0",
        debian_package = "liburdfdom-dev",
    )
    system_repository(
        name = "tinyxml2",
        pkg_config = "tinyxml2",
        debian_package = "libtinyxml2-dev",
    )
    system_repository(
        name = "yaml_cpp",
        pkg_config = "yaml-cpp",
        debian_package = "libyaml-cpp-dev",
    )
    system_repository(
        name = "nlohmann_json",
        pkg_config = "nlohmann_json",
        debian_package = "nlohmann-json3-dev",
    )
    system_repository(
        # libcrypto only: digests and base64, no TLS.
        name = "openssl",
        pkg_config = "libcrypto",
        atleast_version = "3.0",
        debian_package = "libssl-dev",
    )
    system_repository(
        # cairo.pc adds its own folder to the search path; <cairo/cairo.h>
        # needs none.
        name = "cairo",
        linkopts = ["-lcairo"],
        header = "cairo/cairo.h",
        debian_package = "libcairo2-dev",
    )
    system_repository(
        name = "cli11",
        pkg_config = "CLI11",
        debian_package = "libcli11-dev",
    )
    system_repository(
        # bullet.pc is the single precision build.
        name = "bullet",
        pkg_config = "bullet-float64",
        atleast_version = "3.0",
        debian_package = "libbullet-dev",
    )
    system_repository(
        # The package has no .pc file.
        name = "mujoco",
        linkopts = ["-lmujoco"],
        header = "mujoco/mujoco.h",
        debian_package = "libmujoco-dev",
    )

    system_repository(
        # The headers of Python itself; a module is not linked with libpython.
        # NumPy's headers are not needed, because pybind11 has its own.
        name = "pybind11",
        pkg_config = "python3",
        header = "pybind11/pybind11.h",
        debian_package = "pybind11-dev and python3-dev",
    )

    # Tests only.
    system_repository(
        name = "gtest",
        pkg_config = "gtest",
        debian_package = "libgtest-dev",
        for_tests_only = True,
    )
    system_repository(
        name = "gtest_main",
        pkg_config = "gtest_main",
        debian_package = "libgtest-dev",
        for_tests_only = True,
    )
    system_repository(
        name = "benchmark",
        pkg_config = "benchmark",
        linkopts = ["-lbenchmark_main", "-lpthread"],
        debian_package = "libbenchmark-dev",
        for_tests_only = True,
    )
    system_repository(
        # Debian ships no ceres.pc; its own dependencies have one.
        name = "ceres",
        pkg_config = "libglog",
        linkopts = ["-lceres", "-lgflags"],
        header = "ceres/ceres.h",
        debian_package = "libceres-dev",
        for_tests_only = True,
        deps = ["@eigen"],
    )
    system_repository(
        # There is no rapidcheck.pc either; RapidCheck is used with GoogleTest.
        name = "rapidcheck",
        pkg_config = "gtest",
        linkopts = ["-lrapidcheck"],
        header = "rapidcheck.h",
        debian_package = "librapidcheck-dev",
        for_tests_only = True,
    )
    system_repository(
        name = "mpreal",
        linkopts = ["-lmpfr", "-lgmp"],
        header = "mpreal.h",
        debian_package = "libmpfrc++-dev",
        for_tests_only = True,
    )
    system_repository(
        # gmpxx.pc is the C++ interface; <gmpxx.h> needs no folder.
        name = "gmp",
        pkg_config = "gmpxx",
        header = "gmpxx.h",
        debian_package = "libgmp-dev",
        for_tests_only = True,
    )
    system_repository(
        name = "kdl",
        pkg_config = "orocos-kdl",
        debian_package = "liborocos-kdl-dev",
        for_tests_only = True,
        deps = ["@eigen"],
    )
    system_repository(
        # fcl.pc asks for C++11.
        name = "fcl",
        linkopts = ["-lfcl", "-lccd"],
        header = "fcl/fcl.h",
        debian_package = "libfcl-dev",
        for_tests_only = True,
        deps = ["@eigen"],
    )
    system_repository(
        # An oracle and a baseline, if installed by setup.sh --baselines. Debian has
        # no headers; //tests/util:bullet_tree declares the functions.
        name = "bullet_inverse_dynamics",
        pkg_config = "bullet-float64",
        linkopts = ["-lBulletInverseDynamics-float64"],
        optional_library = "libBulletInverseDynamics-float64.so",
        defines = ["POISE_HAS_BULLET_INVERSE_DYNAMICS"],
        debian_package = "libbullet-extras-dev",
        for_tests_only = True,
    )

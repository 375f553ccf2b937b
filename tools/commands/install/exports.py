# Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
"""Writes the files by which CMake and pkg-config find an installed Poise.

All paths in these files are relative to the files, so that a prefix can be
moved or copied. The folder of the libraries is "lib", or as Debian has it,
"lib/x86_64-linux-gnu".
"""

import dataclasses


@dataclasses.dataclass(frozen=True)
class External:
    """A library of the system."""

    debian: str  # Debian package with its headers.
    module: str = ""  # Name of its pkg-config module, if there is one.
    library: str = ""  # Name for -l, if there is no module.
    # Whether public headers of Poise include its headers. Otherwise only the
    # static library needs it.
    in_headers: bool = True


# By the names of the repositories in tools/rules/workspace/default.bzl.
EXTERNALS = {
    "bullet": External("libbullet-dev", "bullet-float64"),
    "eigen": External("libeigen3-dev", "eigen3"),
    "mujoco": External("libmujoco-dev", library="mujoco"),
    "nlohmann_json": External("nlohmann-json3-dev", "nlohmann_json"),
    "openssl": External("libssl-dev", "libcrypto"),
    "tinyxml2": External("libtinyxml2-dev", "tinyxml2"),
    "urdfdom": External("liburdfdom-dev", "urdfdom", in_headers=False),
    "yaml_cpp": External("libyaml-cpp-dev", "yaml-cpp"),
}


def _upwards(libraries):
    """Returns the way from the folder of the libraries to the prefix."""
    return "/".join(".." for _ in libraries.split("/"))


def pkg_config(layer, version, libraries="lib", prefix=None):
    """Returns the .pc file of a layer; a prefix, if given, is fixed."""
    prefix = prefix or f"${{pcfiledir}}/../{_upwards(libraries)}"
    externals = [EXTERNALS[name] for name in layer["externals"]]
    public = [e.module for e in externals if e.module and e.in_headers]
    private = [e.module for e in externals if e.module and not e.in_headers]
    needs = [f"poise_{name}" for name in layer["needs"]]
    defines = [f"-D{name}={value}" for name, value in layer["defines"].items()]
    flags = [f"-l{e.library}" for e in externals if e.library]
    return f"""prefix={prefix}
includedir=${{prefix}}/include
libdir=${{prefix}}/{libraries}

Name: poise_{layer["name"]}
Description: The layer {layer["name"]} of Poise
Version: {version}
Requires: {", ".join(needs + public)}
Requires.private: {", ".join(private)}
Cflags: -I${{includedir}} {" ".join(defines)}
Libs: -L${{libdir}} -lpoise_{layer["name"]}
Libs.private: {" ".join(flags + ["-lstdc++", "-lm"])}
"""


def _not_found(layer, external):
    """Returns the lines that end find_package() for want of a library."""
    return f"""  set(poise_FOUND FALSE)
  set(poise_NOT_FOUND_MESSAGE
    "poise::{layer} needs {external.module or external.library}, which was not found; install it, on Debian {external.debian}, or leave out the component {layer}")
  return()
"""


def _find(name, layer):
    """Returns (CMake target, lines that define it) of a library for a layer."""
    external = EXTERNALS[name]
    if name == "eigen":
        return "Eigen3::Eigen", """if(NOT TARGET Eigen3::Eigen)
  find_dependency(Eigen3 3.4 NO_MODULE)
  # Poise's own targets may be global, and then they need this one everywhere.
  set_target_properties(Eigen3::Eigen PROPERTIES IMPORTED_GLOBAL TRUE)
endif()
"""
    if not external.module:
        variable = f"POISE_{name.upper()}_LIBRARY"
        return f"${{{variable}}}", f"""\
find_library({variable} {external.library})
if(NOT {variable})
{_not_found(layer, external)}endif()
"""
    target = f"POISE_{name.upper()}"
    lines = f"""find_dependency(PkgConfig)
if(NOT TARGET PkgConfig::{target})
  pkg_check_modules({target} QUIET IMPORTED_TARGET GLOBAL {external.module})
endif()
"""
    if external.in_headers:
        lines += f"""if(NOT TARGET PkgConfig::{target})
{_not_found(layer, external)}endif()
"""
    return f"PkgConfig::{target}", lines


def cmake_targets(layer, major, libraries="lib"):
    """Returns the CMake file that defines the two targets of a layer."""
    name = layer["name"]
    lines = [f"# The targets poise::{name} and poise::{name}_static.\n",
             f"if(TARGET poise::{name})\n  return()\nendif()\n",
             "include(CMakeFindDependencyMacro)\n",
             *(f'include("${{CMAKE_CURRENT_LIST_DIR}}/poise_{need}.cmake")\n'
               for need in layer["needs"]),
             "if(DEFINED poise_FOUND AND NOT poise_FOUND)\n",
             "  return()\nendif()\n"]
    public, private = [], []
    for each in layer["externals"]:
        target, found_by = _find(each, name)
        lines.append(found_by)
        (public if EXTERNALS[each].in_headers else private).append(target)
    needs = layer["needs"]
    shared = ";".join([f"poise::{need}" for need in needs] + public)
    static = ";".join([f"poise::{need}_static" for need in needs] + public +
                      [f"$<LINK_ONLY:{target}>" for target in private])
    defines = ";".join(f"{k}={v}" for k, v in layer["defines"].items())
    # Not ABSOLUTE: if /lib is a link to /usr/lib, CMake may find the file there.
    lines.append(f"""
get_filename_component(_poise_prefix
  "${{CMAKE_CURRENT_LIST_DIR}}/../../{_upwards(libraries)}" REALPATH)
add_library(poise::{name} SHARED IMPORTED GLOBAL)
set_target_properties(poise::{name} PROPERTIES
  IMPORTED_LOCATION "${{_poise_prefix}}/{libraries}/libpoise_{name}.so.{major}"
  IMPORTED_SONAME "libpoise_{name}.so.{major}"
  INTERFACE_COMPILE_DEFINITIONS "{defines}"
  INTERFACE_COMPILE_FEATURES cxx_std_17
  INTERFACE_INCLUDE_DIRECTORIES "${{_poise_prefix}}/include"
  INTERFACE_LINK_LIBRARIES "{shared}")
""")
    definition = f"""add_library(poise::{name}_static STATIC IMPORTED GLOBAL)
set_target_properties(poise::{name}_static PROPERTIES
  IMPORTED_LOCATION "${{_poise_prefix}}/{libraries}/libpoise_{name}.a"
  INTERFACE_COMPILE_DEFINITIONS "{defines}"
  INTERFACE_COMPILE_FEATURES cxx_std_17
  INTERFACE_INCLUDE_DIRECTORIES "${{_poise_prefix}}/include"
  INTERFACE_LINK_LIBRARIES "{static}")
"""
    there = " AND ".join(f"TARGET {target}" for target in private)
    lines.append(f"if({there})\n{definition}endif()\n" if there else definition)
    return "".join(lines)


def cmake_config(names):
    """Returns poiseConfig.cmake, for all layers that a prefix may have."""
    return f"""# find_package(poise REQUIRED COMPONENTS dynamics) defines
# poise::dynamics and the targets that it needs. Without COMPONENTS, all
# installed layers are defined whose libraries are there.
set(poise_FOUND TRUE)
set(_poise_components ${{poise_FIND_COMPONENTS}})
if(NOT _poise_components)
  foreach(_poise_name {" ".join(names)})
    if(EXISTS "${{CMAKE_CURRENT_LIST_DIR}}/poise_${{_poise_name}}.cmake")
      list(APPEND _poise_components ${{_poise_name}})
    endif()
  endforeach()
endif()
foreach(_poise_name ${{_poise_components}})
  if(EXISTS "${{CMAKE_CURRENT_LIST_DIR}}/poise_${{_poise_name}}.cmake")
    include("${{CMAKE_CURRENT_LIST_DIR}}/poise_${{_poise_name}}.cmake")
  else()
    set(poise_FOUND FALSE)
    set(poise_NOT_FOUND_MESSAGE
      "poise has no component ${{_poise_name}} in ${{CMAKE_CURRENT_LIST_DIR}}")
  endif()
  if(poise_FOUND)
    set(poise_${{_poise_name}}_FOUND TRUE)
  elseif(poise_FIND_REQUIRED_${{_poise_name}})
    return()
  else()
    message(STATUS
      "No target poise::${{_poise_name}}: ${{poise_NOT_FOUND_MESSAGE}}")
    set(poise_FOUND TRUE)
    unset(poise_NOT_FOUND_MESSAGE)
  endif()
endforeach()
"""


def cmake_version(version):
    """Returns poiseConfigVersion.cmake.

    A program for an earlier version works if the major version is the same,
    and before 1.0 also the minor one.
    """
    major, minor, *_ = version.split(".")
    other = f"NOT PACKAGE_FIND_VERSION_MAJOR EQUAL {major}"
    if major == "0":
        other += f" OR\n   NOT PACKAGE_FIND_VERSION_MINOR EQUAL {minor}"
    return f"""set(PACKAGE_VERSION "{version}")
if(PACKAGE_FIND_VERSION VERSION_GREATER PACKAGE_VERSION OR
   {other})
  set(PACKAGE_VERSION_COMPATIBLE FALSE)
else()
  set(PACKAGE_VERSION_COMPATIBLE TRUE)
  if(PACKAGE_FIND_VERSION VERSION_EQUAL PACKAGE_VERSION)
    set(PACKAGE_VERSION_EXACT TRUE)
  endif()
endif()
"""


def alignment_header(defines):
    """Returns the header that tells math/eigen_alignment.h the alignment."""
    lines = [f"#define POISE_{name} {value}" for name, value in defines.items()]
    return "\n".join([
        "// The alignment of Eigen's memory in the installed libraries.",
        "#pragma once", "", *lines, ""])

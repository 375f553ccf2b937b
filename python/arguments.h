// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

namespace poise {

/// Returns an argument that is one real number; a bool counts as one. Throws
/// std::invalid_argument, which Python sees as poise.InputError.
double AsNumber(pybind11::handle value, const char* name);

/// Returns an argument that is a number of 0 or more. Throws as AsNumber().
double AsNotNegative(pybind11::handle value, const char* name);

/// Returns an argument that is a whole number from lower to upper. Throws as
/// AsNumber().
int AsInteger(pybind11::handle value, const char* name, int lower, int upper);

/// Returns an argument that is True or False, of Python or NumPy. Throws as
/// AsNumber().
bool AsFlag(pybind11::handle value, const char* name);

/// Returns an argument that is a text, or a path of a file (os.PathLike).
/// Throws as AsNumber().
std::string AsText(pybind11::handle value, const char* name);

/// Returns an argument that is a list or another sequence of texts. Throws as
/// AsNumber().
std::vector<std::string> AsTexts(pybind11::handle value, const char* name);

/// Returns a value for a message: at most 60 characters of its repr().
std::string Shown(pybind11::handle value);

/// Returns the name of the type of an object, for messages.
std::string TypeName(pybind11::handle value);

}  // namespace poise

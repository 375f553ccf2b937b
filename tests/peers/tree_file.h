// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>

#include "poise/dynamics/tree.h"

namespace poise {

/// Writes the joints, inertias and frames of a tree into a text file, so that
/// a program without a URDF parser has the same robot. Throws
/// std::runtime_error if the file cannot be written.
void WriteTree(const Tree& tree, const std::string& path);

/// Reads a file of WriteTree(). Throws std::invalid_argument if it is not one.
Tree ReadTree(const std::string& path);

}  // namespace poise

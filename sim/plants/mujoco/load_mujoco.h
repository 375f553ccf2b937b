// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <mujoco/mujoco.h>

#include <memory>
#include <string>

namespace poise {

/// DeleteMujoco frees MuJoCo's memory, for a std::unique_ptr.
struct DeleteMujoco {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
  void operator()(mjData* data) const { mj_deleteData(data); }
};

using MujocoModel = std::unique_ptr<mjModel, DeleteMujoco>;
using MujocoData = std::unique_ptr<mjData, DeleteMujoco>;

/// Loads a model from the text of an XML file, for example of MakeMujocoXml().
/// If MuJoCo rejects it, returns null and fills the error.
MujocoModel LoadMujoco(const std::string& xml, std::string* error);

}  // namespace poise

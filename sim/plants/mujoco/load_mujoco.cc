// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/plants/mujoco/load_mujoco.h"

#include <algorithm>

namespace poise {

static_assert(sizeof(mjtNum) == sizeof(double), "link a double MuJoCo");

namespace {

// Silences MuJoCo, which would warn of a diverging simulation on stderr and in
// a file of the current folder. The judge of the run reports the divergence.
[[maybe_unused]] const bool kIsQuiet = (
    mju_user_warning = [](const char*) {}, true);

}  // namespace

MujocoModel LoadMujoco(const std::string& xml, std::string* error) {
  // MuJoCo has no function that reads XML from a string, so its virtual file
  // system holds the text.
  const auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  constexpr const char* kName = "robot.xml";
  mj_makeEmptyFileVFS(files.get(), kName, static_cast<int>(xml.size()));
  const int index = mj_findFileVFS(files.get(), kName);
  std::copy(xml.begin(), xml.end(), static_cast<char*>(files->filedata[index]));
  char message[500] = "";
  MujocoModel model(mj_loadXML(kName, files.get(), message, sizeof(message)));
  *error = message;
  mj_deleteVFS(files.get());
  return model;
}

}  // namespace poise

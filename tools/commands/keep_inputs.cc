// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/keep_inputs.h"

#include <stdexcept>
#include <system_error>

#include "poise/tools/commands/user_path.h"

namespace poise {

void KeepInputs(const std::string& typed,
                const std::vector<InputFile>& inputs) {
  if (typed.empty()) return;
  for (const InputFile& input : inputs) {
    std::error_code missing;
    if (std::filesystem::equivalent(UserPath(typed), input.file, missing)) {
      throw std::invalid_argument(typed + ": is " + input.name +
                                  " and would be replaced, choose another "
                                  "name");
    }
  }
}

}  // namespace poise

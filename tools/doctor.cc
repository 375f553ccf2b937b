// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Checks a robot file: bazel run //tools:doctor -- FILE.urdf [--json]
//     [--masses] [--package-path DIR] [--profile FILE] [--save-profile FILE]

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "poise/robot/finding.h"
#include "poise/robot/output_file.h"
#include "poise/tools/commands/command_line.h"
#include "poise/tools/commands/doctor/diagnose.h"
#include "poise/tools/commands/doctor/diagnosis.h"
#include "poise/tools/commands/doctor/next_step.h"
#include "poise/tools/commands/doctor/write_diagnosis.h"
#include "poise/tools/commands/keep_inputs.h"
#include "poise/tools/commands/package_path.h"
#include "poise/tools/commands/user_path.h"

namespace poise {
namespace {

// Writes the profile that was found. Throws std::invalid_argument if there is
// none, or if the file cannot be written.
void Save(const Diagnosis& diagnosis, const std::string& name) {
  const std::filesystem::path file = UserPath(name);
  if (diagnosis.profile.empty()) {
    throw std::invalid_argument(name +
                                ": is not written, because no feet were found");
  }
  WriteFile(file, diagnosis.profile);
}

int Main(int argc, char** argv) {
  CLI::App app(
      "Checks a robot file for everything that would make the controller fail "
      "or compute wrong values.",
      "doctor");
  std::string file;
  std::string profile_file;
  std::vector<std::string> packages;
  std::string saved;
  bool json = false;
  bool masses = false;
  app.add_option("file", file, "The robot, a URDF file")->required();
  app.add_option("--profile", profile_file,
                 "Profile of the robot (YAML): feet, posture, ...");
  AddPackagePath(&app, &packages);
  app.add_option("--save-profile", saved,
                 "Write the profile that was found to this file (YAML)");
  app.add_flag("--masses", masses, "List the mass of each link");
  app.add_flag("--json", json, "Print one JSON document");
  ParseCommandLine(argc, argv, &app);
  KeepInputs(saved, {{UserPath(file), "the robot's file"},
                     {profile_file.empty() ? "" : UserPath(profile_file),
                      "the profile that is read"}});
  try {
    const Profile profile =
        profile_file.empty() ? Profile{} : LoadProfile(UserPath(profile_file));
    Diagnosis diagnosis =
        Diagnose(UserPath(file), profile, PackageFolders(packages));
    diagnosis.next_step = NextStep(diagnosis, {file, profile_file, packages});
    std::cout << (json ? WriteJson(diagnosis) + "\n"
                       : WriteTable(diagnosis, masses));
    if (!saved.empty()) Save(diagnosis, saved);
    if (diagnosis.worst() != Severity::kReject) return 0;
    std::cerr << "doctor: " << Message(file, diagnosis.findings[0]) << "\n";
  } catch (const Refusal& refusal) {  // The profile is invalid.
    Diagnosis diagnosis;
    diagnosis.findings.push_back(refusal.finding());
    std::string& where = diagnosis.findings[0].where;
    where =
        "profile " + Quoted(profile_file) + (where.empty() ? "" : " ") + where;
    if (json) std::cout << WriteJson(diagnosis) << "\n";
    std::cerr << "doctor: " << refusal.what() << "\n";
  }
  return 2;
}

}  // namespace
}  // namespace poise

int main(int argc, char** argv) {
  return poise::RunTool("doctor", [=] { return poise::Main(argc, argv); });
}

// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Checks a robot file: bazel run //tools:doctor -- FILE.urdf [--json]
//     [--package-path DIR]

#include <CLI/CLI.hpp>
#include <iostream>
#include <string>
#include <vector>

#include "poise/robot/finding.h"
#include "poise/tools/commands/command_line.h"
#include "poise/tools/commands/doctor/diagnosis.h"
#include "poise/tools/commands/doctor/write_diagnosis.h"
#include "poise/tools/commands/package_path.h"
#include "poise/tools/commands/user_path.h"

namespace poise {
namespace {

int Main(int argc, char** argv) {
  CLI::App app(
      "Checks a robot file for everything that would make the controller fail "
      "or compute wrong values.",
      "doctor");
  std::string file;
  std::string profile_file;
  std::vector<std::string> packages;
  bool json = false;
  app.add_option("file", file, "The robot, a URDF file")->required();
  app.add_option("--profile", profile_file,
                 "Profile of the robot (YAML): feet, posture, ...");
  AddPackagePath(&app, &packages);
  app.add_flag("--json", json, "Print one JSON document");
  ParseCommandLine(argc, argv, &app);
  try {
    const Profile profile =
        profile_file.empty() ? Profile{} : LoadProfile(UserPath(profile_file));
    const Diagnosis diagnosis =
        Diagnose(UserPath(file), profile, PackageFolders(packages));
    std::cout << (json ? WriteJson(diagnosis) + "\n" : WriteTable(diagnosis));
    if (diagnosis.worst() != Severity::kReject) return 0;
    std::cerr << Message(file, diagnosis.findings[0]) << "\n";
  } catch (const Refusal& refusal) {  // The profile is invalid.
    Diagnosis diagnosis;
    diagnosis.findings.push_back(refusal.finding());
    std::string& where = diagnosis.findings[0].where;
    where =
        "profile " + Quoted(profile_file) + (where.empty() ? "" : " ") + where;
    if (json) std::cout << WriteJson(diagnosis) << "\n";
    std::cerr << refusal.what() << "\n";
  }
  return 2;
}

}  // namespace
}  // namespace poise

int main(int argc, char** argv) {
  return poise::RunTool("doctor", [=] { return poise::Main(argc, argv); });
}

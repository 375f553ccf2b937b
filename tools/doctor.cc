// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Checks a robot file: bazel run //tools:doctor -- FILE.urdf [--json]

#include <CLI/CLI.hpp>
#include <iostream>
#include <stdexcept>
#include <string>

#include "robot/finding.h"
#include "tools/diagnosis.h"
#include "tools/user_path.h"

namespace poise {
namespace {

int Main(int argc, char** argv) {
  CLI::App app("Checks a robot file: all that would make control fail or lie.",
               "doctor");
  std::string file;
  std::string profile_file;
  bool json = false;
  app.add_option("file", file, "A URDF")->required();
  app.add_option("--profile", profile_file, "Its profile: feet, posture, ...");
  app.add_flag("--json", json, "Print one JSON document");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    std::cerr << "doctor: " << error.what() << "\n";
    return 2;
  }
  try {
    const Profile profile =
        profile_file.empty() ? Profile{} : LoadProfile(UserPath(profile_file));
    const Diagnosis diagnosis = Diagnose(UserPath(file), profile);
    std::cout << (json ? WriteJson(diagnosis) + "\n" : WriteTable(diagnosis));
    if (diagnosis.worst() != Severity::kReject) return 0;
    std::cerr << Message(file, diagnosis.findings[0]) << "\n";
  } catch (const Refusal& refusal) {  // About the profile.
    Diagnosis diagnosis;
    diagnosis.findings.push_back(refusal.finding());
    if (json) std::cout << WriteJson(diagnosis) << "\n";
    std::cerr << refusal.what() << "\n";
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
  }
  return 2;
}

}  // namespace
}  // namespace poise

int main(int argc, char** argv) { return poise::Main(argc, argv); }

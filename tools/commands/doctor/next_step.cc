// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/doctor/next_step.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "poise/robot/finding.h"

namespace poise {
namespace {

// Returns a word of a shell command, in quotes if it needs them.
std::string Word(const std::string& text) {
  const bool is_plain = std::all_of(text.begin(), text.end(), [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) ||
           std::string("_./-+").find(c) != std::string::npos;
  });
  if (is_plain && !text.empty()) return text;
  std::string word = "'";
  for (const char c : OneLine(text)) {
    word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  }
  return word + "'";
}

std::string Packages(const Arguments& arguments) {
  std::string text;
  for (const std::string& folder : arguments.packages) {
    text += " --package-path " + Word(folder);
  }
  return text;
}

bool IsGuess(const Diagnosis::Sole& sole) { return sole.from == "guess"; }

std::string List(const Eigen::Vector3d& p) {
  return "[" + PrintNumber(p.x()) + ", " + PrintNumber(p.y()) + ", " +
         PrintNumber(p.z()) + "]";
}

std::string SoleLine(const Diagnosis::Sole& sole) {
  return "  " + sole.name + ": {frame: " + OneLine(sole.link) +
         ", xyz: " + List(sole.xyz) + ", rpy: " + List(sole.rpy) + ", size: [" +
         PrintNumber(sole.length) + ", " + PrintNumber(sole.width) + "]}";
}

}  // namespace

std::string NextStep(const Diagnosis& diagnosis, const Arguments& arguments) {
  const std::string file = Word(arguments.file);
  const std::string doctor = "bazel run //tools:doctor -- " + file;
  if (diagnosis.worst() == Severity::kReject) {
    if (diagnosis.is_xacro) {
      std::filesystem::path urdf = arguments.file;
      if (urdf.extension() == ".xacro") urdf.replace_extension();
      if (urdf.extension() != ".urdf") urdf += ".urdf";
      const std::string expanded =
          urdf == arguments.file ? "expanded.urdf" : urdf.string();
      return "xacro " + file + " > " + Word(expanded) +
             " && bazel run //tools:doctor -- " + Word(expanded);
    }
    const std::string reason =
        diagnosis.findings[0].what + " " + diagnosis.findings[0].why;
    const auto has = [&](const char* text) {
      return reason.find(text) != std::string::npos;
    };
    if (has("must be URDF")) {
      return "export the robot as URDF, then bazel run //tools:doctor -- "
             "ROBOT.urdf";
    }
    if (has("loop")) {
      return "remove one joint of the loop, or give it <mimic>, then " + doctor;
    }
    return "correct the reason above, then " + doctor;
  }
  const std::string rest = Packages(arguments);
  const std::string profile =
      arguments.profile.empty() ? "" : " --profile " + Word(arguments.profile);
  const std::string mine =
      Word(std::filesystem::path(arguments.file).stem().string() + ".yaml");
  const bool has_guess =
      std::any_of(diagnosis.soles.begin(), diagnosis.soles.end(), IsGuess);
  if (diagnosis.has_many_legs) {
    return "choose a robot with two legs, then bazel run //tools:doctor -- "
           "ROBOT.urdf";
  }
  if (!diagnosis.was_tested && diagnosis.soles.empty()) {
    return "lock joints in a profile (locked: {JOINT: 0}), then " + doctor +
           " --profile " + mine + rest;
  }
  if (!diagnosis.stands && !diagnosis.remedy.empty()) {
    return "correct " + diagnosis.remedy + ", then " + doctor + profile + rest;
  }
  if (diagnosis.soles.empty() && diagnosis.guessed_feet.size() < 2) {
    return "choose a robot with two legs, or compute its dynamics alone: bazel "
           "run //tools:dynamics -- --urdf " +
           file + " --states STATES.json";
  }
  if (diagnosis.soles.empty()) {
    return "write the feet into " + mine + ", then " + doctor + " --profile " +
           mine + rest;
  }
  if (has_guess && !arguments.profile.empty()) {
    return "measure the soles, correct them in " + Word(arguments.profile) +
           ", remove `from: guess`, then " + doctor + profile + rest;
  }
  if (has_guess) {
    return doctor + profile + rest + " --save-profile " + mine +
           ", measure the soles, correct them in " + mine + ", then " + doctor +
           " --profile " + mine + rest;
  }
  if (!diagnosis.stands && diagnosis.was_tested) {
    return "correct the file or its profile, then " + doctor + profile + rest;
  }
  return "bazel run //tools:push -- --scenario stand --robot " + file +
         profile + rest;
}

std::vector<std::string> ProfileStub(const Diagnosis& diagnosis) {
  if (diagnosis.worst() == Severity::kReject) return {};
  if (!diagnosis.remedy.empty() && diagnosis.soles.empty()) return {};
  std::vector<std::string> lines = {"feet:"};
  for (const Diagnosis::Sole& sole : diagnosis.soles) {
    if (IsGuess(sole)) lines.push_back(SoleLine(sole));
  }
  if (diagnosis.soles.empty()) {
    for (const Diagnosis::Sole& sole : diagnosis.guessed_feet) {
      lines.push_back(SoleLine(sole));
    }
  }
  // A profile has both feet or none.
  if (lines.size() == 2 && diagnosis.soles.size() == 2) {
    lines.resize(1);
    for (const auto& sole : diagnosis.soles) lines.push_back(SoleLine(sole));
  }
  if (lines.size() < 3) return {};
  return lines;
}

}  // namespace poise

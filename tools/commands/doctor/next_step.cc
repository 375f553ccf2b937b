// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/doctor/next_step.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cctype>
#include <cmath>
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

// Returns a command with a comment of the shell, so that the line can be pasted.
std::string WithComment(const std::string& command,
                        const std::string& comment) {
  return command + "  # " + comment;
}

// Returns lengths or angles without the digits below a micrometer, which are
// rounding errors.
std::string List(const Eigen::Vector3d& p) {
  constexpr double kDigits = 1e6;
  std::string list;
  for (const double each : p) {
    // The sum with 0 makes a positive zero of a negative one.
    list += (list.empty() ? "[" : ", ") +
            PrintNumber(std::round(each * kDigits) / kDigits + 0.0);
  }
  return list + "]";
}

// Returns a text as a scalar inside a flow of YAML, in quotes if it needs them.
std::string Scalar(const std::string& text) {
  YAML::Emitter emitter;
  emitter << YAML::Flow << YAML::BeginSeq << OneLine(text) << YAML::EndSeq;
  const std::string list = emitter.c_str();
  return list.substr(1, list.size() - 2);
}

std::string SoleLine(const Diagnosis::Sole& sole) {
  return "  " + sole.name + ": {frame: " + Scalar(sole.link) +
         ", xyz: " + List(sole.xyz) + ", rpy: " + List(sole.rpy) + ", size: [" +
         PrintNumber(sole.length) + ", " + PrintNumber(sole.width) + "]" +
         (IsGuess(sole) ? ", from: guess}" : "}");
}

}  // namespace

std::string NextStep(const Diagnosis& diagnosis, const Arguments& arguments) {
  const std::string file = Word(arguments.file);
  const std::string doctor = "bazel run //tools:doctor -- " + file;
  const std::string rest = Packages(arguments);
  const std::string profile =
      arguments.profile.empty() ? "" : " --profile " + Word(arguments.profile);
  const std::string again = doctor + profile + rest;
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
      return WithComment("bazel run //tools:doctor -- ROBOT.urdf",
                         "after you have exported the robot as URDF");
    }
    if (has("loop")) {
      return WithComment(again,
                         "after you have removed one joint of the loop, or "
                         "given it <mimic>");
    }
    return WithComment(again, "after you have corrected the reason above");
  }
  const std::string mine =
      Word(std::filesystem::path(arguments.file).stem().string() + ".yaml");
  const std::string with_mine = doctor + " --profile " + mine + rest;
  const bool has_guess =
      std::any_of(diagnosis.soles.begin(), diagnosis.soles.end(), IsGuess);
  if (diagnosis.has_many_legs) {
    return WithComment("bazel run //tools:doctor -- ROBOT.urdf",
                       "with a robot that has two legs");
  }
  if (!diagnosis.was_tested && diagnosis.soles.empty()) {
    return WithComment(with_mine, "after you have locked joints in " + mine +
                                      " (locked: {JOINT: 0})");
  }
  if (!diagnosis.remedy.empty()) {
    return WithComment(again, "after you have corrected " + diagnosis.remedy);
  }
  if (diagnosis.soles.empty() && diagnosis.guessed_feet.size() < 2) {
    return WithComment("bazel run //tools:dynamics -- --urdf " + file +
                           " --states STATES.json",
                       "the dynamics alone: balance needs two legs");
  }
  if (diagnosis.soles.empty()) {
    return WithComment(with_mine,
                       "after you have written the feet into " + mine);
  }
  if (has_guess && !arguments.profile.empty()) {
    return WithComment(
        again, "after you have measured the soles, corrected them in " +
                   Word(arguments.profile) + ", and removed `from: guess`");
  }
  if (has_guess) {
    return WithComment(again + " --save-profile " + mine,
                       "then measure the soles and correct them in " + mine);
  }
  if (!diagnosis.stands && diagnosis.was_tested) {
    return WithComment(again,
                       "after you have corrected the file or its profile");
  }
  return "bazel run //tools:push -- --scenario stand --robot " + file +
         profile + rest;
}

std::vector<std::string> ProfileStub(const Diagnosis& diagnosis) {
  if (diagnosis.worst() == Severity::kReject) return {};
  if (!diagnosis.remedy.empty() && diagnosis.soles.empty()) return {};
  std::vector<std::string> lines = {"feet:  # for a profile"};
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

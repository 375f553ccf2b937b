// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/doctor/next_step.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>

#include "poise/robot/finding.h"
#include "poise/tools/commands/shell_word.h"

namespace poise {
namespace {

// Returns a string literal of Python.
std::string PythonText(const std::string& text) {
  std::string literal = "'";
  for (const char c : OneLine(text)) {
    if (c == '\'' || c == '\\') literal += '\\';
    literal += c;
  }
  return literal + "'";
}

// Writes the commands of the shell, or the calls of Python that do the same.
class Commands {
 public:
  explicit Commands(const Arguments& arguments) : arguments_(arguments) {}

  std::string Name(const std::string& file) const {
    return is_python() ? PythonText(file) : ShellWord(file);
  }
  std::string Doctor(const std::string& file) const {
    return is_python() ? "poise.doctor(" + Name(file) + ")"
                       : "bazel run //tools:doctor -- " + Name(file);
  }
  // With the folders of packages, and a profile if there is one.
  std::string DoctorAgain(const std::string& profile) const {
    return is_python() ? "poise.doctor(" + PythonInputs(profile) + ")"
                       : Doctor(arguments_.file) + ShellInputs(profile);
  }
  std::string SaveProfile(const std::string& profile) const {
    return is_python() ? "open(" + Name(profile) + ", 'w').write(" +
                             DoctorAgain(arguments_.profile) + ".profile)"
                       : DoctorAgain(arguments_.profile) + " --save-profile " +
                             Name(profile);
  }
  std::string ExpandXacro(const std::string& to) const {
    return "xacro " + ShellWord(arguments_.file) + " > " + ShellWord(to);
  }
  std::string Dynamics() const {
    return is_python() ? "poise.Tree.load(" + Name(arguments_.file) + ")"
                       : "bazel run //tools:dynamics -- --urdf " +
                             Name(arguments_.file) + " --states STATES.json";
  }
  std::string Stand() const {
    const std::string& profile = arguments_.profile;
    return is_python() ? "poise.run('stand', poise.Robot.load(" +
                             PythonInputs(profile) + "))"
                       : "bazel run //tools:push -- --scenario stand --robot " +
                             Name(arguments_.file) + ShellInputs(profile);
  }
  bool is_python() const { return arguments_.caller == Caller::kPython; }

 private:
  std::string ShellInputs(const std::string& profile) const {
    std::string text = profile.empty() ? "" : " --profile " + Name(profile);
    for (const std::string& folder : arguments_.packages) {
      text += " --package-path " + Name(folder);
    }
    return text;
  }
  std::string PythonInputs(const std::string& profile) const {
    std::string text = Name(arguments_.file);
    if (!profile.empty()) text += ", profile=" + Name(profile);
    if (arguments_.packages.empty()) return text;
    text += ", packages=[";
    for (const std::string& folder : arguments_.packages) {
      text += (text.back() == '[' ? "" : ", ") + Name(folder);
    }
    return text + "]";
  }

  const Arguments& arguments_;
};

bool IsGuess(const Diagnosis::Sole& sole) { return sole.from == "guess"; }

// Returns a command with a comment, so that the line can be pasted.
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

// Returns what to do with a file that was rejected.
std::string AfterRejection(const Diagnosis& diagnosis,
                           const Arguments& arguments) {
  const Commands commands(arguments);
  if (diagnosis.is_xacro) {
    std::filesystem::path urdf = arguments.file;
    if (urdf.extension() == ".xacro") urdf.replace_extension();
    if (urdf.extension() != ".urdf") urdf += ".urdf";
    const std::string expanded =
        urdf == arguments.file ? "expanded.urdf" : urdf.string();
    const std::string expand = commands.ExpandXacro(expanded);
    const std::string doctor = commands.Doctor(expanded);
    return commands.is_python()
               ? WithComment(doctor, "after this command in a shell: " + expand)
               : expand + " && " + doctor;
  }
  const std::string reason =
      diagnosis.findings[0].what + " " + diagnosis.findings[0].why;
  const auto has = [&](const char* text) {
    return reason.find(text) != std::string::npos;
  };
  if (has("must be URDF")) {
    return WithComment(commands.Doctor("ROBOT.urdf"),
                       "after you have exported the robot as URDF");
  }
  if (has("cannot be read") || has("is not a regular file")) {
    return WithComment(commands.Doctor("ROBOT.urdf"),
                       "with a URDF file that can be read");
  }
  return WithComment(commands.DoctorAgain(arguments.profile),
                     has("loop")
                         ? "after you have removed one joint of the loop, or "
                           "given it <mimic>"
                         : "after you have corrected the reason above");
}

}  // namespace

std::string NextStep(const Diagnosis& diagnosis, const Arguments& arguments) {
  if (diagnosis.worst() == Severity::kReject) {
    return AfterRejection(diagnosis, arguments);
  }
  const Commands commands(arguments);
  const std::string again = commands.DoctorAgain(arguments.profile);
  const std::string mine =
      std::filesystem::path(arguments.file).stem().string() + ".yaml";
  const std::string with_mine = commands.DoctorAgain(mine);
  const bool has_guess =
      std::any_of(diagnosis.soles.begin(), diagnosis.soles.end(), IsGuess);
  if (diagnosis.has_many_legs) {
    return WithComment(commands.Doctor("ROBOT.urdf"),
                       "with a robot that has two legs");
  }
  if (!diagnosis.was_tested && diagnosis.soles.empty()) {
    return WithComment(with_mine, "after you have locked joints in " +
                                      commands.Name(mine) +
                                      " (locked: {JOINT: 0})");
  }
  if (!diagnosis.remedy.empty()) {
    return WithComment(again, "after you have corrected " + diagnosis.remedy);
  }
  if (diagnosis.soles.empty() && diagnosis.guessed_feet.size() < 2) {
    return WithComment(commands.Dynamics(),
                       "the dynamics alone: balance needs two legs");
  }
  if (diagnosis.soles.empty()) {
    return WithComment(with_mine, "after you have written the feet into " +
                                      commands.Name(mine));
  }
  if (has_guess && !arguments.profile.empty()) {
    return WithComment(again,
                       "after you have measured the soles, corrected them in " +
                           commands.Name(arguments.profile) +
                           ", and removed `from: guess`");
  }
  if (has_guess) {
    return WithComment(
        commands.SaveProfile(mine),
        "then measure the soles and correct them in " + commands.Name(mine));
  }
  if (!diagnosis.stands && diagnosis.was_tested) {
    return WithComment(again,
                       "after you have corrected the file or its profile");
  }
  return commands.Stand();
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

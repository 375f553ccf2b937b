// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include <pybind11/stl.h>

#include <optional>
#include <string>

#include "poise/python/arguments.h"
#include "poise/python/arrays.h"
#include "poise/python/bind.h"
#include "poise/python/python_robot.h"
#include "poise/python/text.h"
#include "poise/robot/finding.h"
#include "poise/tools/commands/doctor/diagnose.h"
#include "poise/tools/commands/doctor/diagnosis.h"
#include "poise/tools/commands/doctor/next_step.h"
#include "poise/tools/commands/doctor/write_diagnosis.h"

namespace poise {
namespace {

const char* SeverityName(const Finding& finding) {
  switch (finding.severity) {
    case Severity::kNote:
      return "note";
    case Severity::kWarn:
      return "warn";
    case Severity::kReject:
      return "reject";
  }
  return "";
}

Diagnosis DiagnoseFiles(const std::string& urdf, const std::string& profile,
                        const std::vector<std::string>& packages) {
  const py::gil_scoped_release release;
  Diagnosis diagnosis =
      Diagnose(urdf, profile.empty() ? Profile{} : LoadProfile(profile),
               {packages.begin(), packages.end()});
  diagnosis.next_step =
      NextStep(diagnosis, {urdf, profile, packages, Caller::kPython});
  return diagnosis;
}

Diagnosis Doctor(py::handle urdf, py::handle profile, py::handle packages) {
  return DiagnoseFiles(AsText(urdf, "urdf"),
                       profile.is_none() ? "" : AsText(profile, "profile"),
                       AsTexts(packages, "packages"));
}

void BindFinding(py::module_* module) {
  py::class_<Finding> finding(*module, "Finding",
                              "A finding about a robot file.");
  finding.def_property_readonly("severity", SeverityName,
                                "'note', 'warn' or 'reject'.");
  finding.def_readonly("where", &Finding::where, "The element of the file.");
  finding.def_readonly("what", &Finding::what, "The observation.");
  finding.def_readonly("why", &Finding::why, "The rule or the consequence.");
  finding.def_readonly("line", &Finding::line,
                       "The line in the file, or 0 if unknown.");
  finding.def("__repr__", [](const Finding& self) {
    const std::string text = self.where + ": " + self.what + ", " + self.why;
    return "<poise.Finding, " + std::string(SeverityName(self)) + ": " +
           Repr(text) + ">";
  });
}

void BindSole(py::module_* module) {
  using Sole = Diagnosis::Sole;
  py::class_<Sole> sole(*module, "Sole", "A sole that was found.");
  sole.def_readonly("name", &Sole::name, "'left_foot' or 'right_foot'.");
  sole.def_readonly("link", &Sole::link, "The link that carries the sole.");
  sole.def_readonly("length", &Sole::length, "The size along x, m.");
  sole.def_readonly("width", &Sole::width, "The size along y, m.");
  sole.def_readonly("depth", &Sole::depth,
                    "The height of the link's origin above the sole, m.");
  sole.def_readonly("source", &Sole::from,
                    "'box', 'mesh', 'guess' or 'profile'.");
  sole.def_property_readonly(
      "xyz", [](const Sole& self) { return ToArray(self.xyz); },
      "(3,) The sole's middle in the link, m.");
  sole.def_property_readonly(
      "rpy", [](const Sole& self) { return ToArray(self.rpy); },
      "(3,) Its roll, pitch and yaw in the link, rad.");
  sole.def("__repr__", [](const Sole& self) {
    return "<poise.Sole " + Repr(self.name) + ", " + PrintNumber(self.length) +
           " m long, " + PrintNumber(self.width) + " m wide, from " +
           self.from + ">";
  });
}

std::optional<bool> Stands(const Diagnosis& self) {
  return self.was_tested ? std::optional(self.stands) : std::nullopt;
}

}  // namespace

void AddDoctor(RobotClass* robot) {
  robot->def(
      "doctor",
      [](const PythonRobot& self) {
        return DiagnoseFiles(self.urdf, self.profile_file, self.packages);
      },
      "Examines the files of this robot and simulates whether it stands. "
      "Returns a Diagnosis. Takes up to 10 s; other threads run meanwhile.");
}

void BindDiagnosis(py::module_* module) {
  BindFinding(module);
  BindSole(module);
  py::class_<Diagnosis> diagnosis(
      *module, "Diagnosis",
      "The result of doctor(): everything in a robot file that would make the "
      "controller fail or compute wrong values. str() is a text for people.");
  diagnosis.def_property_readonly("verdict", VerdictWord,
                                  "'ok', 'warn' or 'reject'.");
  diagnosis.def_property_readonly(
      "stands", Stands, "Whether the robot stands; None if it is not known.");
  diagnosis.def_readonly("reason", &Diagnosis::reason,
                         "Why the robot does not stand, or was not tested.");
  // Copies: a reference into a vector would not outlive a change of it.
  diagnosis.def_property_readonly(
      "findings", [](const Diagnosis& self) { return self.findings; },
      "The Findings, the most severe first.");
  diagnosis.def_property_readonly(
      "soles", [](const Diagnosis& self) { return self.soles; },
      "The Soles, the left one first.");
  diagnosis.def_readonly("forward", &Diagnosis::forward,
                         "The axis of the root link that points forward: "
                         "'+x', '-x', '+y', '-y' or ''.");
  diagnosis.def_readonly("next_step", &Diagnosis::next_step,
                         "What to do next, one line.");
  diagnosis.def_readonly("profile", &Diagnosis::profile,
                         "The profile that was found, as YAML.");
  diagnosis.def_readonly("mass", &Diagnosis::mass,
                         "The mass of all links, kg.");
  diagnosis.def("__repr__", [](const Diagnosis& self) {
    return "<poise.Diagnosis, " + std::string(VerdictWord(self)) + ", " +
           Count(static_cast<std::ptrdiff_t>(self.findings.size()), "finding") +
           ">";
  });
  diagnosis.def("__str__",
                [](const Diagnosis& self) { return WriteTable(self); });
  module->def("doctor", Doctor, py::arg("urdf"),
              py::arg("profile") = py::none(),
              py::arg("packages") = py::tuple(),
              "Examines any robot file, and simulates whether the robot "
              "stands. Errors in the file become findings. Returns a "
              "Diagnosis. Takes up to 10 s; other threads run meanwhile.");
}

}  // namespace poise

// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/doctor/write_diagnosis.h"

#include <iomanip>
#include <nlohmann/json.hpp>
#include <sstream>

namespace poise {
namespace {

constexpr size_t kMostFindings = 1000;

nlohmann::json WriteMasses(const std::vector<Diagnosis::Mass>& masses) {
  nlohmann::json json = nlohmann::json::array();
  for (const auto& [link, mass] : masses) {
    json.push_back({{"link", link}, {"mass", mass}});
  }
  return json;
}

const char* Name(Severity severity) {
  switch (severity) {
    case Severity::kReject:
      return "reject";
    case Severity::kWarn:
      return "warn";
    default:
      return "note";
  }
}

}  // namespace

std::string VerdictWord(const Diagnosis& diagnosis) {
  const Severity worst = diagnosis.worst();
  return worst == Severity::kNote ? "ok" : Name(worst);
}

std::string WriteTable(const Diagnosis& diagnosis) {
  std::ostringstream out;
  out << std::setprecision(4);
  if (diagnosis.worst() != Severity::kReject) {
    out << "robot    " << Quoted(diagnosis.robot) << ", root "
        << Quoted(diagnosis.root) << ", " << diagnosis.links.size()
        << " links, " << diagnosis.joints << " moving joints\nmass     "
        << diagnosis.mass << " kg\n";
    size_t shown = 0;
    for (const Diagnosis::Mass& link : diagnosis.links) {
      if (++shown > kMostFindings) {
        out << "          ... and " << diagnosis.links.size() - kMostFindings
            << " more\n";
        break;
      }
      out << "         " << std::setw(9) << link.mass << "  "
          << Quoted(link.link) << "\n";
    }
    for (const Diagnosis::Sole& sole : diagnosis.soles) {
      out << "sole     " << sole.name << ": " << sole.length << " x "
          << sole.width << " m on " << Quoted(sole.link) << "\n";
    }
    if (diagnosis.com_height) {
      out << "stands   with its center of mass at a height of "
          << *diagnosis.com_height << " m\n";
    }
    if (diagnosis.parity) {
      out << "parity   largest relative difference to the Bullet plant: "
          << *diagnosis.parity << "\n";
    }
  }
  size_t shown = 0;
  for (const Finding& finding : diagnosis.findings) {
    if (++shown > kMostFindings) {
      out << "... and " << diagnosis.findings.size() - kMostFindings
          << " more\n";
      break;
    }
    out << std::left << std::setw(9) << Name(finding.severity);
    if (finding.line > 0) out << "line " << finding.line << ": ";
    if (!finding.where.empty()) out << finding.where << ": ";
    out << finding.what;
    if (!finding.why.empty()) out << ", " << finding.why;
    out << "\n";
  }
  out << "verdict  " << VerdictWord(diagnosis) << "\n";
  return out.str();
}

std::string WriteJson(const Diagnosis& diagnosis) {
  nlohmann::json json;
  json["verdict"] = VerdictWord(diagnosis);
  json["findings"] = nlohmann::json::array();
  for (const Finding& finding : diagnosis.findings) {
    if (json["findings"].size() >= kMostFindings) break;
    json["findings"].push_back({{"severity", Name(finding.severity)},
                                {"where", finding.where},
                                {"what", finding.what},
                                {"why", finding.why},
                                {"line", finding.line}});
  }
  if (diagnosis.findings.size() > kMostFindings) {
    json["findings_left_out"] = diagnosis.findings.size() - kMostFindings;
  }
  nlohmann::json robot;
  robot["name"] = diagnosis.robot;
  robot["root_link"] = diagnosis.root;
  robot["links"] = diagnosis.links.size();
  robot["joints"] = diagnosis.joints;
  robot["total_mass"] = diagnosis.mass;
  robot["bodies"] = WriteMasses(diagnosis.bodies);
  robot["link_masses"] = WriteMasses(diagnosis.links);
  robot["soles"] = nlohmann::json::array();
  for (const Diagnosis::Sole& sole : diagnosis.soles) {
    robot["soles"].push_back({{"name", sole.name},
                              {"link", sole.link},
                              {"length", sole.length},
                              {"width", sole.width}});
  }
  robot["stands"] = diagnosis.com_height.has_value();
  if (diagnosis.com_height) robot["com_height"] = *diagnosis.com_height;
  if (diagnosis.parity) robot["bullet_parity"] = *diagnosis.parity;
  json["robot"] = robot;
  // Names of the robot file may be invalid UTF-8, but JSON must be valid.
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace poise

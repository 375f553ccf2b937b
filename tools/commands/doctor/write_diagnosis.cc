// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/doctor/write_diagnosis.h"

#include <algorithm>
#include <iomanip>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

#include "poise/tools/commands/doctor/next_step.h"

namespace poise {
namespace {

constexpr size_t kMostFindings = 1000;
constexpr size_t kMostPlaces = 3;

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

// Findings of one kind: with the same severity and reason.
using Kind = std::vector<const Finding*>;

std::vector<Kind> Kinds(const std::vector<Finding>& findings) {
  std::vector<Kind> kinds;
  std::map<std::pair<Severity, std::string>, size_t> index;
  for (const Finding& finding : findings) {
    const auto [at, is_new] = index.emplace(
        std::make_pair(finding.severity, finding.why), kinds.size());
    if (is_new || finding.why.empty()) {
      kinds.push_back({&finding});
    } else {
      kinds[at->second].push_back(&finding);
    }
  }
  return kinds;
}

// Returns the first finding of a kind, and the places of the next ones.
std::string Line(const Kind& kind) {
  const Finding& first = *kind[0];
  std::string line;
  if (first.line > 0) line += "line " + std::to_string(first.line) + ": ";
  if (!first.where.empty()) line += first.where + ": ";
  line += first.what;
  if (!first.why.empty()) line += ", " + first.why;
  for (size_t i = 1; i < std::min(kind.size(), 1 + kMostPlaces); ++i) {
    line += (i == 1 ? "; also " : ", ") + kind[i]->where;
  }
  if (kind.size() > 1 + kMostPlaces) {
    line += " and " + std::to_string(kind.size() - 1 - kMostPlaces) + " more";
  }
  return line;
}

// Cuts a text after kWidest bytes, between two characters.
std::string Shorten(std::string text) {
  constexpr size_t kWidest = 160;
  if (text.size() <= kWidest) return text;
  size_t end = kWidest;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) {
    --end;
  }
  return text.substr(0, end) + " ...";
}

// Writes the verdict and what follows from it, in at most ten lines.
void WriteSummary(const Diagnosis& diagnosis, std::ostringstream* out) {
  const bool is_rejected = diagnosis.worst() == Severity::kReject;
  *out << "verdict  " << VerdictWord(diagnosis) << "\n";
  *out << "stands   ";
  if (is_rejected) {
    *out << "unknown: the file cannot be used\n";
  } else if (!diagnosis.was_tested) {
    *out << "unknown: " << Shorten(diagnosis.reason) << "\n";
  } else if (diagnosis.stands) {
    *out << "yes, with its center of mass at a height of "
         << *diagnosis.com_height << " m\n";
  } else {
    *out << "no: " << Shorten(diagnosis.reason) << "\n";
  }
  for (const Diagnosis::Sole& sole : diagnosis.soles) {
    *out << "sole     " << sole.name << ": " << sole.length << " x "
         << sole.width << " m on " << Quoted(sole.link) << ", "
         << (sole.from == "guess" ? "a guess: measure it" : "from " + sole.from)
         << "\n";
  }
  if (diagnosis.soles.size() == 2) {
    *out << "forward  "
         << (diagnosis.forward.empty() ? "no axis" : diagnosis.forward)
         << " of " << Quoted(diagnosis.root) << ", left foot "
         << Quoted(diagnosis.soles[0].link) << ", right foot "
         << Quoted(diagnosis.soles[1].link) << "\n";
  }
  const std::vector<Kind> kinds = Kinds(diagnosis.findings);
  const auto count = std::count_if(
      diagnosis.findings.begin(), diagnosis.findings.end(),
      [](const Finding& f) { return f.severity == Severity::kWarn; });
  const auto lines = std::count_if(
      kinds.begin(), kinds.end(),
      [](const Kind& kind) { return kind[0]->severity == Severity::kWarn; });
  *out << (is_rejected ? "reason   " : "warnings ");
  if (!is_rejected) {
    *out << count;
    if (lines < count) {
      *out << " in " << lines << (lines == 1 ? " line" : " lines");
    }
    *out << (count > 0 ? ", first " : "");
  }
  if (!kinds.empty() && (is_rejected || count > 0)) {
    *out << Shorten(Line(kinds[0]));
  }
  *out << "\n";
  if (!diagnosis.next_step.empty()) {
    *out << "next     " << diagnosis.next_step << "\n";
  }
  for (const std::string& line : ProfileStub(diagnosis)) {
    *out << line << "\n";
  }
}

void WriteMassTable(const Diagnosis& diagnosis, std::ostringstream* out) {
  size_t shown = 0;
  for (const Diagnosis::Mass& link : diagnosis.links) {
    if (++shown > kMostFindings) {
      *out << "          ... and " << diagnosis.links.size() - kMostFindings
           << " more\n";
      break;
    }
    *out << "         " << std::setw(9) << link.mass << "  "
         << Quoted(link.link) << "\n";
  }
}

nlohmann::json WriteSoles(const Diagnosis& diagnosis) {
  const auto list = [](const Eigen::Vector3d& p) {
    return nlohmann::json({p.x(), p.y(), p.z()});
  };
  nlohmann::json soles = nlohmann::json::array();
  for (const Diagnosis::Sole& sole : diagnosis.soles) {
    soles.push_back({{"link", sole.link},
                     {"xyz", list(sole.xyz)},
                     {"rpy", list(sole.rpy)},
                     {"size", {sole.length, sole.width}},
                     {"depth", sole.depth},
                     {"from", sole.from}});
  }
  return soles;
}

}  // namespace

std::string VerdictWord(const Diagnosis& diagnosis) {
  const Severity worst = diagnosis.worst();
  return worst == Severity::kNote ? "ok" : Name(worst);
}

std::string WriteTable(const Diagnosis& diagnosis, bool masses) {
  std::ostringstream out;
  out << std::setprecision(4);
  WriteSummary(diagnosis, &out);
  if (diagnosis.worst() != Severity::kReject) {
    out << "\nrobot    " << Quoted(diagnosis.robot) << ", root "
        << Quoted(diagnosis.root) << ", " << diagnosis.links.size()
        << " links, " << diagnosis.joints << " moving joints\nmass     "
        << diagnosis.mass << " kg\n";
    if (masses) WriteMassTable(diagnosis, &out);
    if (diagnosis.parity) {
      out << "parity   largest relative difference to the Bullet plant: "
          << *diagnosis.parity << "\n";
    }
  }
  size_t shown = 0;
  const auto kinds = Kinds(diagnosis.findings);
  for (const auto& kind : kinds) {
    if (++shown > kMostFindings) {
      out << "... and " << kinds.size() - kMostFindings << " more\n";
      break;
    }
    out << std::left << std::setw(9) << Name(kind[0]->severity) << Line(kind)
        << "\n";
  }
  return out.str();
}

std::string WriteJson(const Diagnosis& diagnosis) {
  nlohmann::json json;
  json["verdict"] = VerdictWord(diagnosis);
  const bool has_feet = diagnosis.soles.size() == 2;
  const auto text_or_null = [](const std::string& text) {
    return text.empty() ? nlohmann::json() : nlohmann::json(text);
  };
  // The answer is null if it is unknown.
  const nlohmann::json stands = diagnosis.was_tested
                                    ? nlohmann::json(diagnosis.stands)
                                    : nlohmann::json();
  json["stands"] = stands;
  json["soles"] = WriteSoles(diagnosis);
  json["forward"] = text_or_null(diagnosis.forward);
  json["left"] = text_or_null(has_feet ? diagnosis.soles[0].link : "");
  json["right"] = text_or_null(has_feet ? diagnosis.soles[1].link : "");
  json["next_step"] = diagnosis.next_step;
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
  robot["stands"] = stands;
  if (diagnosis.com_height) robot["com_height"] = *diagnosis.com_height;
  if (diagnosis.parity) robot["bullet_parity"] = *diagnosis.parity;
  json["robot"] = robot;
  // Names of the robot file may be invalid UTF-8, but JSON must be valid.
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace poise

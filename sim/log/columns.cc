// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/log/columns.h"

#include "poise/sim/log/log_reader.h"

namespace poise {

namespace {

constexpr char kBase[] = "base.";
constexpr char kCom[] = "com.";
constexpr char kComReference[] = "com_ref.";
constexpr char kCop[] = "cop.";
constexpr char kPush[] = "push.";
constexpr char kOther[] = "other.";
constexpr char kTau[] = "tau.";
constexpr char kQ[] = "q.";
constexpr char kLambda[] = "lambda.";
constexpr char kResidual[] = "residual.";
constexpr char kGap[] = "gap.level_";
constexpr char kComVelocity[] = "com_vel.";
constexpr char kXi[] = "xi.";
constexpr char kPlan[] = "plan.";

constexpr char kContact[] = ".contact";
constexpr char kTilt[] = ".tilt";
constexpr char kSlide[] = ".slide";
constexpr char kPhase[] = ".phase";

constexpr char kAxes[] = {'x', 'y', 'z'};
constexpr const char* kTexts[] = {kTouchingColumn, kStatusColumn, kActiveColumn,
                                  kLostColumn, kConflictColumn};

std::string Position(const char* prefix, char axis) {
  return std::string(prefix) + axis + "[m]";
}

// Returns the column of a component of a moment; the prefix ends with a dot.
std::string Moment(const std::string& prefix, char axis) {
  return prefix + 'm' + axis + "[Nm]";
}

std::string Force(const std::string& prefix, char axis) {
  return prefix + 'f' + axis + "[N]";
}

bool StartsWith(std::string_view text, std::string_view start) {
  return text.substr(0, start.size()) == start;
}

bool EndsWith(std::string_view text, std::string_view end) {
  return text.size() > end.size() &&
         text.substr(text.size() - end.size()) == end;
}

// Returns whether a name ends as a wrench column: "FOOT.fx" has the part 'f'.
bool IsPartOfWrench(std::string_view name, char part) {
  for (const char axis : kAxes) {
    if (EndsWith(name, std::string{'.', part, axis})) return true;
  }
  return false;
}

bool IsText(std::string_view name) {
  for (const char* text : kTexts) {
    if (name == text) return true;
  }
  return name == kReasonColumn;
}

ColumnGroup GroupOfFoot(std::string_view name) {
  if (EndsWith(name, kContact)) return ColumnGroup::kContact;
  if (EndsWith(name, kTilt) || EndsWith(name, kSlide)) {
    return ColumnGroup::kTiltOrSlide;
  }
  if (EndsWith(name, kPhase)) return ColumnGroup::kText;
  for (const char axis : kAxes) {
    if (EndsWith(name, std::string{'.', axis})) {
      return ColumnGroup::kFootPosition;
    }
  }
  if (IsPartOfWrench(name, 'm')) return ColumnGroup::kMoment;
  if (IsPartOfWrench(name, 'f')) return ColumnGroup::kForce;
  return ColumnGroup::kUnknown;
}

}  // namespace

std::string BasePositionColumn(char axis) { return Position(kBase, axis); }

std::string BaseQuaternionColumn(char part) {
  return std::string(kBase) + 'q' + part;
}

std::string ComColumn(char axis) { return Position(kCom, axis); }

std::string ComReferenceColumn(char axis) {
  return Position(kComReference, axis);
}

std::string ComVelocityColumn(char axis) {
  return std::string(kComVelocity) + axis + "[m/s]";
}

std::string XiColumn(char axis) { return Position(kXi, axis); }

std::string PlanColumn(char axis) { return Position(kPlan, axis); }

std::string CopColumn(char axis) { return Position(kCop, axis); }

std::string PushColumn(char axis) { return Force(kPush, axis); }

std::string OtherForceColumn(char axis) { return Force(kOther, axis); }

std::string ContactColumn(const std::string& foot) { return foot + kContact; }

std::string TiltColumn(const std::string& foot) {
  return foot + kTilt + "[rad]";
}

std::string SlideColumn(const std::string& foot) {
  return foot + kSlide + "[m]";
}

std::string PhaseColumn(const std::string& foot) { return foot + kPhase; }

std::string FootPositionColumn(const std::string& foot, char axis) {
  return Position((foot + '.').c_str(), axis);
}

std::string MomentColumn(const std::string& foot, char axis) {
  return Moment(foot + '.', axis);
}

std::string ForceColumn(const std::string& foot, char axis) {
  return Force(foot + '.', axis);
}

std::string CommandedMomentColumn(const std::string& foot, char axis) {
  return kLambda + MomentColumn(foot, axis);
}

std::string CommandedForceColumn(const std::string& foot, char axis) {
  return kLambda + ForceColumn(foot, axis);
}

std::string TorqueColumn(const std::string& joint) {
  return kTau + joint + "[Nm]";
}

std::string PositionColumn(const std::string& joint) {
  return kQ + joint + "[rad]";
}

std::string ResidualColumn(const std::string& task) { return kResidual + task; }

std::string GapColumn(int level) { return kGap + std::to_string(level); }

std::vector<LogColumn> LogColumns(const std::vector<std::string>& feet,
                                  const std::vector<std::string>& joints,
                                  const std::vector<std::string>& tasks,
                                  int num_levels) {
  using Kind = LogColumn::Kind;
  std::vector<LogColumn> columns = {{kTimeColumn, Kind::kTime}};
  const auto number = [&columns](std::string name) {
    columns.push_back({std::move(name), Kind::kNumber});
  };
  const auto text = [&columns](std::string name) {
    columns.push_back({std::move(name), Kind::kText});
  };
  for (const char axis : kAxes) number(BasePositionColumn(axis));
  for (const char part : {'x', 'y', 'z', 'w'}) {
    number(BaseQuaternionColumn(part));
  }
  number(kBaseTiltColumn);
  for (const char axis : kAxes) number(ComColumn(axis));
  for (const char axis : kAxes) number(ComReferenceColumn(axis));
  for (const char axis : {'x', 'y'}) number(CopColumn(axis));
  for (const std::string& foot : feet) {
    number(ContactColumn(foot));
    number(TiltColumn(foot));
    number(SlideColumn(foot));
    for (const char axis : kAxes) number(MomentColumn(foot, axis));
    for (const char axis : kAxes) number(ForceColumn(foot, axis));
  }
  for (const char axis : kAxes) number(PushColumn(axis));
  for (const char axis : kAxes) number(OtherForceColumn(axis));
  number(kSelfContactsColumn);
  for (const std::string& joint : joints) number(TorqueColumn(joint));
  for (const std::string& joint : joints) number(PositionColumn(joint));
  for (const std::string& foot : feet) {
    for (const char axis : kAxes) number(CommandedMomentColumn(foot, axis));
    for (const char axis : kAxes) number(CommandedForceColumn(foot, axis));
  }
  for (const std::string& task : tasks) number(ResidualColumn(task));
  for (const char axis : kAxes) number(ComVelocityColumn(axis));
  for (const char axis : {'x', 'y'}) number(XiColumn(axis));
  for (const std::string& foot : feet) {
    for (const char axis : kAxes) number(FootPositionColumn(foot, axis));
  }
  for (const char axis : {'x', 'y'}) number(PlanColumn(axis));
  number(kPlanTimeColumn);
  number(kPlanBeyondColumn);
  for (int i = 1; i <= num_levels; ++i) number(GapColumn(i));
  for (const char* name : kTexts) text(name);
  for (const std::string& foot : feet) text(PhaseColumn(foot));
  text(kReasonColumn);
  return columns;
}

std::string LogName(std::string name) {
  constexpr std::string_view kSeparators = ",;=|\n\r";
  for (char& c : name) {
    if (kSeparators.find(c) != std::string_view::npos) c = '_';
  }
  return name;
}

ColumnGroup GroupOf(std::string_view column) {
  const std::string_view name = WithoutUnit(column);
  if (name == WithoutUnit(kTimeColumn)) return ColumnGroup::kTime;
  if (name == WithoutUnit(kBaseTiltColumn)) return ColumnGroup::kBaseTilt;
  if (name == kSelfContactsColumn) return ColumnGroup::kSelfContacts;
  if (IsText(name)) return ColumnGroup::kText;
  constexpr struct {
    const char* start;
    ColumnGroup group;
  } kGroups[] = {{kBase, ColumnGroup::kBasePose},
                 {kCom, ColumnGroup::kCom},
                 {kComReference, ColumnGroup::kComReference},
                 {kComVelocity, ColumnGroup::kComVelocity},
                 {kXi, ColumnGroup::kXi},
                 {kPlan, ColumnGroup::kPlan},
                 {kCop, ColumnGroup::kCop},
                 {kPush, ColumnGroup::kPush},
                 {kOther, ColumnGroup::kOtherForce},
                 {kTau, ColumnGroup::kTorque},
                 {kQ, ColumnGroup::kPosition},
                 {kLambda, ColumnGroup::kCommandedWrench},
                 {kResidual, ColumnGroup::kResidual},
                 {kGap, ColumnGroup::kGap}};
  for (const auto& [start, group] : kGroups) {
    if (StartsWith(name, start)) return group;
  }
  return GroupOfFoot(name);
}

}  // namespace poise

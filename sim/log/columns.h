// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "poise/sim/log/log_rows.h"

namespace poise {

// Names of the columns of a run's log, with units. docs/log.md lists them. The
// recorder and all readers use these names. An axis is 'x', 'y' or 'z'.

inline constexpr char kTimeColumn[] = "time[s]";
inline constexpr char kBaseTiltColumn[] = "base.tilt[rad]";
inline constexpr char kSelfContactsColumn[] = "self_contacts";
inline constexpr char kTouchingColumn[] = "touching";
inline constexpr char kStatusColumn[] = "status";
inline constexpr char kActiveColumn[] = "active";
inline constexpr char kLostColumn[] = "lost";
inline constexpr char kConflictColumn[] = "conflict";
inline constexpr char kReasonColumn[] = "reason";
inline constexpr char kPlanTimeColumn[] = "plan.time[s]";
inline constexpr char kPlanBeyondColumn[] = "plan.beyond[m]";

std::string BasePositionColumn(char axis);    ///< "base.x[m]".
std::string BaseQuaternionColumn(char part);  ///< "base.qw".
std::string ComColumn(char axis);             ///< "com.x[m]".
std::string ComReferenceColumn(char axis);    ///< "com_ref.x[m]".
std::string ComVelocityColumn(char axis);     ///< "com_vel.x[m/s]".
std::string XiColumn(char axis);              ///< "xi.x[m]".
/// Planned place of the foot in the air: "plan.x[m]".
std::string PlanColumn(char axis);
std::string CopColumn(char axis);         ///< "cop.x[m]".
std::string PushColumn(char axis);        ///< "push.fx[N]".
std::string OtherForceColumn(char axis);  ///< "other.fx[N]".

std::string ContactColumn(const std::string& foot);  ///< "FOOT.contact".
std::string TiltColumn(const std::string& foot);     ///< "FOOT.tilt[rad]".
std::string SlideColumn(const std::string& foot);    ///< "FOOT.slide[m]".
std::string PhaseColumn(const std::string& foot);    ///< "FOOT.phase".
/// Center of the sole: "FOOT.x[m]".
std::string FootPositionColumn(const std::string& foot, char axis);

std::string MomentColumn(const std::string& foot,
                         char axis);                          ///< "FOOT.mx[Nm]"
std::string ForceColumn(const std::string& foot, char axis);  ///< "FOOT.fx[N]"
/// Commanded wrench of a foot: "lambda.FOOT.mx[Nm]".
std::string CommandedMomentColumn(const std::string& foot, char axis);
std::string CommandedForceColumn(const std::string& foot, char axis);

std::string TorqueColumn(const std::string& joint);    ///< "tau.JOINT[Nm]".
std::string PositionColumn(const std::string& joint);  ///< "q.JOINT[rad]".
std::string ResidualColumn(const std::string& task);   ///< "residual.TASK".
std::string GapColumn(int level);                      ///< "gap.level_LEVEL".

/// Returns all columns of a log, in their order.
std::vector<LogColumn> LogColumns(const std::vector<std::string>& feet,
                                  const std::vector<std::string>& joints,
                                  const std::vector<std::string>& tasks,
                                  int num_levels);

/// Returns a name as cells of a log and summary.json have it: separators of
/// cells and of lists become '_'.
std::string LogName(std::string name);

/// The quantity of a column.
enum class ColumnGroup {
  kTime,
  kBasePose,
  kBaseTilt,
  kCom,
  kComReference,
  kCop,
  kPush,
  kOtherForce,
  kSelfContacts,
  kContact,      ///< Foot is in contact.
  kTiltOrSlide,  ///< Motion of a foot.
  kComVelocity,
  kXi,               ///< DCM.
  kPlan,             ///< Planned step.
  kFootPosition,     ///< Center of a sole.
  kMoment,           ///< Moment of the ground on a foot.
  kForce,            ///< Force of the ground on a foot.
  kCommandedWrench,  ///< Commanded wrench of a foot.
  kTorque,           ///< Joint torque.
  kPosition,         ///< Joint position.
  kResidual,         ///< Residual of a task.
  kGap,              ///< Gap of a level.
  kText,
  kUnknown,  ///< The name is not a column of a log.
};

/// Returns the group of a column by its name, with or without the unit.
ColumnGroup GroupOf(std::string_view column);

}  // namespace poise

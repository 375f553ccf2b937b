// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

namespace poise {

/// Reads the part of a run's log that a page shows, with fewer rows so that the
/// page stays small. Returns:
///
///     rows     number of rows of the log. motion   {rows, time, channels}:
///     base, joints, CoM and foot wrenches, for
///              the replay. One row of a constant number of rows is kept.
///     signals  {rows, time, channels}, for the plots, with
///              com_error = com - com_ref.
///     torques  {rows, time, channels}, for the plots.
///     active   [{name, peak, spans: [[from, to, multiplier], ...]}]: intervals
///              in which a row of the hierarchy was active, s, and the largest
///              multiplier in each. peak is the largest of all.
///     status   [[status, from, to], ...]: intervals with a status other than
///              "ok", s.
///     touching [["A|B", from, to], ...]: times at which two links touched, s.
///     notes    [sentence, ...]: errors in the log.
///
/// See EncodeChannel() for channels, EncodeFloats() for time. If a plot has too
/// many rows, 2 n rows become two points: their smallest and their largest
/// value, in order of time. So a peak of one tick stays visible.
///
/// If the log has no rows or is cut short, the existing rows are returned with
/// a note. Throws std::invalid_argument with the name of the file if there is
/// no log or no column time. Also throws if a cell that must be a number is
/// not, or if a complete row has another length than the header.
///
/// @param num_rows  number of rows of the log. If it is not given, a first pass
///                  over the log counts them.
///
/// Reads the log once, apart from that pass. Needs the memory of the result.
nlohmann::json ReadRunLog(const std::filesystem::path& file,
                          std::optional<long> num_rows = {});

/// Reads timing.csv in the same way. Returns {rows, time, channels} with the
/// channels us and iterations. The time is the number of the tick times the
/// control period dt, s.
nlohmann::json ReadTiming(const std::filesystem::path& timing_csv, double dt,
                          std::optional<long> num_rows = {});

}  // namespace poise

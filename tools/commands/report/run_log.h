// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

namespace poise {

/// What a page shows of a run's log, thinned so that it stays small:
///
///     rows     of the log.
///     motion   {rows, time, channels}: base, joints, CoM, foot wrenches and
///              push, every so many ticks, for the replay.
///     signals  the same shape, for the plots, with com_error = com - com_ref.
///     torques  the same shape.
///     active   [{name, peak, spans: [[from, to, multiplier], ...]}]: when each
///              row of the hierarchy was active, in s, the largest multiplier.
///     status   [[status, from, to], ...]: where it was not "ok".
///     touching [["A|B", from, to], ...]: when two links pressed on each other.
///     notes    [sentence, ...]: what is wrong with the log.
///
/// See EncodeChannel() for channels, EncodeFloats() for time. Where plots are
/// thinned, 2 n rows give two points, their least and greatest value in the
/// order they came in: a peak of one tick stays visible.
///
/// A log without rows, or one cut short, is read as far as it goes and noted.
/// Throws std::invalid_argument, naming the file, if there is none, if it has no
/// column time, or holds what is no number where one must be, or a whole row of
/// another length than its header.
///
/// @param num_rows  of the log; if it is not given, a first pass counts them.
///
/// Takes one pass over the log and the memory of the result.
nlohmann::json ReadRunLog(const std::filesystem::path& file,
                          std::optional<long> num_rows = {});

/// The same for timing.csv: {rows, time, channels} with us and iterations; the
/// time is that of the tick number, given the control period dt, s.
nlohmann::json ReadTiming(const std::filesystem::path& timing_csv, double dt,
                          std::optional<long> num_rows = {});

}  // namespace poise

// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/peers/tick_file.h"

#include <fstream>
#include <stdexcept>

namespace poise {
namespace {

constexpr char kFormat[] = "poise-ticks-1";

void WriteInt(int value, std::ostream* out) {
  out->write(reinterpret_cast<const char*>(&value), sizeof value);
}

int ReadInt(std::istream* in) {
  int value = 0;
  in->read(reinterpret_cast<char*>(&value), sizeof value);
  return value;
}

template <typename Numbers>
void WriteNumbers(const Numbers& numbers, std::ostream* out) {
  out->write(reinterpret_cast<const char*>(numbers.data()),
             static_cast<std::streamsize>(numbers.size() * sizeof(double)));
}

template <typename Numbers>
void ReadNumbers(std::istream* in, Numbers* numbers) {
  in->read(reinterpret_cast<char*>(numbers->data()),
           static_cast<std::streamsize>(numbers->size() * sizeof(double)));
}

void WriteTick(const Hierarchy& tick, std::ostream* out) {
  WriteInt(tick.num_levels(), out);
  for (int k = 0; k < tick.num_levels(); ++k) {
    WriteInt(tick.num_equalities(k), out);
    WriteNumbers(tick.B(k), out);
    WriteNumbers(tick.b(k), out);
    WriteNumbers(tick.weight(k), out);
    WriteInt(tick.num_inequalities(k), out);
    WriteNumbers(tick.C(k), out);
    WriteNumbers(tick.lower(k), out);
    WriteNumbers(tick.upper(k), out);
  }
}

void ReadTick(std::istream* in, Hierarchy* tick) {
  tick->Clear(ReadInt(in));
  for (int k = 0; k < tick->num_levels(); ++k) {
    EqualityBlock equalities = tick->AddEqualities(k, ReadInt(in));
    ReadNumbers(in, &equalities.B);
    ReadNumbers(in, &equalities.b);
    ReadNumbers(in, &equalities.weight);
    InequalityBlock inequalities = tick->AddInequalities(k, ReadInt(in));
    ReadNumbers(in, &inequalities.C);
    ReadNumbers(in, &inequalities.lower);
    ReadNumbers(in, &inequalities.upper);
  }
}

}  // namespace

void WriteTicks(const RecordedTicks& recorded, const std::string& path) {
  std::ofstream out(path, std::ios::binary);
  out.write(kFormat, sizeof kFormat);
  WriteInt(static_cast<int>(recorded.capacity.size()), &out);
  for (const LevelCapacity& level : recorded.capacity) {
    WriteInt(level.equalities, &out);
    WriteInt(level.inequalities, &out);
  }
  WriteInt(recorded.ticks.front().num_variables(), &out);
  WriteInt(static_cast<int>(recorded.ticks.size()), &out);
  for (const Hierarchy& tick : recorded.ticks) WriteTick(tick, &out);
  if (!out.flush()) throw std::runtime_error(path + ": cannot be written");
}

RecordedTicks ReadTicks(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::string format(sizeof kFormat, '\0');
  in.read(format.data(), sizeof kFormat);
  if (!in || format != std::string(kFormat, sizeof kFormat)) {
    throw std::invalid_argument(path + ": not a file of recorded ticks, want " +
                                kFormat + "; record it again");
  }
  RecordedTicks recorded;
  recorded.capacity.resize(ReadInt(&in));
  for (LevelCapacity& level : recorded.capacity) {
    level.equalities = ReadInt(&in);
    level.inequalities = ReadInt(&in);
  }
  const int num_variables = ReadInt(&in);
  const int num_ticks = ReadInt(&in);
  for (int i = 0; in && i < num_ticks; ++i) {
    recorded.ticks.emplace_back(num_variables, recorded.capacity);
    ReadTick(&in, &recorded.ticks.back());
  }
  if (!in) {
    throw std::invalid_argument(
        path + ": ends in tick " + std::to_string(recorded.ticks.size()) +
        " of " + std::to_string(num_ticks) + "; record it again");
  }
  return recorded;
}

}  // namespace poise

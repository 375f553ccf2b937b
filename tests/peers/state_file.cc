// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/peers/state_file.h"

#include <Eigen/Core>
#include <fstream>
#include <limits>
#include <stdexcept>

namespace poise {
namespace {

constexpr char kFormat[] = "poise-states-1";

void Write(const Eigen::VectorXd& numbers, std::ostream* out) {
  for (const double number : numbers) *out << ' ' << number;
}

void Read(std::istream* in, Eigen::VectorXd* numbers) {
  for (double& number : *numbers) *in >> number;
}

}  // namespace

void WriteStates(const std::vector<State>& states, const std::string& path) {
  std::ofstream out(path);
  out.precision(std::numeric_limits<double>::max_digits10);
  out << kFormat << ' ' << states.size() << ' ' << states.front().q.size()
      << ' ' << states.front().v.size();
  for (const State& state : states) {
    out << '\n' << state.time;
    Write(state.q, &out);
    Write(state.v, &out);
  }
  out << '\n';
  if (!out.flush()) throw std::runtime_error(path + ": cannot be written");
}

std::vector<State> ReadStates(const std::string& path) {
  std::ifstream in(path);
  std::string format;
  int num_states = 0, nq = 0, nv = 0;
  in >> format >> num_states >> nq >> nv;
  if (!in || format != kFormat || num_states < 1 || nq < 0 || nv < 0) {
    throw std::invalid_argument(path +
                                ": not a file of recorded states, want " +
                                kFormat + "; record it again");
  }
  std::vector<State> states;
  while (in && static_cast<int>(states.size()) < num_states) {
    State state{0, Eigen::VectorXd(nq), Eigen::VectorXd(nv)};
    in >> state.time;
    Read(&in, &state.q);
    Read(&in, &state.v);
    states.push_back(state);
  }
  if (!in) {
    throw std::invalid_argument(
        path + ": ends in state " + std::to_string(states.size()) + " of " +
        std::to_string(num_states) + "; record it again");
  }
  return states;
}

}  // namespace poise

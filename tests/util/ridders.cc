// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tests/util/ridders.h"

#include <ceres/dynamic_numeric_diff_cost_function.h>

#include <stdexcept>

namespace poise {
namespace {

using Function = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

struct Functor {
  const Function& function;
  Eigen::Index size;

  bool operator()(double const* const* x, double* y) const {
    Eigen::VectorXd copy = Eigen::Map<const Eigen::VectorXd>(x[0], size);
    const Eigen::VectorXd value = function(copy);
    Eigen::Map<Eigen::VectorXd>(y, value.size()) = value;
    return true;
  }
};

}  // namespace

Eigen::MatrixXd RiddersJacobian(const Function& function,
                                const Eigen::VectorXd& x) {
  const Eigen::Index rows = function(x).size();
  ceres::NumericDiffOptions options;
  // Ceres begins with steps 32 times as long and halves them nine times. The
  // longest step is therefore about kRiddersReach.
  options.ridders_relative_initial_step_size = 1e-3;
  ceres::DynamicNumericDiffCostFunction<Functor, ceres::RIDDERS> cost(
      new Functor{function, x.size()}, ceres::TAKE_OWNERSHIP, options);
  cost.AddParameterBlock(static_cast<int>(x.size()));
  cost.SetNumResiduals(static_cast<int>(rows));
  Eigen::VectorXd y(rows);
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> J(
      rows, x.size());
  const double* blocks[] = {x.data()};
  double* jacobians[] = {J.data()};
  if (!cost.Evaluate(blocks, y.data(), jacobians)) {
    throw std::runtime_error("the function cannot be evaluated");
  }
  return J;
}

Eigen::VectorXd RiddersRate(
    const std::function<Eigen::VectorXd(double)>& function) {
  // The argument is around 1, so that Ceres' relative steps equal absolute
  // steps.
  return RiddersJacobian(
      [&function](const Eigen::VectorXd& t) { return function(t[0] - 1); },
      Eigen::VectorXd::Ones(1));
}

}  // namespace poise

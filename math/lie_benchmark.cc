// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Benchmarks the maps of SO(3) and SE(3) against Eigen's AngleAxis and
// Quaternion. Angles are from 0.01 to 3.1 rad, on both sides of Stumpff's
// switch.
//
//     bazel run --config=native //math:lie_benchmark
//
// prints the fastest time per call of each, and the ratios.
#include <benchmark/benchmark.h>

#include <Eigen/Geometry>
#include <array>

#include "poise/math/pose.h"
#include "poise/math/quaternion.h"
#include "poise/math/se3.h"
#include "poise/math/so3.h"
#include "poise/tests/util/compare_times.h"

namespace poise {
namespace {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr int kCases = 256;

// A pose as users of Eigen store it.
struct QuaternionPose {
  Quaterniond q;
  Vector3d p;
};

QuaternionPose operator*(const QuaternionPose& X, const QuaternionPose& Y) {
  return {X.q * Y.q, X.q * Y.p + X.p};
}

struct Cases {
  Cases() {
    for (int i = 0; i < kCases; ++i) {
      const double angle = 0.01 + 3.09 * i / kCases;
      w[i] =
          angle * LogQuaternion(UniformQuaternion({i / (kCases + 0.5),
                                                   0.37 * i - int(0.37 * i),
                                                   0.71 * i - int(0.71 * i)}))
                      .normalized();
      R[i] = ExpSo3(w[i]);
      q[i] = ExpQuaternion(w[i]);
      p[i] = R[i] * Vector3d(1, -2, 0.5);
      x[i] << w[i], p[i];
      X[i] = {R[i], p[i]};
      Xq[i] = {q[i], p[i]};
      Xi[i] = Eigen::Translation3d(p[i]) * q[i];
    }
  }
  std::array<Vector3d, kCases> w, p;
  std::array<Vector6d, kCases> x;
  std::array<Matrix3d, kCases> R;
  std::array<Quaterniond, kCases> q;
  std::array<Pose, kCases> X;
  std::array<QuaternionPose, kCases> Xq;
  std::array<Eigen::Isometry3d, kCases> Xi;
};

// Times f(cases, i) over all i.
template <typename Function>
void Run(benchmark::State& state, Function f) {
  static const Cases cases;
  const Cases& c = cases;
  for (auto _ : state) {
    for (int i = 0; i < kCases; ++i) {
      auto result = f(c, i);
      benchmark::DoNotOptimize(result);
    }
  }
  state.SetItemsProcessed(state.iterations() * kCases);
}

void Exp(benchmark::State& state) {
  Run(state, [](const Cases& c, int i) { return ExpSo3(c.w[i]); });
}
BENCHMARK(Exp);

void ExpByAngleAxis(benchmark::State& state) {
  Run(state, [](const Cases& c, int i) -> Matrix3d {
    const Vector3d& w = c.w[i];
    const double angle = w.norm();
    return AngleAxisd(angle, w / angle).toRotationMatrix();
  });
}
BENCHMARK(ExpByAngleAxis);

void ExpToQuaternion(benchmark::State& state) {
  Run(state, [](const Cases& c, int i) { return ExpQuaternion(c.w[i]); });
}
BENCHMARK(ExpToQuaternion);

void ExpToQuaternionByAngleAxis(benchmark::State& state) {
  Run(state, [](const Cases& c, int i) {
    const Vector3d& w = c.w[i];
    const double angle = w.norm();
    return Quaterniond(AngleAxisd(angle, w / angle));
  });
}
BENCHMARK(ExpToQuaternionByAngleAxis);

void Log(benchmark::State& state) {
  Run(state, [](const Cases& c, int i) { return LogSo3(c.R[i]); });
}
BENCHMARK(Log);

void LogByAngleAxis(benchmark::State& state) {
  Run(state, [](const Cases& c, int i) -> Vector3d {
    const AngleAxisd a(c.R[i]);
    return a.angle() * a.axis();
  });
}
BENCHMARK(LogByAngleAxis);

void LogOfQuaternion(benchmark::State& state) {
  Run(state, [](const Cases& c, int i) { return LogQuaternion(c.q[i]); });
}
BENCHMARK(LogOfQuaternion);

void LogOfQuaternionByAngleAxis(benchmark::State& state) {
  Run(state, [](const Cases& c, int i) -> Vector3d {
    const AngleAxisd a(c.q[i]);
    return a.angle() * a.axis();
  });
}
BENCHMARK(LogOfQuaternionByAngleAxis);

void Compose(benchmark::State& state) {
  Run(state,
      [](const Cases& c, int i) { return c.X[i] * c.X[kCases - 1 - i]; });
}
BENCHMARK(Compose);

void ComposeByQuaternion(benchmark::State& state) {
  Run(state,
      [](const Cases& c, int i) { return c.Xq[i] * c.Xq[kCases - 1 - i]; });
}
BENCHMARK(ComposeByQuaternion);

void ComposeByIsometry(benchmark::State& state) {
  Run(state,
      [](const Cases& c, int i) { return c.Xi[i] * c.Xi[kCases - 1 - i]; });
}
BENCHMARK(ComposeByIsometry);

void ComposeRotations(benchmark::State& state) {
  Run(state, [](const Cases& c, int i) -> Matrix3d {
    return c.R[i] * c.R[kCases - 1 - i];
  });
}
BENCHMARK(ComposeRotations);

// Composes quaternions and converts the result to a matrix.
void ComposeRotationsByQuaternion(benchmark::State& state) {
  Run(state, [](const Cases& c, int i) -> Matrix3d {
    return (c.q[i] * c.q[kCases - 1 - i]).toRotationMatrix();
  });
}
BENCHMARK(ComposeRotationsByQuaternion);

void Act(benchmark::State& state) {
  Run(state, [](const Cases& c, int i) -> Vector3d {
    return c.X[i] * c.p[kCases - 1 - i];
  });
}
BENCHMARK(Act);

void ActByQuaternion(benchmark::State& state) {
  Run(state, [](const Cases& c, int i) -> Vector3d {
    return c.q[i] * c.p[kCases - 1 - i] + c.p[i];
  });
}
BENCHMARK(ActByQuaternion);

void AdjointOfPose(benchmark::State& state) {
  Run(state, [](const Cases& c, int i) { return Adjoint(c.X[i]); });
}
BENCHMARK(AdjointOfPose);

void AdjointByQuaternion(benchmark::State& state) {
  Run(state, [](const Cases& c, int i) {
    const Matrix3d R = c.q[i].toRotationMatrix();
    Matrix6d Ad;
    Ad << R, Matrix3d::Zero(), Hat(c.p[i]) * R, R;
    return Ad;
  });
}
BENCHMARK(AdjointByQuaternion);

void ExpOfTwist(benchmark::State& state) {
  Run(state, [](const Cases& c, int i) { return ExpSe3(c.x[i]); });
}
BENCHMARK(ExpOfTwist);

void LogOfPose(benchmark::State& state) {
  Run(state, [](const Cases& c, int i) { return LogSe3(c.X[i]); });
}
BENCHMARK(LogOfPose);

}  // namespace
}  // namespace poise

int main(int argc, char** argv) {
  return poise::CompareTimes(
      argc, argv,
      {{"Exp", "ExpByAngleAxis"},
       {"ExpToQuaternion", "ExpToQuaternionByAngleAxis"},
       {"Log", "LogByAngleAxis"},
       {"LogOfQuaternion", "LogOfQuaternionByAngleAxis"},
       {"Compose", "ComposeByQuaternion"},
       {"Compose", "ComposeByIsometry"},
       {"ComposeRotations", "ComposeRotationsByQuaternion"},
       {"Act", "ActByQuaternion"},
       {"AdjointOfPose", "AdjointByQuaternion"}});
}

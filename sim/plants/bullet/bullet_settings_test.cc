// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/sim/plants/bullet/bullet_settings.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "poise/dynamics/tick.h"
#include "poise/sim/plants/bullet/bullet_plant.h"
#include "poise/tests/util/decompositions.h"
#include "poise/tests/util/random_tree.h"
#include "poise/tests/util/simple_robots.h"

namespace poise {
namespace {

// Errors of a free flight without gravity. Each wrong setting increases one.
struct Flight {
  double acceleration_error;  // First step against dynamics, relative.
  double momentum_drift;      // Over 1 s, relative.
  double energy_drift;        // Over 1 s, relative, signed.
};

Flight Fly(const BulletSettings& bullet) {
  std::mt19937 draw(4);
  const Tree tree =
      MakeRandomTree(8, &draw, BaseType::kFloating, Eigen::Vector3d::Zero());
  BulletPlant plant(MakeRobot(tree), {}, bullet);
  const Eigen::VectorXd q = MakeRandomConfiguration(tree, &draw);
  const Eigen::VectorXd v = 0.5 * MakeRandomVector(tree.nv(), &draw);
  plant.Reset(q, v);
  Tick tick(tree, {});
  ComputeTick(tree, q, v, &tick);
  const Eigen::VectorXd expected = LeastSquaresSolution(tick.M, -tick.N).x;
  const Vector6d momentum = tick.L_G;
  const double energy = v.dot(tick.M * v) / 2;
  const Eigen::VectorXd tau = Eigen::VectorXd::Zero(8);
  plant.Step(tau);
  Flight flight;
  flight.acceleration_error =
      (plant.Sense().vdot - expected).norm() / expected.norm();
  for (int k = 1; k < 1000; ++k) plant.Step(tau);
  ComputeTick(tree, plant.Sense().q, plant.Sense().v, &tick);
  flight.momentum_drift = (tick.L_G - momentum).norm() / momentum.norm();
  flight.energy_drift =
      plant.Sense().v.dot(tick.M * plant.Sense().v) / 2 / energy - 1;
  return flight;
}

TEST(BulletSettings, DefaultsKeepMomentumAndEnergy) {
  const Flight flight = Fly({});
  EXPECT_LT(flight.acceleration_error, 1e-9);
  EXPECT_LT(flight.momentum_drift, 3e-3);
  EXPECT_LT(std::abs(flight.energy_drift), 3e-3);
}

TEST(BulletSettings, DampingLosesEnergy) {
  BulletSettings linear, angular;
  linear.linear_damping = 0.04;
  angular.angular_damping = 0.04;
  EXPECT_LT(Fly(linear).energy_drift, -0.01);
  EXPECT_LT(Fly(angular).energy_drift, -4e-3);
  EXPECT_GT(Fly(linear).acceleration_error, 1e-3);
  EXPECT_GT(Fly(angular).acceleration_error, 1e-3);
}

TEST(BulletSettings, WithoutGyroscopicTermMomentumDrifts) {
  BulletSettings bullet;
  bullet.gyroscopic_term = false;
  const Flight flight = Fly(bullet);
  EXPECT_GT(flight.acceleration_error, 1e-3);
  EXPECT_GT(flight.momentum_drift, 3 * Fly({}).momentum_drift);
}

TEST(BulletSettings, Rk4GivesAnotherAcceleration) {
  BulletSettings bullet;
  bullet.rk4 = true;
  EXPECT_GT(Fly(bullet).acceleration_error, 1e-5);
}

TEST(BulletSettings, GlobalVelocitiesGiveWrongAccelerations) {
  BulletSettings bullet;
  bullet.global_velocities = true;
  EXPECT_GT(Fly(bullet).acceleration_error, 1e-2);
}

TEST(BulletSettings, VelocitiesAreClamped) {
  BulletSettings bullet;
  bullet.max_velocity = 0.1;
  EXPECT_GT(Fly(bullet).acceleration_error, 0.1);
}

// Returns the speed of a block on a slope at 99 % of the friction angle, m/s.
// The exact speed is 0.
double Creep(const BulletSettings& bullet) {
  PlantSettings settings;
  settings.ground.pitch = 0.99 * std::atan(settings.friction);
  BulletPlant plant(MakeBlock({0.3, 0.3, 0.02}, 5), settings, bullet);
  Eigen::VectorXd q(7);
  q << 0.01 * GroundNormal(settings.ground),
      Eigen::Quaterniond(
          Eigen::AngleAxisd(settings.ground.pitch, Eigen::Vector3d::UnitY()))
          .coeffs();
  plant.Reset(q, Eigen::VectorXd::Zero(6));
  for (int k = 0; k < 500; ++k) plant.Step({});
  return plant.Sense().v.tail<3>().norm();
}

TEST(BulletSettings, FewIterationsCreep) {
  BulletSettings few;
  few.solver_iterations = 10;
  EXPECT_LT(Creep({}), 1e-5);
  EXPECT_GT(Creep(few), 5 * Creep({}));
}

// If Bullet's own sweeps end as soon as little changes, the block creeps too.
TEST(BulletSettings, ResidualThresholdEndsBulletsSweepsEarly) {
  BulletSettings exact, early;
  exact.own_sweeps = early.own_sweeps = false;
  early.residual_threshold = 1e-3;
  EXPECT_LT(Creep(exact), 1e-5);
  EXPECT_GT(Creep(early), 5 * Creep(exact));
}

// Returns the speed of a block that is pushed after it stood still for 3 s,
// m/s. Bullet puts a body to sleep after 2 s.
double SpeedAfterRest(const BulletSettings& bullet) {
  BulletPlant plant(MakeBlock({0.3, 0.3, 0.02}, 5), {}, bullet);
  Eigen::VectorXd q = Eigen::VectorXd::Zero(7);
  q[2] = 0.01;
  q[6] = 1;
  plant.Reset(q, Eigen::VectorXd::Zero(6));
  for (int k = 0; k < 3000; ++k) plant.Step({});
  for (int k = 0; k < 100; ++k) {
    plant.Apply({0, {0, 0, -0.01}, {0, 0, 0}, {45, 0, 0}});
    plant.Step({});
  }
  return plant.Sense().v[3];
}

TEST(BulletSettings, SleepingBodyIgnoresForces) {
  BulletSettings sleepy;
  sleepy.can_sleep = true;
  // The acceleration is (45 N - 0.8 m g) / m, for 0.1 s.
  EXPECT_NEAR(SpeedAfterRest({}), (45.0 / 5 - 0.8 * 9.81) * 0.1, 1e-3);
  EXPECT_EQ(SpeedAfterRest(sleepy), 0);
}

// Returns the height of the center of a sole, tilted by 0.5 rad, at which the
// sole touches the ground, m.
double TouchingHeight(double sole_radius) {
  BulletSettings bullet;
  bullet.sole_radius = sole_radius;
  for (double height = 0.2; height > 0; height -= 1e-4) {
    BulletPlant plant(MakeBlock({0.2, 0.2, 0.2}, 5), {}, bullet);
    const Eigen::Quaterniond R_WB(
        Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitX()));
    Eigen::VectorXd q(7);
    q << Eigen::Vector3d(0, 0, height) - R_WB * Eigen::Vector3d(0, 0, -0.1),
        R_WB.coeffs();
    plant.Reset(q, Eigen::VectorXd::Zero(6));
    plant.Step({});
    if (plant.Sense().contact_points[0] > 0) return height;
  }
  return 0;
}

TEST(BulletSettings, SoleCornersAreSpheresOfTheSoleRadius) {
  // The corner is 0.1 sin(0.5) below the center. A sphere of radius r, whose
  // center is r above the corner, reaches r (1 - cos(0.5)) deeper.
  const double corner = 0.1 * std::sin(0.5);
  // Tolerance: the search step of 0.1 mm, and the fall within a step. Bullet
  // stops bodies that would touch within a step.
  constexpr double kStep = 2e-4;
  for (const double radius : {0.005, 0.05}) {
    EXPECT_NEAR(TouchingHeight(radius), corner + radius * (1 - std::cos(0.5)),
                kStep);
  }
}

// Returns the sideways slide of a turned block on a steep slope, m.
double Sideways(const BulletSettings& bullet) {
  PlantSettings settings;
  settings.friction = 0.2;
  settings.ground.pitch = 0.6;
  settings.ground.roll = 0.4;
  BulletPlant plant(MakeBlock({0.3, 0.3, 0.02}, 5), settings, bullet);
  const Eigen::Vector3d normal = GroundNormal(settings.ground);
  Eigen::VectorXd q(7);
  q << 0.01 * normal, GroundRotation(settings.ground).coeffs();
  plant.Reset(q, Eigen::VectorXd::Zero(6));
  for (int k = 0; k < 500; ++k) plant.Step({});
  const Eigen::Vector3d way = plant.Sense().q.head<3>() - q.head<3>();
  const Eigen::Vector3d g(0, 0, -1);
  const Eigen::Vector3d down = (g - normal.dot(g) * normal).normalized();
  return (way - down.dot(way) * down).norm();
}

TEST(BulletSettings, OneFrictionDirectionLetsABlockDriftSideways) {
  BulletSettings one;
  one.two_friction_directions = false;
  EXPECT_LT(Sideways({}), 1e-3);
  EXPECT_GT(Sideways(one), 1e-2);
}

// A tumbling block lands, with ContactSolver and with Bullet's own solver.
TEST(ContactSolver, AgreesWithBulletsSolver) {
  const auto land = [](bool own) {
    BulletSettings bullet;
    bullet.own_sweeps = own;
    BulletPlant plant(MakeBlock({0.2, 0.3, 0.1}, 5), {}, bullet);
    Eigen::VectorXd q(7), v(6);
    q << 0, 0, 0.055, 0, 0, 0, 1;
    v << 0, 0, 1, 0.5, 0.2, -0.1;
    plant.Reset(q, v);
    Eigen::VectorXd forces(6 * 40);
    for (int k = 0; k < 40; ++k) {
      plant.Step({});
      forces.segment<6>(6 * k) = plant.Sense().F_Co_C[0];
    }
    return forces;
  };
  const Eigen::VectorXd ours = land(true), bullets = land(false);
  EXPECT_GT(bullets.cwiseAbs().maxCoeff(), 49);  // The block has landed.
  // ContactSolver stops when no impulse changes in 12 digits. Bullet stops
  // after 50 sweeps.
  EXPECT_LT((ours - bullets).norm(), 1e-7 * bullets.norm());
}

}  // namespace
}  // namespace poise

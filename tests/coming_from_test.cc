// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
// Checks every number of docs/coming_from.md. They were derived by hand, so the
// page is an oracle for the conversions, and the test an oracle for the page.

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "poise/dynamics/centroidal.h"
#include "poise/dynamics/conventions.h"
#include "poise/dynamics/crba.h"
#include "poise/dynamics/integrate.h"
#include "poise/dynamics/jacobian.h"
#include "poise/dynamics/kinematics.h"
#include "poise/dynamics/rnea.h"
#include "poise/dynamics/tree.h"
#include "poise/math/se3.h"

namespace poise {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// The page has angles with nine decimals; N multiplies them by nothing larger
// than 1000.
constexpr double kPrinted = 1e-6;

const std::map<std::string, Library> kLibraries = {
    {"pinocchio", Library::kPinocchio},
    {"drake", Library::kDrake},
    {"mujoco", Library::kMujoco}};

// Numbers of the page by library and quantity.
using Numbers = std::map<std::pair<std::string, std::string>, VectorXd>;

Numbers ReadPage() {
  std::ifstream page("docs/coming_from.md");
  EXPECT_TRUE(page) << "docs/coming_from.md";
  Numbers numbers;
  bool in_block = false;
  for (std::string line; std::getline(page, line);) {
    if (line.rfind("```", 0) == 0) {
      in_block = line == "```text";
      continue;
    }
    if (!in_block) continue;
    std::istringstream words(line);
    std::string library, quantity;
    words >> library >> quantity;
    std::vector<double> values;
    for (double value; words >> value;) values.push_back(value);
    EXPECT_TRUE(words.eof()) << line;
    numbers[{library, quantity}] =
        Eigen::Map<VectorXd>(values.data(), static_cast<int>(values.size()));
  }
  return numbers;
}

// The robot of the page.
Tree MakeExample() {
  JointSpec wheel;
  wheel.name = "wheel";
  wheel.type = JointType::kContinuous;
  wheel.parent = "base";
  wheel.child = "rim";
  wheel.axis_F = Eigen::Vector3d::UnitZ();
  wheel.armature = 0.5;
  Inertia base;
  base.mass = 2;
  base.p_BoG_B << 0, 0, 0.5;
  base.I_G_B = Eigen::Vector3d(1, 2, 3).asDiagonal();
  return TreeBuilder()
      .AddLink("base", base)
      .AddLink("rim")
      .AddJoint(wheel)
      .Build();
}

class ComingFrom : public testing::Test {
 protected:
  ComingFrom() : page_(ReadPage()), tree_(MakeExample()), scratch_(tree_) {
    q_ = page_[{"poise", "q"}];
    v_ = page_[{"poise", "v"}];
    vdot_ = page_[{"poise", "vdot"}];
    M_.resize(7, 7);
    N_.resize(7);
    J_.resize(6, 7);
    ComputeCrba(tree_, q_, &scratch_, M_);
    ComputeBias(tree_, q_, v_, &scratch_, N_);
    std::vector<Pose> X_WB(tree_.num_bodies());
    ComputePoses(tree_, q_, &X_WB);
    ComputeFrameJacobian(tree_, X_WB, 0, Axes::kWorld, J_);
    J_frame_.resize(6, 7);
    ComputeFrameJacobian(tree_, X_WB, 0, Axes::kFrame, J_frame_);
    // The velocity of the point of the base that is at the world's origin.
    J_origin_ = Adjoint({Eigen::Matrix3d::Identity(), X_WB[0].p}) * J_;
  }

  void Expect(const std::string& library, const std::string& quantity,
              const VectorXd& value) {
    SCOPED_TRACE(library + " " + quantity);
    const auto found = page_.find({library, quantity});
    ASSERT_NE(found, page_.end());
    ASSERT_EQ(found->second.size(), value.size());
    EXPECT_LT((found->second - value).lpNorm<Eigen::Infinity>(), kPrinted)
        << value.transpose();
    ++checked_;
  }

  Numbers page_;
  Tree tree_;
  Recursion scratch_;
  VectorXd q_, v_, vdot_, N_;
  MatrixXd M_;
  Matrix6Xd J_, J_frame_, J_origin_;
  size_t checked_ = 0;
};

TEST_F(ComingFrom, EachNumberOfThePageIsThatOfTheConversions) {
  Expect("poise", "q", q_);
  Expect("poise", "v", v_);
  Expect("poise", "vdot", VectorXd::Zero(7));
  Expect("poise", "M", M_.row(0));
  Expect("poise", "N", N_);
  Expect("poise", "J", J_.row(3));
  Expect("poise", "J_frame", J_frame_.row(3));
  for (const auto& [name, library] : kLibraries) {
    VectorXd q(ConfigurationSize(library, tree_)), v(7), vdot(7), N(7);
    MatrixXd M(7, 7);
    Matrix6Xd J(6, 7);
    ExportConfiguration(library, tree_, q_, q);
    ExportVelocity(library, tree_, q_, v_, v);
    ExportAcceleration(library, tree_, q_, v_, vdot_, vdot);
    ExportMassMatrix(library, tree_, q_, M_, M);
    ExportBias(library, tree_, q_, v_, M_, N_, N);
    ExportJacobian(library, tree_, q_, J_, J);
    Expect(name, "q", q);
    Expect(name, "v", v);
    Expect(name, "vdot", vdot);
    Expect(name, "M", M.row(0));
    Expect(name, "N", N);
    Expect(name, "J", J.row(3));
    if (library == Library::kMujoco) continue;  // It has no axes of a frame.
    ExportJacobian(library, tree_, q_, J_frame_, J);
    Expect(name, "J_frame", J.row(3));
  }
  Matrix6Xd J_origin(6, 7);
  ExportJacobian(Library::kPinocchio, tree_, q_, J_origin_, J_origin);
  Expect("pinocchio", "J_origin", J_origin.row(0));
  CentroidalMomentum momentum(tree_);
  ComputeCentroidalMomentum(tree_, q_, v_, &scratch_, &momentum);
  Expect("poise", "L", momentum.H_G * v_);
  Matrix6Xd Ag(6, 7);
  VectorXd v(7);
  ExportJacobian(Library::kPinocchio, tree_, q_, momentum.H_G, Ag);
  ExportVelocity(Library::kPinocchio, tree_, q_, v_, v);
  Expect("pinocchio", "L", Ag * v);

  VectorXd moved(8), twist = VectorXd::Zero(7);
  twist.head<6>() << 0, 0, M_PI / 2, 1, 0, 0;
  Integrate(tree_, tree_.MakeNeutral(), twist, 1, moved);
  Expect("poise", "moved", moved.head<3>());
  // Pinocchio documents the exponential of SE(3), from the right.
  Expect("pinocchio", "moved", ExpSe3(twist.head<6>()).p);
  EXPECT_EQ(checked_, page_.size());
}

// The robot of the page, written for MuJoCo. MuJoCo needs a mass in each moving
// body; that of the rim is too small to be seen.
constexpr const char* kXml = R"(<mujoco>
  <compiler angle="radian" inertiafromgeom="false"/>
  <worldbody><body>
    <freejoint/>
    <inertial pos="0 0 0.5" mass="2" diaginertia="1 2 3"/>
    <body><joint name="wheel" axis="0 0 1" armature="0.5"/>
      <inertial pos="0 0 0" mass="1e-12" diaginertia="1e-12 1e-12 1e-12"/>
    </body>
  </body></worldbody></mujoco>)";

TEST_F(ComingFrom, TheNumbersOfMujocoAreThoseOfMujoco) {
  const std::string path = std::string(std::getenv("TEST_TMPDIR")) + "/r.xml";
  std::ofstream(path) << kXml;
  char error[500] = "";
  mjModel* model = mj_loadXML(path.c_str(), nullptr, error, sizeof(error));
  ASSERT_NE(model, nullptr) << error;
  mjData* data = mj_makeData(model);
  Eigen::Map<VectorXd>(data->qpos, 8) = page_[{"mujoco", "q"}];
  Eigen::Map<VectorXd>(data->qvel, 7) = page_[{"mujoco", "v"}];
  mj_forward(model, data);
  Eigen::Matrix<double, 7, 7, Eigen::RowMajor> M;
  mj_fullM(model, M.data(), data->qM);
  Expect("mujoco", "M", M.row(0));
  Expect("mujoco", "N", Eigen::Map<VectorXd>(data->qfrc_bias, 7));
  Eigen::Matrix<double, 3, 7, Eigen::RowMajor> jacr;
  mj_jacBody(model, data, nullptr, jacr.data(), 1);
  Expect("mujoco", "J", jacr.row(0));
  mj_deleteData(data);
  mj_deleteModel(model);
}

}  // namespace
}  // namespace poise

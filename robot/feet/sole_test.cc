// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/robot/feet/sole.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "poise/dynamics/kinematics.h"
#include "poise/math/rpy.h"
#include "poise/robot/feet/find_feet.h"
#include "poise/robot/feet/legs.h"
#include "poise/robot/feet/parts_fixture.h"
#include "poise/robot/feet/resting_normal.h"
#include "poise/robot/limits.h"
#include "poise/robot/urdf/urdf.h"
#include "poise/tests/util/mesh_writer.h"
#include "poise/tests/util/shared_data.h"
#include "poise/tests/util/test_file.h"

namespace poise {
namespace {

using Eigen::Vector3d;

// Meshes have single precision, m.
constexpr double kFloat = 1e-6;
// The length of the leg of Leg(), m.
constexpr double kLeg = 0.6;

// Returns the URDF of one leg with three joints whose last link has the given
// text, such as <collision>.
std::string Leg(const std::string& shapes) {
  const std::string inertial =
      "<inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' "
      "iyz='0' izz='1'/></inertial>";
  std::string text =
      "<robot name='leg'><link name='l0'>" + inertial + "</link>";
  for (int i = 1; i <= 3; ++i) {
    const std::string name = std::to_string(i);
    text += "<link name='l" + name + "'>" + inertial + (i == 3 ? shapes : "") +
            "</link><joint name='j" + name +
            "' type='revolute'><origin xyz='0 0 -0.3'/><parent link='l" +
            std::to_string(i - 1) + "'/><child link='l" + name +
            "'/><axis xyz='0 1 0'/><limit lower='-1' upper='1' effort='9' "
            "velocity='9'/></joint>";
  }
  return text + "</robot>";
}

std::string Geometry(const std::string& geometry, const std::string& origin) {
  return "<origin " + origin + "/><geometry>" + geometry + "</geometry>";
}

std::string Collision(const std::string& file,
                      const std::string& origin = "xyz='0 0 0'") {
  return "<collision>" + Geometry("<mesh filename='" + file + "'/>", origin) +
         "</collision>";
}

std::string Visual(const std::string& file) {
  return "<visual>" +
         Geometry("<mesh filename='" + file + "'/>", "xyz='0 0 0'") +
         "</visual>";
}

// Writes the URDF into the folder of the meshes. Returns the outline of the
// last body.
Outline OutlineOf(const std::string& urdf) {
  return MakeOutlines(LoadUrdf(TestFile("leg.urdf", urdf))).back();
}

// Returns the meshes of several parts as one.
TriangleMesh Join(const std::vector<TriangleMesh>& parts) {
  TriangleMesh all;
  for (const TriangleMesh& part : parts) {
    const int first = static_cast<int>(all.vertices.size());
    for (const auto& [a, b, c] : part.triangles) {
      all.triangles.push_back({a + first, b + first, c + first});
    }
    all.vertices.insert(all.vertices.end(), part.vertices.begin(),
                        part.vertices.end());
  }
  return all;
}

// A foot with its sole at z = -0.05: pads of 0.16 x 0.06 m, a rim of
// 0.2 x 0.1 m whose lower edge is 5.5 mm higher, and an instep of 0.3 x 0.2 m
// 7 mm above the sole.
TriangleMesh MakeFootMesh() {
  return Join({BoxMesh({-0.05f, -0.03f, -0.05f}, {0.11f, 0.03f, 0}),
               BoxMesh({-0.07f, -0.05f, -0.0445f}, {0.13f, 0.05f, 0}),
               BoxMesh({-0.12f, -0.1f, -0.043f}, {0.18f, 0.1f, 0.02f})});
}

void ExpectBounds(const Sole& sole, const Pose& X_BS, const Vector3d& low,
                  const Vector3d& high, double tolerance) {
  ASSERT_FALSE(sole.points_B.empty());
  Eigen::AlignedBox3d box;
  for (const Vector3d& p_B : sole.points_B) box.extend(X_BS.Inverse() * p_B);
  EXPECT_LT((box.min() - low).cwiseAbs().maxCoeff(), tolerance)
      << box.min().transpose() << ", not " << low.transpose();
  EXPECT_LT((box.max() - high).cwiseAbs().maxCoeff(), tolerance)
      << box.max().transpose() << ", not " << high.transpose();
}

TEST(FindSole, TakesTheLowestSixMillimetersOfAMesh) {
  TestFile("foot.stl", BinaryStl(MakeFootMesh()));
  TestFile("foot.obj", Obj(MakeFootMesh()));
  for (const std::string file : {"foot.stl", "foot.obj"}) {
    for (const std::string& shape : {Collision(file), Visual(file)}) {
      const Sole sole =
          FindSole(OutlineOf(Leg(shape)), Vector3d::UnitZ(), kLeg);
      ExpectBounds(sole, {}, {-0.07, -0.05, -0.05}, {0.13, 0.05, -0.05},
                   kFloat);
      EXPECT_EQ(sole.source, SoleSource::kMesh);
    }
  }
}

// The pads are 1.5 mm below the rim, and the instep is 30 mm above the sole. So
// at a tenth of its size, the instep is 3 mm above the sole.
TEST(FindFeet, ScalesSolesWithTheRobot) {
  const TriangleMesh foot =
      Join({BoxMesh({-0.05f, -0.03f, -0.05f}, {0.11f, 0.03f, 0}),
            BoxMesh({-0.07f, -0.05f, -0.0485f}, {0.13f, 0.05f, 0}),
            BoxMesh({-0.12f, -0.1f, -0.02f}, {0.18f, 0.1f, 0.02f})});
  TestFile("foot.stl", BinaryStl(foot));
  for (const bool is_mesh : {true, false}) {
    for (const double scale : {0.1, 0.3, 1., 3.}) {
      SCOPED_TRACE(scale);
      const std::string s = std::to_string(scale);
      // The corners of a second box are also 1.5 mm above the sole.
      const auto box = [&](double x, double y, double z) {
        return "box size='" + Numbers(scale * Vector3d(x, y, z)) + "'";
      };
      const std::string shape =
          is_mesh ? ShapeAt("mesh filename='foot.stl' scale='" + s + " " + s +
                                " " + s + "'",
                            {0, 0, 0})
                  : ShapeAt(box(0.16, 0.06, 0.05),
                            scale * Vector3d(0.03, 0, -0.025)) +
                        ShapeAt(box(0.2, 0.1, 0.0485),
                                scale * Vector3d(0.03, 0, -0.02425)) +
                        ShapeAt(box(0.3, 0.2, 0.02),
                                scale * Vector3d(0.03, 0, -0.01));
      const auto parts =
          Joined({MakeLeg({"p_", {0, 0.1 * scale, 0}, 0.8 * scale, shape}),
                  MakeLeg({"q_", {0, -0.1 * scale, 0}, 0.8 * scale, shape})});
      const auto feet =
          FindFeet(LoadUrdf(TestFile("scaled.urdf", UrdfOf(parts))));
      for (const Foot& f : feet) {
        Eigen::AlignedBox3d sole;
        for (const auto& p : f.polygon_C) {
          sole.extend(f.X_BC * Vector3d(p.x(), p.y(), 0));
        }
        // Meshes have single precision.
        EXPECT_LT((sole.min() / scale - Vector3d(-0.07, -0.05, -0.05)).norm(),
                  kFloat);
        EXPECT_LT((sole.max() / scale - Vector3d(0.13, 0.05, -0.05)).norm(),
                  kFloat);
      }
    }
  }
}

TEST(FindSole, PlacesAMeshByItsOriginAndScale) {
  TriangleMesh in_mm = MakeFootMesh();
  for (Eigen::Vector3f& p : in_mm.vertices) p *= 1000;
  TestFile("mm.stl", BinaryStl(in_mm));
  // The mesh's x axis is the link's y axis.
  const std::string shape =
      "<collision>" +
      Geometry("<mesh filename='mm.stl' scale='0.001 0.001 0.001'/>",
               "xyz='0.01 0.02 0.03' rpy='0 0 1.5707963267948966'") +
      "</collision>";
  ExpectBounds(FindSole(OutlineOf(Leg(shape)), Vector3d::UnitZ(), kLeg), {},
               {-0.04, -0.05, -0.02}, {0.06, 0.15, -0.02}, kFloat);
}

// A mesh may be drawn in axes that are not those of its sole, and the foot may
// be tilted at rest. The foot then rests on the flat underside of the mesh.
TEST(FindSole, FindsTheSoleOfAMeshThatIsDrawnTilted) {
  const Eigen::Matrix3d R =
      Eigen::AngleAxisd(0.2, Vector3d(0.3, 0.9, 0.1).normalized())
          .toRotationMatrix();
  TriangleMesh tilted = MakeFootMesh();
  for (Eigen::Vector3f& p : tilted.vertices) p = R.cast<float>() * p;
  TestFile("tilted.stl", BinaryStl(tilted));
  const Sole sole = FindSole(OutlineOf(Leg(Collision("tilted.stl"))),
                             Vector3d::UnitZ(), kLeg);
  EXPECT_LT((sole.normal_B - R.col(2)).norm(), 1e-4);  // 0.02 mm of 0.2 m.
  ExpectBounds(sole, {R, Vector3d::Zero()}, {-0.07, -0.05, -0.05},
               {0.13, 0.05, -0.05}, 1e-4);
}

TEST(FindSole, PrefersTheCollisionMeshAndFallsBackOnTheVisualMesh) {
  TestFile("foot.stl", BinaryStl(MakeFootMesh()));
  TestFile("small.stl", BinaryStl(BoxMesh({0, 0, -0.1f}, {0.1f, 0.05f, 0})));
  TestFile("broken.stl", "solid\nnonsense");
  ExpectBounds(
      FindSole(OutlineOf(Leg(Visual("foot.stl") + Collision("small.stl"))),
               Vector3d::UnitZ(), kLeg),
      {}, {0, 0, -0.1}, {0.1, 0.05, -0.1}, kFloat);
  for (const std::string file : {"missing.stl", "broken.stl"}) {
    ExpectBounds(FindSole(OutlineOf(Leg(Visual("foot.stl") + Collision(file))),
                          Vector3d::UnitZ(), kLeg),
                 {}, {-0.07, -0.05, -0.05}, {0.13, 0.05, -0.05}, kFloat);
  }
}

TEST(FindSole, SaysThatASoleIsFromABox) {
  const std::string box =
      "<collision>" + Geometry("<box size='0.2 0.1 0.02'/>", "xyz='0 0 0'") +
      "</collision>";
  EXPECT_EQ(FindSole(OutlineOf(Leg(box)), Vector3d::UnitZ(), kLeg).source,
            SoleSource::kBox);
}

TEST(MakeOutlines, SaysWhyAMeshGivesNoPoints) {
  // These variables would add folders to the message.
  unsetenv("ROS_PACKAGE_PATH");
  unsetenv("AMENT_PREFIX_PATH");
  const Outline missing = OutlineOf(Leg(Collision("package://p/foot.stl")));
  EXPECT_TRUE(missing.corners.empty());
  const std::string folder =
      std::filesystem::path(TestFile("leg.urdf", "")).parent_path().string();
  EXPECT_EQ(WhyEstimated(missing),
            "because mesh package://p/foot.stl: is missing or no regular file, "
            "was searched in " +
                folder +
                " and above: give --package-path DIR, in Python "
                "packages=[DIR], or the sole in a profile");
  // The folders of packages are not searched for a name without a package.
  EXPECT_EQ(
      WhyEstimated(OutlineOf(Leg(Collision("none.stl")))),
      "because mesh none.stl: is missing or no regular file, was searched "
      "in " +
          folder + ": put the file there, or give the sole in a profile");
  TestFile("broken.stl", "solid\nnonsense");
  EXPECT_EQ(WhyEstimated(OutlineOf(Leg(Collision("broken.stl")))),
            "because mesh " + folder +
                "/broken.stl:2: unknown word 'nonsense' in an STL file; "
                "correct the mesh, or give the sole in a profile");
  EXPECT_EQ(WhyEstimated(OutlineOf(Leg(""))),
            "because the foot has no shape: give the sole in a profile");
}

TEST(WhyEstimated, NamesShapesWithoutAFlatUnderside) {
  const auto reason = [](const std::string& shapes) {
    const Outline outline = OutlineOf(Leg(shapes));
    EXPECT_TRUE(FindSole(outline, Vector3d::UnitZ(), kLeg).points_B.empty());
    return WhyEstimated(outline);
  };
  const std::string start =
      "because the shapes of the foot have no flat underside (they are ";
  const std::string end = "): give the sole in a profile";
  const std::string sphere = ShapeAt("sphere radius='0.03'", {0, 0, 0});
  EXPECT_EQ(reason(sphere), start + "1 sphere" + end);
  // All vertices of this mesh are on one line.
  TestFile("line.stl",
           BinaryStl({{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{{0, 1, 2}}}}));
  EXPECT_EQ(reason(Collision("line.stl") + sphere + sphere),
            start + "2 spheres, 3 mesh vertices" + end);
  EXPECT_EQ(reason(ShapeAt("box size='0.2 0 0'", {0, 0, 0})),
            start + "8 corners of boxes and cylinders" + end);
}

// The last body has too few joints above it, or too many bodies below it.
TEST(MakeOutlines, OpensOnlyMeshesOfBodiesThatCanBeFeet) {
  TestFile("foot.stl", BinaryStl(MakeFootMesh()));
  const std::string leg = Leg(Visual("foot.stl"));
  std::string shifted = leg;  // The mesh is on the body after two joints.
  const std::string visual = Visual("foot.stl");
  shifted.erase(shifted.find(visual), visual.size());
  const std::string second = "<link name='l2'>";
  shifted.insert(shifted.find(second) + second.size(), visual);
  const auto outlines = MakeOutlines(LoadUrdf(TestFile("leg.urdf", shifted)));
  for (const Outline& outline : outlines) {
    EXPECT_TRUE(outline.corners.empty());
    EXPECT_EQ(outline.mesh_refusal, "");
  }
}

// At rest, the foot points down by 0.12 rad, and so does its sole of two small
// spheres at the heel and two larger ones at the toes. Its box points down by
// 0.2 rad and is higher. No axis is normal to the sole.
TEST(FindSole, FindsSpheresOnAPlaneThatNoAxisIsNormalTo) {
  const double tilt = 0.12;
  const Vector3d normal(std::sin(tilt), 0, std::cos(tilt));
  std::string shapes =
      "<collision>" +
      Geometry("<box size='0.2 0.1 0.02'/>", "xyz='0.05 0 0' rpy='0 0.2 0'") +
      "</collision>";
  const auto add = [&](double x, double y, double radius) {
    const Vector3d p =
        Vector3d(std::cos(tilt) * x, y, -std::sin(tilt) * x - 0.05) +
        radius * normal;
    std::ostringstream geometry, origin;
    geometry << "<sphere radius='" << radius << "'/>";
    origin << "xyz='" << p.transpose() << "'";
    shapes +=
        "<collision>" + Geometry(geometry.str(), origin.str()) + "</collision>";
  };
  for (const double y : {-0.04, 0.04}) {
    add(-0.06, y, 0.005);
    add(0.14, y, 0.015);
  }
  const Sole sole = FindSole(OutlineOf(Leg(shapes)), Vector3d::UnitZ(), kLeg);
  // The lowest points of the spheres are taken along the vertical. That turns
  // the plane by 0.01 (1 - cos 0.12) / 0.2 = 4e-4 rad.
  EXPECT_LT((sole.normal_B - normal).norm(), 5e-4);
  // The file has six digits, and the plane is turned: 2e-6 * 0.3 m, and 0.02 m2
  // * 4e-4.
  EXPECT_NEAR(sole.area, 0.2 * 0.08, 1e-5);
}

TEST(RestingNormal, IsAFacetBelowAllVertices) {
  Outline outline;
  EXPECT_FALSE(RestingNormal(outline, Vector3d::UnitZ(), true));
  std::srand(1);
  for (int run = 0; run < 100; ++run) {
    outline.corners.clear();
    for (int i = 0; i < 50; ++i) {
      outline.corners.push_back({0, Vector3d::Random(), 0, /*is_mesh=*/true});
    }
    const Vector3d up = Vector3d::Random().normalized();
    const auto normal = RestingNormal(outline, up, true);
    ASSERT_TRUE(normal);
    EXPECT_NEAR(normal->norm(), 1, 1e-12);
    EXPECT_GT(normal->dot(up), 0);
    // The plane touches three vertices, and none is below it.
    std::vector<double> heights;
    for (const auto& corner : outline.corners) {
      heights.push_back(normal->dot(corner.p_B));
    }
    std::sort(heights.begin(), heights.end());
    EXPECT_LT(heights[2] - heights[0], 3e-7);  // kBelow, and rounding.
  }
}

TEST(RestingNormal, RejectsVerticesInAVerticalPlane) {
  Outline outline;
  for (const double z : {0., 1.}) {
    for (const double x : {0., 1.}) {
      outline.corners.push_back({0, {x, 0, z}, 0, /*is_mesh=*/true});
    }
  }
  const auto normal = RestingNormal(outline, Vector3d::UnitZ(), true);
  EXPECT_TRUE(!normal || normal->z() > 0);
}

// The soles of soles.json were measured on the meshes by another program.
TEST(FindSole, AgreesWithMeasuredSoles) {
  const auto folder = SharedData("robots");
  if (!folder || !std::filesystem::exists(*folder / "soles.json")) return;
  std::ifstream stream(*folder / "soles.json");
  const nlohmann::json robots = nlohmann::json::parse(stream);
  constexpr double kMeasured = 2e-3;  // m.
  int compared = 0;
  for (const auto& [name, robot] : robots.items()) {
    if (robot.value("from", "") != "mesh" || robot["urdf"].is_null()) continue;
    std::vector<Finding> findings;
    const RobotModel model =
        UrdfDocument(*folder / robot["urdf"].get<std::string>(), &findings,
                     {*folder / "packages"})
            .MakeModel();
    const std::vector<Outline> outlines = MakeOutlines(model);
    std::vector<Pose> X_WB(model.tree.num_bodies());
    ComputePoses(model.tree, RestConfiguration(model), &X_WB);
    for (const std::string side : {"left_foot", "right_foot"}) {
      SCOPED_TRACE(name + ", " + side);
      const nlohmann::json& foot = robot[side];
      const auto vector = [&](const char* key) {
        return Vector3d(foot[key][0], foot[key][1], foot[key][2]);
      };
      const Frame& frame = model.tree.frames()[*model.tree.FindFrame(
          foot["frame"].get<std::string>())];
      const Pose X_BS =
          frame.X_BF * Pose{MatrixFromRpy(vector("rpy")), vector("xyz")};
      const Vector3d half(0.5 * foot["size"][0].get<double>(),
                          0.5 * foot["size"][1].get<double>(), 0);
      const Sole sole =
          FindSole(outlines[frame.body], X_WB[frame.body].R.row(2).transpose(),
                   FindLegs(model, outlines).length);
      ExpectBounds(sole, X_BS, -half, half, kMeasured);
      EXPECT_EQ(sole.source, SoleSource::kMesh);
      ++compared;
    }
  }
  EXPECT_GT(compared, 0);
}

}  // namespace
}  // namespace poise

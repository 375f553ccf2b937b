// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/studies/step_pictures.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "poise/dynamics/tick.h"
#include "poise/robot/output_file.h"
#include "poise/sim/log/columns.h"
#include "poise/tools/commands/format.h"
#include "poise/tools/drawing/robot_picture.h"
#include "poise/tools/studies/recorded_run.h"

namespace poise {
namespace {

const Color kLeft = HexColor(0x1f66d1);
const Color kRight = HexColor(0xd9660b);
const Color kCapture = HexColor(0x7a3fb8);
const Color kInk = HexColor(0x16191d);
const Color kGrey = HexColor(0x767e88);

using Outline = std::vector<Eigen::Vector2d>;

struct Footprint {
  int foot;
  std::string label;
  Outline outline;         // m.
  Eigen::Vector2d middle;  // m.
};

Color Faded(Color color, double opacity) {
  color[3] = opacity;
  return color;
}

// Returns the corners of a sole around its center, in the nominal posture.
Outline SoleOf(const Robot& robot, const Tick& tick, int foot) {
  const Foot& of = robot.feet[foot];
  const Pose X_WC = tick.X_WB[of.body] * of.X_BC;
  Outline outline;
  for (const Eigen::Vector2d& corner : of.polygon_C) {
    const Eigen::Vector3d p_C(corner.x(), corner.y(), 0);
    outline.push_back((X_WC.R * p_C).head<2>());
  }
  return outline;
}

std::vector<Footprint> FindFootprints(const Robot& robot,
                                      const RecordedRun& run) {
  const Tree& tree = robot.model.tree;
  Tick tick(tree, {});
  ComputeTick(tree, run.q(0), Eigen::VectorXd::Zero(tree.nv()), &tick);
  std::vector<Footprint> prints;
  const auto add = [&](int foot, const std::string& label,
                       const Eigen::Vector2d& middle) {
    Footprint print{foot, label, SoleOf(robot, tick, foot), middle};
    for (Eigen::Vector2d& corner : print.outline) corner += middle;
    prints.push_back(print);
  };
  for (int foot = 0; foot < static_cast<int>(robot.feet.size()); ++foot) {
    const Foot& of = robot.feet[foot];
    add(foot, "", (tick.X_WB[of.body] * of.X_BC).p.head<2>());
  }
  int count = 0;
  for (const nlohmann::json& step : run.summary()["steps"]) {
    if (!step["landed"].is_array()) continue;
    const std::string name = step["foot"];
    for (int foot = 0; foot < static_cast<int>(robot.feet.size()); ++foot) {
      if (robot.feet[foot].name != name) continue;
      add(foot, std::to_string(++count),
          {step["landed"][0].get<double>(), step["landed"][1].get<double>()});
    }
  }
  return prints;
}

// A map of the ground with forward up and left to the left.
class Map {
 public:
  Map(const std::vector<Footprint>& prints, const Eigen::Vector2d& size) {
    Eigen::Vector2d least = prints[0].middle, most = least;
    for (const Footprint& print : prints) {
      for (const Eigen::Vector2d& corner : print.outline) {
        least = least.cwiseMin(corner);
        most = most.cwiseMax(corner);
      }
    }
    constexpr double kMargin = 0.08;  // m.
    const Eigen::Vector2d extent =
        most - least + 2 * Eigen::Vector2d::Constant(kMargin);
    scale_ = std::min(size.x() / extent.y(), size.y() / extent.x());
    middle_ = (least + most) / 2;
    center_ = size / 2;
  }

  Eigen::Vector2d operator()(const Eigen::Vector2d& p) const {
    return center_ -
           scale_ * Eigen::Vector2d(p.y() - middle_.y(), p.x() - middle_.x());
  }
  Outline operator()(const Outline& points) const {
    Outline drawn;
    for (const Eigen::Vector2d& point : points) {
      drawn.push_back((*this)(point));
    }
    return drawn;
  }
  double scale() const { return scale_; }

 private:
  double scale_;
  Eigen::Vector2d middle_, center_;
};

Outline Path(const RecordedRun& run, const std::string& x,
             const std::string& y) {
  Outline path;
  for (std::size_t i = 0; i < run[x].size(); i += 5) {
    path.emplace_back(run[x][i], run[y][i]);
  }
  return path;
}

void DrawMap(const Robot& robot, const RecordedRun& run,
             const std::filesystem::path& stem) {
  const Eigen::Vector2d size(520, 300);
  constexpr double kLegend = 26;
  const std::vector<Footprint> prints = FindFootprints(robot, run);
  const Map map(prints, size);
  WritePicture(stem, {size.x(), size.y() + kLegend}, [&](Canvas* canvas) {
    for (const Footprint& print : prints) {
      const Color color = print.foot == 0 ? kLeft : kRight;
      Outline closed = map(print.outline);
      canvas->Polygon(closed, Faded(color, print.label.empty() ? 0.07 : 0.2));
      closed.push_back(closed.front());
      canvas->Line(closed, color, 1, print.label.empty());
      const Eigen::Vector2d at = map(print.middle);
      canvas->Text({at.x(), at.y() + 4}, print.label, 12, color,
                   Anchor::kMiddle, true);
    }
    canvas->Line(map(Path(run, XiColumn('x'), XiColumn('y'))), kCapture, 1.5);
    canvas->Line(map(Path(run, ComColumn('x'), ComColumn('y'))), kInk, 1.5);
    const double meter = 0.25 * map.scale();
    const double y = size.y() + kLegend - 8;
    canvas->Line({{12, y - 4}, {12 + meter, y - 4}}, kGrey, 2);
    canvas->Text({18 + meter, y}, "0.25 m", 11, kGrey);
    canvas->Line({{200, y - 4}, {220, y - 4}}, kInk, 1.5);
    canvas->Text({225, y}, "center of mass", 11, kInk);
    canvas->Line({{340, y - 4}, {360, y - 4}}, kCapture, 1.5);
    canvas->Text({365, y}, "capture point", 11, kCapture);
  });
}

// The arrow of a shove would be longer than the robot.
std::vector<PushArrow> ShortArrows(const RecordedRun& run, double time) {
  constexpr double kLongest = 130;  // N.
  std::vector<PushArrow> arrows = run.ArrowAt(time);
  for (PushArrow& arrow : arrows) {
    arrow.force *= std::min(1.0, kLongest / arrow.force.norm());
  }
  return arrows;
}

void DrawPoses(const Robot& robot, const RecordedRun& run,
               const std::vector<double>& times,
               const std::filesystem::path& stem) {
  constexpr double kWidth = 300, kHeight = 400;
  std::vector<Camera> cameras;
  double height = 0;
  for (const double time : times) {
    // The camera follows the robot.
    Camera camera;
    const Eigen::VectorXd q = run.q(time);
    const Eigen::Vector3d moved(q[0], q[1], 0);
    camera.eye += moved;
    camera.target += moved;
    camera = FitCamera({kWidth, kHeight}, robot.model, q,
                       ShortArrows(run, time), camera);
    height = std::max(height, camera.height);
    cameras.push_back(camera);
  }
  for (Camera& camera : cameras) camera.height = height;
  WritePicture(stem, {kWidth * static_cast<double>(times.size()), kHeight + 28},
               [&](Canvas* canvas) {
                 for (std::size_t i = 0; i < times.size(); ++i) {
                   const double x = kWidth * static_cast<double>(i);
                   DrawRobot({x, 0}, {kWidth, kHeight}, robot.model,
                             run.q(times[i]), ShortArrows(run, times[i]),
                             cameras[i], canvas);
                   canvas->Text({x + kWidth / 2, kHeight + 16},
                                Format("t = %.2f s", times[i]), 11, kInk,
                                Anchor::kMiddle);
                 }
               });
}

}  // namespace

void DrawShove(const Robot& robot, const std::filesystem::path& runs,
               const std::filesystem::path& pictures) {
  MakeFolder(pictures);
  const RecordedRun run(robot, runs / "shove");
  const nlohmann::json& steps = run.summary()["steps"];
  if (!steps.is_array() || steps.empty() || !steps[0]["swing_s"].is_number()) {
    throw std::invalid_argument((runs / "shove").string() +
                                ": the robot took no step");
  }
  const auto push = *run.Push();
  const double lift_off = steps[0]["at"];
  const double swing = steps[0]["swing_s"];
  DrawPoses(robot, run,
            {(push.first + lift_off) / 2, lift_off + 0.6 * swing,
             lift_off + swing + 0.05, run.end()},
            pictures / "shove");
  DrawMap(robot, run, pictures / "shove-map");
}

}  // namespace poise

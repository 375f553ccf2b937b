// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/studies/figures_draw.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "poise/robot/output_file.h"
#include "poise/sim/log/columns.h"
#include "poise/sim/outcome.h"
#include "poise/tools/commands/format.h"
#include "poise/tools/drawing/plot.h"
#include "poise/tools/drawing/robot_picture.h"
#include "poise/tools/studies/recorded_run.h"

namespace poise {
namespace {

namespace fs = std::filesystem;

const Color kBlue = HexColor(0x1f66d1);
const Color kOrange = HexColor(0xd9660b);
const Color kGrey = HexColor(0x767e88);
const Color kInk = HexColor(0x16191d);

double Largest(const std::vector<double>& values) {
  double largest = 0;
  for (const double value : values) {
    largest = std::max(largest, std::abs(value));
  }
  return largest;
}

double TimeOfLargest(const RecordedRun& run,
                     const std::vector<double>& values) {
  const auto largest = std::max_element(
      values.begin(), values.end(),
      [](double a, double b) { return std::abs(a) < std::abs(b); });
  return run[kTimeColumn][largest - values.begin()];
}

// Returns the time after `since` from which a quantity stays within a bound, s.
double SettledAfter(const RecordedRun& run, const std::vector<double>& values,
                    double bound, double since) {
  double last = since;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::abs(values[i]) > bound) last = run[kTimeColumn][i];
  }
  return last - since;
}

// Draws poses side by side, each with its time.
void DrawPoses(const Robot& robot, const RecordedRun& run,
               const std::vector<double>& times, const fs::path& stem) {
  constexpr double kWidth = 370, kHeight = 400;
  Camera camera;
  for (const double time : times) {
    camera = FitCamera({kWidth, kHeight}, robot.model, run.q(time),
                       run.ArrowAt(time), camera);
  }
  WritePicture(stem, {kWidth * static_cast<double>(times.size()), kHeight + 28},
               [&](Canvas* canvas) {
                 double x = 0;
                 for (const double time : times) {
                   DrawRobot({x, 0}, {kWidth, kHeight}, robot.model,
                             run.q(time), run.ArrowAt(time), camera, canvas);
                   canvas->Text({x + kWidth / 2, kHeight + 16},
                                Format("t = %.2f s", time), 11, kInk,
                                Anchor::kMiddle);
                   x += kWidth;
                 }
               });
}

void DrawPlots(const std::vector<PlotSpec>& plots, const fs::path& stem) {
  constexpr double kWidth = 440, kHeight = 260;
  WritePicture(stem, {kWidth * static_cast<double>(plots.size()), kHeight},
               [&](Canvas* canvas) {
                 double x = 0;
                 for (const PlotSpec& plot : plots) {
                   DrawPlot({x, 0}, {kWidth, kHeight}, plot, canvas);
                   x += kWidth;
                 }
               });
}

void DrawErrors(const RecordedRun& run, const fs::path& stem) {
  std::vector<PlotSpec> plots;
  for (const char axis : {'x', 'y'}) {
    PlotSpec plot;
    plot.title = std::string("CoM error in ") + axis + ", mm";
    plot.lines = {{"", axis == 'x' ? kBlue : kOrange, run[kTimeColumn],
                   run.ComError(axis)}};
    plot.band = run.Push();
    plot.least_extent = 4;
    plots.push_back(plot);
  }
  DrawPlots(plots, stem);
}

std::string Outcome(const RecordedRun& run) {
  Verdict verdict;
  verdict.recovered = run.recovered();
  const nlohmann::json& fell_at = run.summary()["fell_at"];
  if (fell_at.is_number()) verdict.fell_at = fell_at.get<double>();
  return Outcome(verdict);
}

// Draws three poses of a push: during the push, at the largest CoM error or
// during the fall, and at the end.
Figure PushPoses(const Robot& robot, const RecordedRun& run, int number,
                 const std::string& caption, const std::string& paper,
                 const fs::path& stem) {
  const auto push = *run.Push();
  const std::vector<double> error = run.ComError('y');
  const double middle = run.recovered() ? TimeOfLargest(run, error)
                                        : (push.second + run.end()) / 2;
  DrawPoses(robot, run,
            {(push.first + push.second) / 2, middle,
             run.recovered() ? std::min(run.end(), push.first + 3) : run.end()},
            stem);
  return {
      number, caption, paper,
      Format("Poses: during the push, %s, and at the end. The robot %s. "
             "Its pelvis tilts by up to %.2f rad, a foot that should stay "
             "flat by up to %.3f rad.%s",
             run.recovered() ? "at the largest CoM error" : "during the fall",
             Outcome(run).c_str(), Largest(run[kBaseTiltColumn]),
             run.summary()["foot_tilt_peak"].get<double>(),
             run.recovered() ? ""
                             : " The controller commands centers of "
                               "pressure outside the soles, so the feet "
                               "roll over their edges and leave the "
                               "ground.")};
}

Figure ErrorPlots(const RecordedRun& run, int number,
                  const std::string& caption, const std::string& paper,
                  const fs::path& stem) {
  DrawErrors(run, stem);
  const auto push = *run.Push();
  const std::vector<double> x = run.ComError('x'), y = run.ComError('y');
  std::string ours =
      Format("The error peaks at %.1f mm in y and %.1f mm in x. ", Largest(y),
             Largest(x));
  if (run.recovered()) {
    ours += Format(
        "In y the error stays below 5 mm from %.2f s after the push, and ends "
        "at %.2f mm.",
        SettledAfter(run, y, 5, push.second),
        1e3 * std::abs(run.summary()["com_error_final"][1].get<double>()));
  } else {
    ours += "The error diverges: the robot " + Outcome(run) +
            Format(
                ". The run ends at %.2f s, when the robot lies on the "
                "ground or is about to.",
                run.end());
  }
  return {number, caption, paper, ours};
}

// Returns the largest displacement of a joint between start and end of the run,
// rad, and the name of the joint.
std::pair<double, std::string> FarthestJoint(const Robot& robot,
                                             const RecordedRun& run) {
  const Eigen::VectorXd moved = (run.q(run.end()) - run.q(0))
                                    .tail(robot.model.tree.num_joints())
                                    .cwiseAbs();
  Eigen::Index joint;
  const double farthest = moved.maxCoeff(&joint);
  return {farthest, robot.model.tree.joints()[joint].name};
}

Figure ArmPoses(const Robot& robot, const RecordedRun& run, int number,
                const std::string& caption, const std::string& paper,
                const fs::path& stem) {
  DrawPoses(robot, run, {0, run.end() / 2, run.end()}, stem);
  const auto [angle, joint] = FarthestJoint(robot, run);
  return {number, caption, paper,
          Format("The robot is pushed with 20 N for 0.1 s. After %.0f s the "
                 "joint with the largest displacement, %s, has moved by %.2f "
                 "rad. Parts of the robot touched each other in %d ticks. The "
                 "CoM ends %.2f mm from its reference.",
                 run.end(), joint.c_str(), angle,
                 run.summary()["self_contact_ticks"].get<int>(),
                 1e3 * std::hypot(
                           run.summary()["com_error_final"][0].get<double>(),
                           run.summary()["com_error_final"][1].get<double>()))};
}

constexpr double kSettled = 3;  // The start transient is over, s.

// Returns the largest error after the start transient, mm.
double TrackingError(const RecordedRun& run, char axis) {
  const std::vector<double> error = run.ComError(axis);
  const auto settled = std::lower_bound(run[kTimeColumn].begin(),
                                        run[kTimeColumn].end(), kSettled) -
                       run[kTimeColumn].begin();
  return Largest({error.begin() + settled, error.end()});
}

Figure SinusoidPlots(const RecordedRun& run, const RecordedRun& feedforward,
                     const fs::path& stem) {
  std::vector<PlotSpec> plots;
  for (const char axis : {'x', 'y'}) {
    PlotSpec plot;
    plot.title = std::string("CoM in ") + axis + ", m";
    plot.lines = {{"reference", kGrey, run[kTimeColumn],
                   run[ComReferenceColumn(axis)], true},
                  {"CoM", axis == 'x' ? kBlue : kOrange, run[kTimeColumn],
                   run[ComColumn(axis)]}};
    plots.push_back(plot);
  }
  DrawPlots(plots, stem);
  return {
      5, "The CoM tracks a sinusoid",
      "The CoM tracks a sinusoidal reference in x and y, slightly behind "
      "by a constant offset.",
      Format(
          "After the start transient of %.0f s, the error stays within %.1f "
          "mm in x and %.1f mm in y, a constant lag. With feedforward of the "
          "reference's velocity and acceleration, the error stays within %.3f "
          "mm in x and %.3f mm in y.",
          kSettled, TrackingError(run, 'x'), TrackingError(run, 'y'),
          TrackingError(feedforward, 'x'), TrackingError(feedforward, 'y'))};
}

Figure ZmpPlots(const RecordedRun& run, const fs::path& stem) {
  std::vector<PlotSpec> plots;
  for (const char axis : {'x', 'y'}) {
    PlotSpec plot;
    plot.title = std::string("ZMP in ") + axis + ", m";
    plot.lines = {{"", axis == 'x' ? kBlue : kOrange, run[kTimeColumn],
                   run[CopColumn(axis)]}};
    if (axis == 'y') plot.limits = {{0.1, "limit"}, {-0.1, "limit"}};
    plot.band = run.Push();
    plot.least_extent = 0.02;
    plots.push_back(plot);
  }
  DrawPlots(plots, stem);
  const std::vector<double>& y = run[CopColumn('y')];
  const long at_limit = std::count_if(y.begin(), y.end(), [](double value) {
    return std::abs(value - 0.1) < 5e-4;
  });
  return {12, "The ZMP under its constraint",
          "The constraint becomes active where y reaches 0.1 m, its limit; "
          "then the robot recovers.",
          Format("The combined box |y| <= 0.1 m of (12) is on, and the push is "
                 "100 N for 0.12 s. The ZMP reaches %.4f m in y and stays "
                 "within 0.5 mm of the limit for %.0f ms. The robot %s.",
                 *std::max_element(y.begin(), y.end()),
                 1e3 * static_cast<double>(at_limit) *
                     run.summary()["control_dt"].get<double>(),
                 Outcome(run).c_str())};
}

}  // namespace

std::vector<FigureRun> MakeFigureRuns(const Robot& robot,
                                      const fs::path& scenarios) {
  std::vector<FigureRun> runs;
  for (const char* name : {"posture_off", "com_sinusoid", "weak_push",
                           "strong_push_without_zmp", "strong_push", "shove"}) {
    runs.push_back(
        {name,
         {robot, LoadScenario(scenarios / (std::string(name) + ".yaml"))}});
  }
  runs.push_back({"posture_on", runs[0].experiment});
  runs.back().experiment.scenario.control.without.clear();
  runs.push_back({"com_sinusoid_feedforward", runs[1].experiment});
  runs.back().experiment.scenario.control.feedforward = true;
  runs.push_back({"strong_push_zmp_box", runs[4].experiment});
  runs.back().experiment.scenario.control.with.push_back("zmp");
  runs.back().experiment.scenario.pushes.at(0).duration = 0.12;
  return runs;
}

std::vector<Figure> DrawFigures(const Robot& robot, const fs::path& runs,
                                const fs::path& pictures) {
  MakeFolder(pictures);
  const auto stem = [&](int number) {
    return pictures / Format("figure-%02d", number);
  };
  const auto load = [&](const char* name) {
    return RecordedRun(robot, runs / name);
  };
  std::vector<Figure> figures;
  figures.push_back(ArmPoses(
      robot, load("posture_off"), 3, "Movement in the null space",
      "Without the posture task the arms move about while all other tasks are "
      "fulfilled.",
      stem(3)));
  figures.push_back(ArmPoses(
      robot, load("posture_on"), 4, "PD control on the posture",
      "With the posture task the robot stays in its initial configuration.",
      stem(4)));
  figures.push_back(SinusoidPlots(load("com_sinusoid"),
                                  load("com_sinusoid_feedforward"), stem(5)));
  const RecordedRun weak = load("weak_push");
  figures.push_back(PushPoses(robot, weak, 6, "50 N along y",
                              "The robot immediately after the push.",
                              stem(6)));
  figures.push_back(ErrorPlots(
      weak, 7, "CoM error, 50 N along y",
      "A large error in y at the push, then a transient that converges to "
      "zero.",
      stem(7)));
  const RecordedRun without = load("strong_push_without_zmp");
  figures.push_back(PushPoses(
      robot, without, 8, "100 N along y, without the ZMP constraint",
      "The robot tries to keep its feet on the ground, cannot resist, and "
      "falls.",
      stem(8)));
  figures.push_back(ErrorPlots(without, 9,
                               "CoM error, 100 N along y, without the ZMP "
                               "constraint",
                               "The error diverges once the robot falls.",
                               stem(9)));
  const RecordedRun with = load("strong_push");
  figures.push_back(
      PushPoses(robot, with, 10, "100 N along y, with the ZMP constraint",
                "The robot after the push, once it has recovered.", stem(10)));
  figures.push_back(ErrorPlots(
      with, 11, "CoM error, 100 N along y, with the ZMP constraint",
      "A larger transient than in figure 7, which converges.", stem(11)));
  figures.push_back(ZmpPlots(load("strong_push_zmp_box"), stem(12)));
  return figures;
}

void WriteResults(const std::vector<Figure>& figures, const fs::path& markdown,
                  const std::string& pictures) {
  std::ostringstream stream;
  stream << "# The paper's results, and ours\n\n"
            "`bazel run //tools:figures` writes this page from new runs in "
            "Bullet. Numbers are the\nsimulator's true values, not the "
            "controller's estimates. The paper does not give the\nduration of "
            "its pushes. We push for 0.15 s, and for 0.12 s in figure 12. "
            "Figures 1 and 2 are\ndrawings of forces and friction cones. The "
            "largest push that the robot recovers from in each\ndirection is "
            "in [push_map.md](push_map.md).\n";
  for (const Figure& figure : figures) {
    stream << "\n## Figure " << figure.number << ": " << figure.caption
           << "\n\n![" << figure.caption << "](" << pictures << '/'
           << Format("figure-%02d.png", figure.number) << ")\n\n**The paper.** "
           << figure.paper << "\n\n**Ours.** " << figure.ours << " ([SVG]("
           << pictures << '/' << Format("figure-%02d.svg", figure.number)
           << "))\n";
  }
  WriteFile(markdown, stream.str());
}

}  // namespace poise

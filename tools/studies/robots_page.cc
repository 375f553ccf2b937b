// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/studies/robots_page.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "poise/robot/finding.h"
#include "poise/robot/output_file.h"
#include "poise/sim/observation.h"
#include "poise/sim/outcome.h"
#include "poise/tools/commands/format.h"
#include "poise/tools/drawing/robot_picture.h"

namespace poise {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kPictures = "figures/robots";

// Returns "35 mm" for a run that recovered, the largest horizontal error of the
// CoM, or else its outcome.
std::string Cell(const RunResult& run) {
  const Verdict& verdict = run.verdict;
  if (!verdict.recovered) return "**" + Outcome(verdict) + "**";
  if (!run.commanded_done.value_or(true)) return "**does not happen**";
  return Format("%.0f mm", 1e3 * verdict.com_error_peak.head<2>().norm());
}

std::string Joined(const std::vector<std::string>& texts) {
  std::string joined;
  for (const std::string& text : texts) {
    joined += (joined.empty() ? "" : "; ") + text;
  }
  return joined;
}

// Returns a text for a cell, in which a bar would end the cell.
std::string Escaped(std::string text) {
  std::replace(text.begin(), text.end(), '|', '/');
  return text;
}

Json RunToJson(const std::optional<RunResult>& run) {
  if (!run) return nullptr;
  const Verdict& verdict = run->verdict;
  Json json;
  json["recovered"] = verdict.recovered;
  json["outcome"] = Outcome(verdict);
  json["commanded_done"] =
      run->commanded_done ? Json(*run->commanded_done) : Json(nullptr);
  json["not_done"] = run->not_done;
  json["com_error_peak"] = verdict.com_error_peak;
  json["com_error_final"] = verdict.com_error_final;
  json["foot_tilt_peak"] = verdict.foot_tilt_peak;
  json["self_contact_ticks"] = run->self_contact_ticks;
  json["impulse_Ns"] = run->impulse_Ns;
  json["lipm_height_Ns"] =
      run->yardstick ? Json(run->yardstick->lipm_height_Ns) : Json(nullptr);
  return json;
}

// Draws a robot in its nominal posture, in the middle of the picture.
void DrawPicture(const Robot& robot, const std::filesystem::path& stem) {
  const Eigen::Vector2d size(90, 130);
  const double height = 2 * StandingHeight(robot);
  Camera camera;
  camera.eye *= height / 1.6;
  camera.target = {0, 0, 0.45 * height};
  camera.height = 0.9 * height;
  camera = FitCamera(size, robot.model, robot.q_nominal, {}, camera);
  WritePicture(stem, size, [&](Canvas* canvas) {
    DrawRobot({0, 0}, size, robot.model, robot.q_nominal, {}, camera, canvas);
  });
  // Only the PNG is small enough for a page with many robots.
  std::filesystem::remove(stem.string() + ".svg");
}

}  // namespace

std::string RobotsHead(bool pictures) {
  const std::string first = pictures ? "| | robot |" : "| robot |";
  return first +
         " soles from | stands | pushed forward, left, back, right | on "
         "one leg | as expected |\n" +
         (pictures ? "| --- " : "") + "| --- | --- | --- | --- | --- | --- |";
}

std::string RobotRow(const RobotTrial& trial, bool pictures) {
  std::string row = "| ";
  if (pictures) {
    row += trial.robot ? "![" + trial.name + "](" + kPictures + "/" +
                             trial.name + ".png) | "
                       : "| ";
  }
  const std::string kept =
      trial.faults.empty() ? "yes" : "**no**: " + Joined(trial.faults);
  row += trial.name + " | ";
  if (!trial.refused.empty()) {
    return row + "| refused: " + Escaped(trial.refused) + " | | | " +
           Escaped(kept) + " |";
  }
  row += trial.soles + " | " + Cell(*trial.stand);
  if (trial.stands()) {
    row += ", " +
           std::to_string(RobotTrial::kSeeds - trial.fallen_seeds.size()) +
           " of " + std::to_string(RobotTrial::kSeeds) + " seeds";
  }
  row += " | ";
  for (std::size_t i = 0; i < trial.pushes.size(); ++i) {
    row += (i == 0 ? "" : ", ") + Cell(trial.pushes[i]);
  }
  row += " | " + (trial.one_leg ? Cell(*trial.one_leg) : "");
  if (!trial.one_leg_obstacle.empty()) {
    row += " (" + Escaped(trial.one_leg_obstacle) + ")";
  }
  return row + " | " + Escaped(kept) + " |";
}

Json RobotsToJson(const std::vector<RobotTrial>& trials) {
  Json list = Json::array();
  std::size_t kept = 0;
  for (const RobotTrial& trial : trials) {
    kept += trial.faults.empty() ? 1 : 0;
    const bool is_refused = !trial.refused.empty();
    Json entry;
    entry["name"] = trial.name;
    entry["profile"] =
        trial.profile.empty() ? Json(nullptr) : Json(trial.profile);
    entry["refused"] = is_refused ? Json(trial.refused) : Json(nullptr);
    entry["soles"] = is_refused ? Json(nullptr) : Json(trial.soles);
    entry["forward"] = is_refused ? Json(nullptr) : Json(trial.forward);
    entry["stands"] = trial.stands();
    entry["stand"] = RunToJson(trial.stand);
    entry["stand_fallen_seeds"] = trial.fallen_seeds;
    entry["pushes"] = Json::array();
    for (std::size_t i = 0; i < trial.pushes.size(); ++i) {
      Json push = RunToJson(trial.pushes[i]);
      push["direction_deg"] = RobotTrial::kDirections[i];
      entry["pushes"].push_back(std::move(push));
    }
    entry["one_leg"] = RunToJson(trial.one_leg);
    entry["one_leg_obstacle"] = trial.one_leg_obstacle.empty()
                                    ? Json(nullptr)
                                    : Json(trial.one_leg_obstacle);
    entry["as_expected"] = trial.faults.empty();
    entry["faults"] = trial.faults;
    list.push_back(std::move(entry));
  }
  return {{"robots", list}, {"as_expected", kept}, {"of", trials.size()}};
}

void WriteRobotsPage(const std::vector<RobotTrial>& trials,
                     const std::filesystem::path& folder) {
  MakeFolder(folder / kPictures);
  for (const RobotTrial& trial : trials) {
    if (!trial.robot) continue;
    DrawPicture(*trial.robot, folder / kPictures / trial.name);
  }
  std::ostringstream page;
  page << "# Robots of others\n\nWritten by\n\n"
          "    bazel run //tools:robustness -- --robots DIR "
          "--package-path DIR/packages --out docs/generated\n\n"
          "for a folder of URDF files. The columns:\n\n"
          "- *soles from*: a `profile` gives them, or Poise finds them in a "
          "`box` or another simple shape, or in a `mesh`;\n  a `guess` is an "
          "estimate, because the foot has no such shape. A robot uses the "
          "profile of its name beside the\n  file, else one of "
          "`robot/profiles` that fits, else Poise finds the feet.\n"
          "- *stands*: the robot stands for 10 s, after a drop with disturbed "
          "arms and trunk; and for 1 s, with so\n  many of 6 seeds of the "
          "disturbance.\n"
          "- *pushed*: the torso is pushed for 0.1 s. The impulse is 40 % of "
          "`lipm_height_Ns`, from which an inverted\n  pendulum with the same "
          "mass, height and soles just recovers.\n"
          "- *on one leg*: the scenario `one_leg`. If the robot cannot do it, "
          "the reason is in brackets.\n"
          "- *as expected*: `EXPECTED.json` in the folder says what the robot "
          "must do. Some robots must fall or be refused.\n\n"
          "A length is the largest horizontal error of the center of mass in "
          "a run without a fall, rounded to 1 mm.\n\n";
  page << RobotsHead(true) << '\n';
  std::size_t kept = 0;
  for (const RobotTrial& trial : trials) {
    page << RobotRow(trial, true) << '\n';
    kept += trial.faults.empty() ? 1 : 0;
  }
  page << '\n' << kept << " of " << trials.size() << " robots as expected.\n";
  WriteFile(folder / "robots.md", page.str());
}

}  // namespace poise

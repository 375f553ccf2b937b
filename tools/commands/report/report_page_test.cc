// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/report/report_page.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "poise/robot/mesh/read_visuals.h"
#include "poise/robot/mesh/triangle_mesh.h"
#include "poise/robot/urdf/urdf.h"
#include "poise/tests/util/mesh_writer.h"
#include "poise/tests/util/test_file.h"
#include "poise/tools/commands/report/robot_json.h"
#include "poise/tools/viewer/pages.h"

namespace poise {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

fs::path EmptyFolder(const std::string& name) {
  const fs::path folder = fs::path(testing::TempDir()) / name;
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder;
}

void Write(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

std::string Read(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

// Returns the block of data in a page, as a browser finds it.
json DataOf(const std::string& page) {
  const std::string open = "id=\"data\">";
  const std::size_t start = page.find(open) + open.size();
  return json::parse(page.substr(start, page.find("</script", start) - start));
}

TEST(ReportPage, EscapesTextThatWouldEndTheBlockOfData) {
  const json document = {{"a", "</script><script>alert(1)</script>"},
                         {"b", "<!-- <script"},
                         {"c", "\"POISE-DATA\" $& $1"}};
  const std::string page = FillPage(kReportPage, document);
  EXPECT_EQ(DataOf(page), document);
  EXPECT_EQ(page.size(),
            kReportPage.size() - 12 +
                page.substr(page.find("id=\"data\">") + 10).find("</script>"));
}

TEST(ReportPage, ReplacesInvalidUtf8) {
  const std::string page = FillPage("\"POISE-DATA\"", json("a\xff z"));
  EXPECT_EQ(json::parse(page).get<std::string>().substr(0, 1), "a");
}

TEST(ReportPage, ShowsOneRun) {
  const fs::path run = EmptyFolder("run_alone");
  Write(run / "log.csv", "time[s],com.x[m]\n0,0.5\n0.002,0.5\n");
  Write(run / "timing.csv", "tick,us,iterations\n0,200,4\n1,210,4\n");
  Write(run / "summary.json",
        R"({"scenario": "stand", "recovered": true, "control_dt": 0.002})");
  Write(run / "robot.json", R"({"name": "bot"})");
  WriteReport({run}, run / "report.html");
  const json data = DataOf(Read(run / "report.html"));
  EXPECT_EQ(data["format"], "poise-report-1");
  ASSERT_EQ(data["runs"].size(), 1u);
  const json& shown = data["runs"][0];
  EXPECT_EQ(shown["name"], "run_alone");
  EXPECT_EQ(shown["summary"]["scenario"], "stand");
  EXPECT_EQ(shown["robot"]["name"], "bot");
  EXPECT_EQ(shown["log"]["rows"], 2);
  EXPECT_EQ(shown["timing"]["rows"], 2);
  EXPECT_TRUE(shown["notes"].empty());
}

// Returns a ball with 100 352 triangles of three vertices each, as in an STL
// file.
std::string DetailedBall() {
  constexpr int kRings = 224;
  const auto point = [](int i, int j) {
    const double polar = M_PI * i / kRings, around = 2 * M_PI * j / kRings;
    return Eigen::Vector3f(
        static_cast<float>(std::sin(polar) * std::cos(around)),
        static_cast<float>(std::sin(polar) * std::sin(around)),
        static_cast<float>(std::cos(polar)));
  };
  TriangleMesh mesh;
  for (int i = 0; i < kRings; ++i) {
    for (int j = 0; j < kRings; ++j) {
      const int first = static_cast<int>(mesh.vertices.size());
      for (const auto& [di, dj] : {std::pair(0, 0), std::pair(1, 0),
                                   std::pair(1, 1), std::pair(0, 1)}) {
        mesh.vertices.push_back(point(i + di, j + dj));
      }
      mesh.triangles.push_back({first, first + 1, first + 2});
      mesh.triangles.push_back({first, first + 2, first + 3});
    }
  }
  return BinaryStl(mesh);
}

// A robot has 40 links, each with a mesh of 100 000 triangles, and a run of
// 4 s has 400 columns. On a slow computer, some meshes are not drawn.
TEST(ReportPage, HasLessThanFiveMegabytesForDetailedMeshes) {
  constexpr int kLinks = 40;
  constexpr int kColumns = 400;
  constexpr int kTicks = 4000;
  TestFile("ball.stl", DetailedBall());
  std::string urdf = "<robot name='r'>";
  for (int i = 0; i < kLinks; ++i) {
    const std::string link = "l" + std::to_string(i);
    urdf += "<link name='" + link +
            "'><inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' "
            "iyy='1' iyz='0' izz='1'/></inertial><visual><geometry><mesh "
            "filename='ball.stl' scale='0.1 0.1 0.2'/></geometry></visual>"
            "</link>";
    if (i == 0) continue;
    urdf += "<joint name='j" + std::to_string(i) +
            "' type='continuous'><parent link='l" + std::to_string(i - 1) +
            "'/><child link='" + link + "'/></joint>";
  }
  RobotModel model = LoadUrdf(TestFile("robot.urdf", urdf + "</robot>"));
  EXPECT_LT(ReadVisuals(&model), kLinks);
  const json robot = MakeRobotJson({model, {}, {}});
  EXPECT_GE(robot["shapes"].size(), size_t{kLinks});
  const fs::path run = EmptyFolder("run_large");
  Write(run / "robot.json", robot.dump());
  std::string log = "time[s]";
  for (int i = 1; i < kColumns; ++i) {
    log += ",q.j" + std::to_string(i) + "[rad]";
  }
  std::vector<std::string> values;
  for (int i = 0; i < 997; ++i) values.push_back(std::to_string(std::sin(i)));
  for (int tick = 0; tick < kTicks; ++tick) {
    log += "\n" + std::to_string(1e-3 * tick);
    for (int i = 1; i < kColumns; ++i) {
      log += "," + values[(7 * tick + i) % values.size()];
    }
  }
  Write(run / "log.csv", log + "\n");
  WriteReport({run}, run / "report.html");
  EXPECT_LT(fs::file_size(run / "report.html"), 5'000'000u);
}

TEST(ReportPage, NotesMissingFiles) {
  const fs::path run = EmptyFolder("run_missing");
  Write(run / "log.csv", "time[s]\n");
  const json shown = ReadRun(run / "");
  EXPECT_EQ(shown["name"], "run_missing");
  EXPECT_TRUE(shown["summary"].is_null());
  EXPECT_TRUE(shown["robot"].is_null());
  EXPECT_TRUE(shown["timing"].is_null());
  EXPECT_EQ(shown["notes"],
            json({"log.csv has a header and no rows.",
                  "summary.json does not exist.", "robot.json is missing."}));
  const std::string name = run.string();
  EXPECT_EQ(
      WriteReport({run}, run / "report.html"),
      (std::vector<std::string>{name + ": log.csv has a header and no rows.",
                                name + ": summary.json does not exist.",
                                name + ": robot.json is missing."}));
}

TEST(ReportPage, IgnoresSummaryOfAnotherLog) {
  const fs::path run = EmptyFolder("run_cut");
  Write(run / "log.csv", "time[s]\n0\n");
  Write(run / "summary.json", R"({"recovered": true, "log_sha256": "other"})");
  const json shown = ReadRun(run);
  EXPECT_TRUE(shown["summary"].is_null());
  EXPECT_EQ(shown["notes"][0],
            "summary.json does not belong to this log.csv: its log_sha256 "
            "differs. The log is of another run, or was cut short or "
            "changed.");
}

TEST(ReportPage, ShowsTwoRuns) {
  const fs::path a = EmptyFolder("run_a"), b = EmptyFolder("run_b");
  for (const fs::path& run : {a, b}) Write(run / "log.csv", "time[s]\n0\n");
  const fs::path html = EmptyFolder("out") / "new" / "compare.html";
  WriteReport({a, b}, html);
  const json data = DataOf(Read(html));
  EXPECT_EQ(data["runs"][0]["name"], "run_a");
  EXPECT_EQ(data["runs"][1]["name"], "run_b");
}

TEST(ReportPage, NamesTheFileThatCannotBeReadOrWritten) {
  const auto error = [](const auto& act) -> std::string {
    try {
      act();
    } catch (const std::invalid_argument& thrown) {
      return thrown.what();
    }
    return "nothing thrown";
  };
  const fs::path run = EmptyFolder("run_broken");
  EXPECT_EQ(error([&] { ReadRun("no/such/run"); }),
            "no/such/run: does not exist, give the folder of a run, not its "
            "log");
  EXPECT_EQ(error([&] { ReadRun(run); }),
            (run / "log.csv").string() + ": cannot be opened");
  Write(run / "log.csv", "");
  EXPECT_EQ(
      error([&] { ReadRun(run); }),
      (run / "log.csv").string() +
          ": has no complete header, its run ended too early; run push again");
  Write(run / "log.csv", "time[s]\n0\n");
  Write(run / "robot.json", "{\"name\": \"bo");
  EXPECT_EQ(error([&] { ReadRun(run); }),
            (run / "robot.json").string() +
                ":1:12: is not JSON: a text has no closing quotation mark, or "
                "a character that JSON forbids; run push again, or remove this "
                "file to see the run without its robot");
  fs::remove(run / "robot.json");
  EXPECT_EQ(error([&] { WriteReport({run}, run); }),
            run.string() + ": cannot be written: Is a directory");
  EXPECT_EQ(error([&] { WriteReport({}, run / "a.html"); }),
            "a report must show one run or two, not 0");
  EXPECT_EQ(error([&] {
              WriteReport({run, run, run}, run / "a.html");
            }),
            "a report must show one run or two, not 3");
}

}  // namespace
}  // namespace poise

// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/tools/commands/dynamics/dynamics_table.h"

#include <algorithm>
#include <cstdio>
#include <vector>

namespace poise {
namespace {

using nlohmann::json;

std::string Number(double x) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.6g", x + 0.0);  // -0 + 0 is 0.
  return text;
}

// Returns how many columns UTF-8 text takes in a terminal. Each character takes
// one. The combining dot above takes none, as it is drawn on the letter before.
size_t WidthOf(const std::string& text) {
  size_t width = 0;
  for (size_t i = 0; i < text.size(); ++i) {
    const bool continues = (text[i] & 0xC0) == 0x80;
    if (!continues && text.compare(i, 2, "\u0307") != 0) ++width;
  }
  return width;
}

std::string Padding(size_t width, const std::string& text) {
  return std::string(width - std::min(width, WidthOf(text)), ' ');
}

// Rows of a name, a unit and cells, printed in aligned columns.
class Table {
 public:
  void AddTitles(const std::string& name, const std::string& unit,
                 std::vector<std::string> cells) {
    rows_.push_back({name, unit, std::move(cells)});
  }
  void Add(const std::string& name, const std::string& unit,
           const json& numbers) {
    std::vector<std::string> cells;
    for (const json& number : numbers) cells.push_back(Number(number));
    AddTitles(name, unit, std::move(cells));
  }
  void AddEmptyLine() { rows_.emplace_back(); }

  std::string ToText() const {
    size_t name_width = 0, unit_width = 0;
    for (const Row& row : rows_) {
      name_width = std::max(name_width, WidthOf(row.name));
      unit_width = std::max(unit_width, WidthOf(row.unit));
    }
    std::string text;
    for (const Row& row : rows_) {
      if (!row.name.empty()) {
        text += "  " + row.name + Padding(name_width, row.name) + "  " +
                row.unit + Padding(unit_width, row.unit);
        for (const std::string& cell : row.cells) {
          text += " " + Padding(kCellWidth, cell) + cell;
        }
        text.erase(text.find_last_not_of(' ') + 1);
      }
      text += "\n";
    }
    return text;
  }

 private:
  static constexpr size_t kCellWidth = 13;  // Length of -1.23457e-100.

  struct Row {
    std::string name, unit;
    std::vector<std::string> cells;
  };
  std::vector<Row> rows_;
};

// The name of an entry of v, and the units of its rate, force and inertia.
struct Freedom {
  std::string name;
  const char* rate;
  const char* force;
  const char* inertia;
};

std::vector<Freedom> FreedomsOf(const Tree& tree, const json& joints) {
  std::vector<Freedom> all;
  for (const char* name : {"base w_x", "base w_y", "base w_z"}) {
    all.push_back({name, "rad/s", "N m", "kg m2"});
  }
  for (const char* name : {"base v_x", "base v_y", "base v_z"}) {
    all.push_back({name, "m/s", "N", "kg"});
  }
  for (const json& joint : joints) {
    const std::string name = joint.get<std::string>();
    if (tree.joints()[*tree.FindJoint(name)].type == JointType::kPrismatic) {
      all.push_back({name, "m/s", "N", "kg"});
    } else {
      all.push_back({name, "rad/s", "N m", "kg m2"});
    }
  }
  return all;
}

// Adds each column of a matrix with six rows as a line.
void AddColumns(const std::vector<Freedom>& freedoms, const json& matrix,
                Table* table) {
  for (size_t j = 0; j < freedoms.size(); ++j) {
    json column = json::array();
    for (const json& row : matrix) column.push_back(row[j]);
    table->Add(freedoms[j].name, std::string("at 1 ") + freedoms[j].rate,
               column);
  }
}

}  // namespace

std::string FormatDynamics(const Tree& tree, const json& document) {
  const std::vector<Freedom> freedoms = FreedomsOf(tree, document["joints"]);
  std::string text = document["root_link"].get<std::string>() + ": " +
                     document["nv"].dump() + " degrees of freedom, " +
                     Number(document["total_mass"]) +
                     " kg. World axes; angular before linear.\n";
  int i = 0;
  for (const json& state : document["states"]) {
    Table table;
    table.Add("center of mass", "m", state["com"]);
    table.Add("  its velocity", "m/s", state["com_velocity"]);
    table.Add("momentum about it, h_G", "N m s, N s", state["h_G"]);
    table.Add("  its rate at v̇ = 0", "N m, N", state["AGdot_nu"]);
    table.AddEmptyLine();
    table.AddTitles("forces, inertia", "unit", {"tau", "N", "gravity", "M_jj"});
    for (size_t j = 0; j < freedoms.size(); ++j) {
      table.Add(freedoms[j].name,
                std::string(freedoms[j].force) + ", " + freedoms[j].inertia,
                json{state["tau_inverse_dynamics"][j], state["bias_h"][j],
                     state["gravity_g"][j], state["M"][j][j]});
    }
    table.AddEmptyLine();
    table.AddTitles("A_G", "N m s, N s",
                    {"h_x", "h_y", "h_z", "p_x", "p_y", "p_z"});
    AddColumns(freedoms, state["A_G"], &table);
    for (const auto& frame : state["frames"].items()) {
      table.AddEmptyLine();
      table.Add(frame.key(), "m", frame.value()["p"]);
      table.Add("  its J̇v", "rad/s2, m/s2", frame.value()["Jdot_nu"]);
      table.AddTitles("  its J", "rad/s, m/s",
                      {"w_x", "w_y", "w_z", "v_x", "v_y", "v_z"});
      AddColumns(freedoms, frame.value()["J"], &table);
    }
    text += "\nstate " + std::to_string(i++) + "\n" + table.ToText();
  }
  return text;
}

}  // namespace poise

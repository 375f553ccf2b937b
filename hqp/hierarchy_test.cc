// Copyright (c) 2026, the Poise authors. BSD-3-Clause, see LICENSE.
#include "poise/hqp/hierarchy.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

namespace poise {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(Hierarchy, ClearsTheRowsThatItAdds) {
  Hierarchy hierarchy(3, {{2, 2}});
  for (int round = 0; round < 2; ++round) {
    SCOPED_TRACE(round);
    hierarchy.Clear(1);
    EqualityBlock equalities = hierarchy.AddEqualities(0, 2);
    InequalityBlock inequalities = hierarchy.AddInequalities(0, 2);
    EXPECT_TRUE(equalities.B.isZero(0));
    EXPECT_TRUE(equalities.b.isZero(0));
    EXPECT_TRUE((equalities.weight.array() == 1).all());
    EXPECT_TRUE(inequalities.C.isZero(0));
    EXPECT_TRUE((inequalities.lower.array() == -kInfinity).all());
    EXPECT_TRUE((inequalities.upper.array() == kInfinity).all());
    equalities.B.setConstant(7);
    equalities.b.setConstant(7);
    equalities.weight.setConstant(7);
    inequalities.C.setConstant(7);
    inequalities.lower.setConstant(7);
    inequalities.upper.setConstant(7);
  }
}

// The solver reads them with vectors of four doubles.
TEST(Hierarchy, BeginsItsRowsAtACacheLine) {
  Hierarchy hierarchy(5, {{3, 2}});
  const std::vector<Hierarchy> all(20, hierarchy);
  for (const Hierarchy& each : all) {
    for (const double* rows : {each.B(0).data(), each.C(0).data()}) {
      EXPECT_EQ(reinterpret_cast<std::uintptr_t>(rows) % 64, 0u);
    }
  }
}

TEST(Hierarchy, CopiesHaveTheirOwnRows) {
  Hierarchy hierarchy(2, {{1, 1}});
  hierarchy.AddEqualities(0, 1).B << 1, 2;
  InequalityBlock inequalities = hierarchy.AddInequalities(0, 1);
  const Hierarchy copy = hierarchy;
  inequalities.C << 3, 4;
  EXPECT_EQ(copy.B(0), (RowMajorMatrix(1, 2) << 1, 2).finished());
  EXPECT_TRUE(copy.C(0).isZero(0));
}

TEST(Hierarchy, MayHaveRowsWithoutVariables) {
  Hierarchy hierarchy(0, {{2, 3}});
  hierarchy.AddEqualities(0, 2).b << 5, 6;
  hierarchy.AddInequalities(0, 3);
  hierarchy.FindSpans();
  EXPECT_EQ(hierarchy.B(0).rows(), 2);
  EXPECT_EQ(hierarchy.C(0).rows(), 3);
  EXPECT_EQ(hierarchy.b(0), Eigen::Vector2d(5, 6));
}

TEST(Hierarchy, KeepsBlocksInOrderAndLevelsApart) {
  Hierarchy hierarchy(2, {{3, 1}, {1, 3}});
  EXPECT_EQ(hierarchy.num_variables(), 2);
  EXPECT_EQ(hierarchy.num_levels(), 2);
  hierarchy.Clear(2);
  hierarchy.AddEqualities(0, 1).B << 1, 2;
  EqualityBlock second = hierarchy.AddEqualities(0, 2);
  second.B << 3, 4, 5, 6;
  second.b << -1, -2;
  second.weight << 10, 20;
  hierarchy.AddInequalities(1, 1).C << 7, 8;
  InequalityBlock last = hierarchy.AddInequalities(1, 2);
  last.C << 9, 10, 11, 12;
  last.lower << 1, 2;
  last.upper << 3, 4;

  EXPECT_EQ(hierarchy.num_equalities(0), 3);
  EXPECT_EQ(hierarchy.num_inequalities(0), 0);
  EXPECT_EQ(hierarchy.num_equalities(1), 0);
  EXPECT_EQ(hierarchy.num_inequalities(1), 3);
  EXPECT_EQ(hierarchy.B(0),
            (RowMajorMatrix(3, 2) << 1, 2, 3, 4, 5, 6).finished());
  EXPECT_EQ(hierarchy.b(0), Eigen::Vector3d(0, -1, -2));
  EXPECT_EQ(hierarchy.weight(0), Eigen::Vector3d(1, 10, 20));
  EXPECT_EQ(hierarchy.C(1),
            (RowMajorMatrix(3, 2) << 7, 8, 9, 10, 11, 12).finished());
  EXPECT_EQ(hierarchy.lower(1), Eigen::Vector3d(-kInfinity, 1, 2));
  EXPECT_EQ(hierarchy.upper(1), Eigen::Vector3d(kInfinity, 3, 4));

  hierarchy.Clear(1);
  EXPECT_EQ(hierarchy.num_levels(), 1);
  EXPECT_EQ(hierarchy.num_equalities(0), 0);
  EXPECT_EQ(hierarchy.num_inequalities(1), 0);
}

TEST(NumRows, SumsTheCapacitiesOfLevels) {
  const std::vector<LevelCapacity> capacity = {{2, 3}, {0, 0}, {0, 4}, {5, 0}};
  Hierarchy hierarchy(1, capacity);
  hierarchy.Clear(hierarchy.num_levels());
  Eigen::Index rows = 0;
  for (int level = 0; level < hierarchy.num_levels(); ++level) {
    rows += hierarchy.AddEqualities(level, capacity[level].equalities).b.size();
    rows += hierarchy.AddInequalities(level, capacity[level].inequalities)
                .upper.size();
  }
  EXPECT_EQ(NumRows(capacity), rows);
  EXPECT_EQ(NumRows(capacity), 14);
  EXPECT_EQ(NumRows({}), 0);
}

// Three levels of up to two rows of each kind share the memory of three rows,
// and may be filled in any order.
TEST(Hierarchy, LevelsShareMemory) {
  Hierarchy hierarchy(2, {{2, 2}, {2, 2}, {2, 2}}, {3, 3});
  const LevelCapacity rows[][3] = {{{1, 2}, {2, 1}}, {{0, 1}, {1, 0}, {2, 2}}};
  for (const auto& most : rows) {
    hierarchy.Clear(3, most);
    for (int level = 2; level >= 0; --level) {
      hierarchy.AddEqualities(level, most[level].equalities)
          .B.setConstant(level + 1);
      hierarchy.AddInequalities(level, most[level].inequalities)
          .C.setConstant(-level - 1);
    }
    for (int level = 0; level < 3; ++level) {
      EXPECT_EQ(hierarchy.B(level),
                RowMajorMatrix::Constant(most[level].equalities, 2, level + 1));
      EXPECT_EQ(
          hierarchy.C(level),
          RowMajorMatrix::Constant(most[level].inequalities, 2, -level - 1));
    }
  }
}

// Rows of 9 columns are nonzero in columns i to i + size - 1; entries amid them
// may be zero.
TEST(Hierarchy, FindsTheSpansOfRows) {
  constexpr int kColumns = 9;
  Hierarchy hierarchy(kColumns, {{kColumns, kColumns}});
  for (int size = 1; size <= kColumns; ++size) {
    SCOPED_TRACE(size);
    hierarchy.Clear(1);
    const int rows = kColumns - size + 1;
    EqualityBlock equalities = hierarchy.AddEqualities(0, rows);
    InequalityBlock inequalities = hierarchy.AddInequalities(0, rows);
    for (int i = 0; i < rows; ++i) {
      EXPECT_EQ(equalities.span[i].first, 0);
      EXPECT_EQ(equalities.span[i].size, kColumns);
      EXPECT_EQ(inequalities.span[i].first, 0);
      EXPECT_EQ(inequalities.span[i].size, kColumns);
      equalities.B(i, i) = -1e-300;
      equalities.B(i, i + size - 1) = NAN;
      inequalities.C(i, i) = kInfinity;
      inequalities.C(i, i + size - 1) = 2;
    }
    hierarchy.FindSpans();
    for (int i = 0; i < rows; ++i) {
      for (const Span span : {hierarchy.B_span(0)[i], hierarchy.C_span(0)[i]}) {
        EXPECT_EQ(span.first, i);
        EXPECT_EQ(span.size, size);
      }
    }
  }
}

TEST(Hierarchy, SetsRowsOfOneEntry) {
  Hierarchy hierarchy(3, {{1, 2}});
  hierarchy.AddEqualities(0, 1).SetSingle(0, 2, 5);
  hierarchy.AddInequalities(0, 2).SetSingle(1, 1, -4);
  hierarchy.FindSpans();
  EXPECT_EQ(hierarchy.B(0), (RowMajorMatrix(1, 3) << 0, 0, 5).finished());
  EXPECT_EQ(hierarchy.C(0),
            (RowMajorMatrix(2, 3) << 0, 0, 0, 0, -4, 0).finished());
  EXPECT_EQ(hierarchy.B_span(0)[0].first, 2);
  EXPECT_EQ(hierarchy.B_span(0)[0].size, 1);
  EXPECT_EQ(hierarchy.C_span(0)[0].size, 0);
  EXPECT_EQ(hierarchy.C_span(0)[1].first, 1);
  EXPECT_EQ(hierarchy.C_span(0)[1].size, 1);
}

TEST(Hierarchy, RejectsNegativeSizes) {
  EXPECT_THROW(Hierarchy(1, {{1, 1}}, {-1, 0}), std::invalid_argument);
  EXPECT_THROW(Hierarchy(-1, {}), std::invalid_argument);
  EXPECT_THROW(Hierarchy(1, {{-1, 0}}), std::invalid_argument);
  EXPECT_THROW(Hierarchy(1, {{0, -1}}), std::invalid_argument);
  EXPECT_NO_THROW(Hierarchy(0, {{0, 0}}));
}

}  // namespace
}  // namespace poise

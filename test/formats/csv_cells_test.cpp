// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/csv_cells.h"

#include <gtest/gtest.h>

namespace palpate::formats::csv_cells_test {
namespace {

using Cells = std::vector<std::string_view>;

TEST(CsvCells, AreOneMoreThanCommas) {
  EXPECT_EQ(csvCells(""), Cells({""}));
  EXPECT_EQ(csvCells("a"), Cells({"a"}));
  EXPECT_EQ(csvCells("a,b,,c"), Cells({"a", "b", "", "c"}));
  EXPECT_EQ(csvCells(","), Cells({"", ""}));
}

TEST(CsvCells, AreTrimmed) {
  EXPECT_EQ(csvCells(" t ,\tfx fy\t,  "), Cells({"t", "fx fy", ""}));
  EXPECT_EQ(trimmed(" \t "), "");
  EXPECT_EQ(trimmed("a b\r"), "a b\r");
}

}  // namespace
}  // namespace palpate::formats::csv_cells_test

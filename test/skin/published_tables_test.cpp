// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/skin/published_tables.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace palpate::skin::published_tables_test {
namespace {

TEST(PublishedTables, AreReproducedToTheLastPrintedDigit) {
  const std::vector<PublishedFigure> figures = publishedFigures();
  ASSERT_EQ(figures.size(), 576u);
  for (const PublishedFigure& f : figures) {
    EXPECT_TRUE(f.agrees()) << f.table << ", set " << f.set << ", " << f.upper_rows << " rows, "
                            << f.stiffness_ratio << ": " << f.printed << " printed, " << f.ours;
    EXPECT_NEAR(f.ours, f.printed, 0.6e-4 * std::max(f.printed, 0.01));
  }
}

// Figures that the source's text repeats, at their places in the tables.
TEST(PublishedTables, AreInTheirPlaces) {
  const struct {
    const char* table;
    int set, upper;
    double ratio, printed;
  } anchors[] = {
      {"3.3", 1, 1, 1, 0.098849},   {"3.3", 1, 3, 15, 0.006466},  {"3.4", 1, 3, 15, 0.006472},
      {"3.3", 1, 4, 31, 0.005814},  {"3.3", 1, 5, 127, 0.009017}, {"3.3", 2, 1, 1, 0.033983},
      {"3.3", 2, 2, 3, 0.007922},   {"3.3", 2, 4, 7, 0.006535},   {"3.4", 2, 4, 7, 0.006504},
      {"3.4", 2, 5, 13, 0.006938},  {"3.6", 1, 1, 1, 0.10413},    {"3.6", 1, 7, 15, 0.0055763},
      {"3.6", 1, 9, 31, 0.0052989}, {"3.6", 2, 8, 7, 0.0069613},  {"3.7", 2, 8, 7, 0.0078534},
      {"3.6", 2, 4, 3, 0.0098527}};
  const std::vector<PublishedFigure> figures = publishedFigures();
  for (const auto& a : anchors) {
    const auto found = std::find_if(figures.begin(), figures.end(), [&](const auto& f) {
      return f.table == a.table && f.set == a.set && f.upper_rows == a.upper &&
             f.stiffness_ratio == a.ratio;
    });
    ASSERT_NE(found, figures.end());
    EXPECT_EQ(found->printed, a.printed) << a.table << ", " << a.upper << ", " << a.ratio;
  }
}

TEST(PublishedTables, ADigitMoreOrLessDoesNotAgree) {
  const auto agrees = [](double printed, double ours, int decimals) {
    PublishedFigure figure{};
    figure.printed = printed;
    figure.ours = ours;
    figure.decimals = decimals;
    return figure.agrees();
  };
  EXPECT_TRUE(agrees(0.008461, 0.00846089, 6));
  EXPECT_FALSE(agrees(0.008461, 0.00846049, 6));
  EXPECT_FALSE(agrees(0.0084610, 0.00846089, 7));
  EXPECT_TRUE(agrees(0.10413, 0.104134, 7));
  EXPECT_FALSE(agrees(0.10413, 0.104136, 7));
  EXPECT_FALSE(agrees(0.0052989, 0.0052990, 7));
}

}  // namespace
}  // namespace palpate::skin::published_tables_test

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>

namespace palpate::test {

/// One figure of accuracy.md: what was computed, what is right, and how far off is allowed.
/// Numbers in SI; `error` and `bound` are parts of the reference (0.01: one per cent) unless the
/// quantity says otherwise.
struct AccuracyRow {
  std::string problem;   ///< "Prony relaxation": rows of the same problem make one table.
  std::string mesh;      ///< "8 x 8 x 8 cells, 3072 tetrahedra", "one element", ...
  std::string element;   ///< "anp", "tet4", ..., "" where no element is involved.
  std::string quantity;  ///< "force at t = 1 s [N]"
  double value = 0.0;
  double reference = 0.0;
  std::string source;  ///< "closed form: Ogden 1997, eq. 5.3.20"
  double error = 0.0;
  double bound = std::numeric_limits<double>::infinity();  ///< Infinite: shown, not checked.
};

/// |value - reference| / |reference|.
inline double relativeError(double value, double reference) {
  return std::abs(value - reference) / std::abs(reference);
}

/// The row as a line of JSON, numbers with all digits, null for one that is not finite.
inline std::string accuracyLine(const AccuracyRow& row) {
  std::ostringstream line;
  line.precision(std::numeric_limits<double>::max_digits10);
  const char* separator = "{";
  const auto key = [&](const char* name) -> std::ostream& {
    line << separator << '"' << name << "\": ";
    separator = ", ";
    return line;
  };
  const auto text = [&](const char* name, const std::string& value) {
    key(name) << '"';
    for (const char c : value) line << (c == '"' || c == '\\' ? "\\" : "") << c;
    line << '"';
  };
  const auto number = [&](const char* name, double value) {
    key(name);
    std::isfinite(value) ? line << value : line << "null";
  };
  text("case", row.problem);
  text("mesh", row.mesh);
  text("element", row.element);
  text("quantity", row.quantity);
  number("value", row.value);
  number("reference", row.reference);
  text("source", row.source);
  number("error", row.error);
  number("bound", row.bound);
  line << "}\n";
  return line.str();
}

/// Expects error <= bound and appends the row to the file that the environment variable
/// PALPATE_ACCURACY_OUT names, from which scripts/page.sh accuracy writes accuracy.md. Without the
/// variable it only checks.
inline void recordAccuracy(const AccuracyRow& row) {
  EXPECT_LE(row.error, row.bound) << row.problem << ", " << row.mesh << ", " << row.element << ", "
                                  << row.quantity << ": " << row.value << " instead of "
                                  << row.reference;
  const char* file = std::getenv("PALPATE_ACCURACY_OUT");
  if (file == nullptr || *file == '\0') return;
  std::ofstream out(file, std::ios::app);
  out << accuracyLine(row) << std::flush;
  EXPECT_TRUE(out.good()) << "cannot append to " << file;
}

}  // namespace palpate::test

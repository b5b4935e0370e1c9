// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <set>
#include <string>
#include <vector>

#include "palpate/torture/torture_run.h"

namespace palpate::torture {

/// Result of a scene as a row of a table; names and texts have no commas.
struct ResultLine {
  static const std::vector<std::string>& columns();

  std::vector<std::string> cells;  ///< One per columns().

  const std::string& cell(const std::string& column) const;
  double number(const std::string& column) const;  ///< 0 if absent.
};

/// "passed", "failed", "refused" (does not load) or "left" (stopped for time, without failure so
/// far); `commit` of the program, "-" if unknown.
ResultLine resultLine(const TortureScene& scene, const Outcome& outcome,
                      const std::string& commit = "-");

/// Result of a scene that crashed the program.
ResultLine crashLine(const TortureScene& scene, const std::string& commit = "-");

/// Appends a row to a table, which is created if missing.
/// @throws InputError
void appendResult(const std::string& file, const ResultLine& line);

/// Rows of all tables `results*.csv` in a folder, by number, without truncated ones. Of repeated
/// scenes the last row counts, tables in the order of their names: `results.csv` is from earlier
/// runs than `results_1_of_2.csv`.
/// @throws InputError if there is no such folder.
std::vector<ResultLine> readResults(const std::string& folder);

/// The rows as one table, in the format of readResults().
std::string resultTable(const std::vector<ResultLine>& lines);

/// Numbers of a seed with a row.
std::set<int> numbersDone(const std::vector<ResultLine>& lines, std::uint64_t seed);

/// Numbers of rows that neither passed nor were refused, and are of another commit than `commit`.
std::set<int> numbersAgain(const std::vector<ResultLine>& lines, std::uint64_t seed,
                           const std::string& commit);

}  // namespace palpate::torture

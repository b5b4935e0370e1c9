// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <set>
#include <string>
#include <vector>

#include "palpate/torture/torture_run.h"

namespace palpate::torture {

/// A scene that was run, as a line of a table: names and texts without commas.
struct ResultLine {
  static const std::vector<std::string>& columns();

  std::vector<std::string> cells;  ///< As many as columns().

  const std::string& cell(const std::string& column) const;
  double number(const std::string& column) const;  ///< 0 where none stands there.
};

/// "passed", "failed", "refused" (it does not load) or "left" (it took too long and met all
/// criteria as far as it came), and the commit of the program, "-" where that is not known.
ResultLine resultLine(const TortureScene& scene, const Outcome& outcome,
                      const std::string& commit = "-");

/// Of a scene in which the program ended.
ResultLine crashLine(const TortureScene& scene, const std::string& commit = "-");

/// Adds a line to a table, which is made if it is not there.
/// @throws InputError
void appendResult(const std::string& file, const ResultLine& line);

/// The lines of all tables `results*.csv` in a folder, by number; lines cut off are left out, and
/// of a scene that stands there twice the last one counts, of tables by their names' order:
/// `results.csv` is that of earlier runs, which `results_1_of_2.csv` has newer lines of.
/// @throws InputError if there is no such folder.
std::vector<ResultLine> readResults(const std::string& folder);

/// One table of them, as it is read.
std::string resultTable(const std::vector<ResultLine>& lines);

/// The numbers of a seed that have a line.
std::set<int> numbersDone(const std::vector<ResultLine>& lines, std::uint64_t seed);

/// The lines that did not pass, were not refused, and are not of `commit`: worth another look.
std::set<int> numbersAgain(const std::vector<ResultLine>& lines, std::uint64_t seed,
                           const std::string& commit);

}  // namespace palpate::torture

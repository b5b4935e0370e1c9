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
/// criteria as far as it came).
ResultLine resultLine(const TortureScene& scene, const Outcome& outcome);

/// Of a scene in which the program ended.
ResultLine crashLine(const TortureScene& scene);

/// Adds a line to a table, which is made if it is not there.
/// @throws InputError
void appendResult(const std::string& file, const ResultLine& line);

/// The lines of all tables `results*.csv` in a folder, by number; lines cut off are left out, and
/// of a scene that stands there twice the first one counts.
/// @throws InputError if there is no such folder.
std::vector<ResultLine> readResults(const std::string& folder);

/// The numbers of a seed that have a line.
std::set<int> numbersDone(const std::vector<ResultLine>& lines, std::uint64_t seed);

}  // namespace palpate::torture

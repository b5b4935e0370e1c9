// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace palpate::skin {

/// A figure of Tables 3.3, 3.4, 3.6 and 3.7 of P. I. Triantafyllopoulos, diploma thesis, National
/// Technical University of Athens, 2005, with this code's value.
struct PublishedFigure {
  std::string table;
  int set, columns, rows, upper_rows;
  double stiffness_ratio;
  double printed;  ///< ProfileErrors::published [mm]
  double ours;     ///< By the same protocol, unrounded [mm]
  int decimals;    ///< Largest number of printed decimals.

  /// Whether `ours` rounds to `printed`, with at most `decimals` decimals and five digits.
  bool agrees() const;
};

/// All 576 figures in the tables' order, by the published protocol.
std::vector<PublishedFigure> publishedFigures();

}  // namespace palpate::skin

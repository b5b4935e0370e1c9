// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace palpate::skin {

/// A figure of Tables 3.3, 3.4, 3.6 and 3.7 of P. I. Triantafyllopoulos, diploma thesis, National
/// Technical University of Athens, 2005, beside ours.
struct PublishedFigure {
  std::string table;
  int set, columns, rows, upper_rows;
  double stiffness_ratio;
  double printed;  ///< ProfileErrors::published [mm]
  double ours;     ///< By the same protocol, all its digits [mm]
  int decimals;    ///< At most so many are printed,

  /// and of them as many as make five significant ones: whether ours gives the same print.
  bool agrees() const;
};

/// All 576 in the tables' order, computed by the published protocol.
std::vector<PublishedFigure> publishedFigures();

}  // namespace palpate::skin

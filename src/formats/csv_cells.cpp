// SPDX-License-Identifier: GPL-3.0-or-later
#include "csv_cells.h"

#include <algorithm>

namespace palpate::formats {

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::vector<std::string_view> csvCells(std::string_view line) {
  std::vector<std::string_view> cells;
  std::size_t begin = 0;
  while (true) {
    const std::size_t comma = std::min(line.find(',', begin), line.size());
    cells.push_back(trimmed(line.substr(begin, comma - begin)));
    if (comma == line.size()) return cells;
    begin = comma + 1;
  }
}

}  // namespace palpate::formats

// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/springs/springs_file.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include "palpate/base/atomic_file.h"
#include "palpate/base/error.h"
#include "palpate/base/number.h"
#include "palpate/base/text_file.h"

namespace palpate::springs {
namespace {

constexpr std::string_view kPointColumns = "point,x,y,z,mass";
constexpr std::string_view kSpringColumns = "a,b,kind,stiffness,preload,length,damping";
constexpr std::size_t kMaxBytes = std::size_t{1} << 30;
constexpr std::size_t kMaxProblems = 20;  // limit of reported problems

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::vector<std::string_view> cellsOf(std::string_view line) {
  std::vector<std::string_view> cells;
  for (std::size_t begin = 0;;) {
    const std::size_t comma = std::min(line.find(',', begin), line.size());
    cells.push_back(trimmed(line.substr(begin, comma - begin)));
    if (comma == line.size()) return cells;
    begin = comma + 1;
  }
}

bool isHeader(const std::vector<std::string_view>& cells, std::string_view columns) {
  return cells == cellsOf(columns);
}

/// Reads a text line by line and collects rows and problems.
class Reader {
 public:
  void readLine(std::string_view line) {
    ++line_;
    const std::string_view text = trimmed(line);
    if (text.empty() || text[0] == '#' || problems_.size() >= kMaxProblems) return;
    cells_ = cellsOf(text);
    if (table_ == Table::kNone) {
      if (!isHeader(cells_, kPointColumns)) {
        problem("", text, "the first row must be " + std::string(kPointColumns));
      }
      table_ = Table::kPoints;
    } else if (table_ == Table::kPoints && isHeader(cells_, kSpringColumns)) {
      table_ = Table::kSprings;
    } else if (table_ == Table::kPoints) {
      readPoint();
    } else {
      readSpring();
    }
  }

  SpringNetwork finish(const std::string& file) {
    if (table_ == Table::kNone) {
      problems_.push_back({"", "", "must begin with a row " + std::string(kPointColumns)});
    } else if (table_ == Table::kPoints && problems_.empty()) {
      problems_.push_back({"", "", "has no row " + std::string(kSpringColumns)});
    }
    if (!problems_.empty()) throw InputError(file, problems_);
    const auto n = static_cast<Eigen::Index>(masses_.size());
    network_.points = Eigen::Map<const Points>(coordinates_.data(), 3, n);
    network_.masses = Eigen::Map<const Eigen::VectorXd>(masses_.data(), n);
    return network_;
  }

 private:
  enum class Table { kNone, kPoints, kSprings };

  void problem(const std::string& column, std::string_view value, const std::string& allowed) {
    const std::string shown(value.substr(0, 60));
    problems_.push_back({"line " + std::to_string(line_) + (column.empty() ? "" : ", " + column),
                         value.size() > 60 ? shown + "..." : shown, allowed});
  }

  bool hasCells(std::string_view columns) {
    const std::size_t wanted = cellsOf(columns).size();
    if (cells_.size() == wanted) return true;
    problem("", std::to_string(cells_.size()) + " values",
            "must have " + std::to_string(wanted) + ": " + std::string(columns));
    return false;
  }

  double number(const char* column, std::size_t cell) {
    const std::optional<double> x = parseNumber(cells_[cell]);
    if (!x) problem(column, cells_[cell], "must be a finite number");
    return x.value_or(1.0);
  }
  double positive(const char* column, std::size_t cell) {
    const double x = number(column, cell);
    if (!(x > 0.0)) problem(column, cells_[cell], "must be > 0");
    return x;
  }
  double notNegative(const char* column, std::size_t cell) {
    const double x = number(column, cell);
    if (!(x >= 0.0)) problem(column, cells_[cell], "must be >= 0");
    return x;
  }
  int point(const char* column, std::size_t cell) {
    const std::optional<double> x = parseNumber(cells_[cell]);
    const auto n = static_cast<double>(masses_.size());
    if (x && *x >= 0.0 && *x < n && *x == std::floor(*x)) return static_cast<int>(*x);
    problem(column, cells_[cell],
            "must be one of the " + std::to_string(masses_.size()) + " points, from 0 on");
    return -1;
  }

  void readPoint() {
    if (!hasCells(kPointColumns)) return;
    if (parseNumber(cells_[0]) != static_cast<double>(masses_.size())) {
      problem("point", cells_[0],
              "must be " + std::to_string(masses_.size()) + ", or the row be " +
                  std::string(kSpringColumns));
    }
    const char* columns[] = {"x", "y", "z"};
    for (std::size_t c = 0; c < 3; ++c) coordinates_.push_back(number(columns[c], c + 1));
    masses_.push_back(positive("mass", 4));
  }

  void readSpring() {
    if (!hasCells(kSpringColumns)) return;
    Spring s{point("a", 0),
             point("b", 1),
             notNegative("stiffness", 3),
             number("preload", 4),
             notNegative("damping", 6),
             positive("length", 5),
             SpringKind::kStructural};
    if (s.a >= 0 && s.a == s.b) problem("b", cells_[1], "must be another point than a");
    const std::optional<SpringKind> kind = springKindOf(cells_[2]);
    if (kind) {
      s.kind = *kind;
    } else {
      problem("kind", cells_[2], "must be one of " + joinNames(springKindNames()));
    }
    network_.springs.push_back(s);
  }

  int line_ = 0;
  Table table_ = Table::kNone;
  std::vector<std::string_view> cells_;
  std::vector<double> coordinates_, masses_;
  SpringNetwork network_;
  std::vector<Problem> problems_;
};

}  // namespace

void writeSprings(const std::string& file, const SpringNetwork& network) {
  checkNetwork(network);
  std::string text = std::string(kPointColumns) + "\n";
  for (Eigen::Index i = 0; i < network.points.cols(); ++i) {
    text += std::to_string(i);
    for (int c = 0; c < 3; ++c) text += "," + formatNumber(network.points(c, i));
    text += "," + formatNumber(network.masses[i]) + "\n";
  }
  text += std::string(kSpringColumns) + "\n";
  for (const Spring& s : network.springs) {
    text += std::to_string(s.a) + "," + std::to_string(s.b) + "," + std::string(toString(s.kind));
    for (const double value : {s.stiffness, s.preload, s.length, s.damping}) {
      text += "," + formatNumber(value);
    }
    text += "\n";
  }
  writeFileAtomically(file, text);
}

SpringNetwork readSprings(const std::string& file) {
  const std::string text = readTextFile(file, kMaxBytes);
  Reader reader;
  std::size_t begin = text.compare(0, 3, "\xEF\xBB\xBF") == 0 ? 3 : 0;  // byte order mark
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    reader.readLine(std::string_view(text).substr(begin, end - begin));
    begin = end + 1;
  }
  return reader.finish(file);
}

}  // namespace palpate::springs

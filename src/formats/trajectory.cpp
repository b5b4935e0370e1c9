// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/formats/trajectory.h"

#include <algorithm>
#include <optional>
#include <set>

#include "csv_cells.h"
#include "palpate/base/error.h"
#include "palpate/base/number.h"
#include "palpate/base/text_file.h"

namespace palpate::formats {
namespace {

constexpr std::size_t kMaxTableBytes = std::size_t{1} << 30;
constexpr std::size_t kMaxProblems = 20;  // limit of reported problems
constexpr std::size_t kMostColumns = 2000;

/// Reads a text line by line and collects rows and problems.
class TableReader {
 public:
  void readLine(std::string_view line) {
    ++line_number_;
    const std::string_view text = trimmed(line);
    if (text.empty() || text[0] == '#' || ended_ || problems_.size() >= kMaxProblems) return;
    if (header_.empty()) {
      readHeader(text);
    } else {
      readRow(text);
    }
  }

  Trajectory finish(const std::string& file) {
    if (header_.empty()) {
      problems_.push_back({"", "", "has no first row with `t` and the joints' names"});
    } else if (times_.empty() && problems_.empty()) {
      problems_.push_back({"", "", "has no rows of numbers"});
    }
    if (!problems_.empty()) throw InputError(file, problems_);
    const Eigen::Index joints = static_cast<Eigen::Index>(header_.size()) - 1;
    Trajectory trajectory;
    trajectory.columns.assign(header_.begin() + 1, header_.end());
    trajectory.values = Eigen::Map<const Eigen::MatrixXd>(values_.data(), joints,
                                                          static_cast<Eigen::Index>(times_.size()));
    trajectory.t = std::move(times_);
    return trajectory;
  }

 private:
  void problem(const std::string& where, std::string_view value, const std::string& allowed) {
    if (problems_.size() >= kMaxProblems) return;
    const std::string line = "line " + std::to_string(line_number_);
    const std::string shown(value.substr(0, 60));
    problems_.push_back({line + (where.empty() ? "" : ", " + where),
                         value.size() > 60 ? shown + "..." : shown, allowed});
  }

  void readHeader(std::string_view text) {
    const std::vector<std::string_view> cells = csvCells(text);
    if (cells.size() > kMostColumns) {
      header_.emplace_back("t");
      ended_ = true;
      problem("", std::to_string(cells.size()) + " columns",
              "must have at most " + std::to_string(kMostColumns));
      return;
    }
    header_.assign(cells.begin(), cells.end());
    if (header_[0] != "t") problem("column 1", header_[0], "the first column must be named t");
    std::set<std::string_view> names = {header_[0]};
    for (std::size_t i = 1; i < header_.size(); ++i) {
      if (header_[i].empty()) problem("column " + std::to_string(i + 1), "", "has no name");
      if (!names.insert(header_[i]).second) {
        problem("column " + std::to_string(i + 1), header_[i], "the name stands twice");
      }
    }
    if (header_.size() < 2) problem("", text, "must name at least one joint after t");
  }

  void readRow(std::string_view text) {
    const std::vector<std::string_view> row = csvCells(text);
    if (row.size() != header_.size()) {
      problem("", std::to_string(row.size()) + " values",
              "must have " + std::to_string(header_.size()) + " as the first row");
      return;
    }
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::optional<double> x = parseNumber(row[i]);
      if (!x) problem(header_[i], row[i], "must be a finite number");
      if (i > 0) values_.push_back(x.value_or(0.0));
      if (i == 0 && x) takeTime(*x, row[0]);
    }
  }

  void takeTime(double t, std::string_view text) {
    if (!times_.empty() && t <= times_.back()) {
      problem("t", text, "must be larger than in the row before");
    }
    times_.push_back(t);
  }

  int line_number_ = 0;
  bool ended_ = false;  // the rest cannot be read
  std::vector<std::string> header_;
  std::vector<double> times_, values_;
  std::vector<Problem> problems_;
};

}  // namespace

Trajectory readTrajectory(const std::string& file) {
  const std::string text = readTextFile(file, kMaxTableBytes);
  TableReader reader;
  std::size_t begin = text.compare(0, 3, "\xEF\xBB\xBF") == 0 ? 3 : 0;  // byte order mark
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const bool cr = end > begin && text[end - 1] == '\r';
    reader.readLine(std::string_view(text).substr(begin, end - begin - (cr ? 1 : 0)));
    begin = end + 1;
  }
  return reader.finish(file);
}

}  // namespace palpate::formats

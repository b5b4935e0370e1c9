// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/io/joint_columns.h"

#include <algorithm>
#include <cstddef>
#include <set>

#include "palpate/base/error.h"

namespace palpate::io {
namespace {

constexpr std::size_t kMaxProblems = 20;  // limit of reported problems

}  // namespace

std::vector<std::vector<int>> jointColumns(const formats::Trajectory& trajectory,
                                           const std::vector<InstrumentJoints>& instruments,
                                           const std::string& file) {
  const std::vector<std::string>& columns = trajectory.columns;
  std::vector<std::vector<int>> found;
  std::vector<Problem> problems;
  std::vector<std::string> wanted;
  std::set<int> used;
  const bool several = instruments.size() > 1;
  for (const InstrumentJoints& instrument : instruments) {
    found.emplace_back();
    for (const std::string& joint : instrument.joints) {
      const std::string full = instrument.instrument + "/" + joint;
      auto it = std::find(columns.begin(), columns.end(), full);
      if (it == columns.end() && !several) it = std::find(columns.begin(), columns.end(), joint);
      wanted.push_back(several ? full : joint);
      if (it == columns.end()) {
        problems.push_back({wanted.back(), "", "this joint has no column"});
      } else {
        found.back().push_back(static_cast<int>(it - columns.begin()));
        used.insert(found.back().back());
      }
    }
  }
  for (std::size_t c = 0; c < columns.size(); ++c) {
    if (used.count(static_cast<int>(c))) continue;
    if (problems.size() >= kMaxProblems) break;
    const std::string nearest = nearestName(columns[c], wanted);
    problems.push_back({"column " + columns[c], "",
                        "is no joint of the scene" +
                            (nearest.empty() ? "" : " (did you mean " + nearest + "?)") +
                            "; it has " + joinNames(wanted)});
  }
  if (!problems.empty()) throw InputError(file, problems);
  return found;
}

}  // namespace palpate::io

// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/instrument/joint_mapper.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "palpate/base/error.h"

namespace palpate::instrument {

JointMapper::JointMapper(std::vector<std::string> wanted) : wanted_(std::move(wanted)) {}

JointMapper::Status JointMapper::find(const std::vector<std::string>& names) {
  std::vector<std::size_t> source;
  std::vector<std::string> missing;
  for (const std::string& joint : wanted_) {
    const auto at = std::find(names.begin(), names.end(), joint);
    if (at == names.end()) {
      missing.push_back(joint);
    } else if (std::find(at + 1, names.end(), joint) != names.end()) {
      return {"joint '" + joint + "' is given more than once"};
    } else {
      source.push_back(static_cast<std::size_t>(at - names.begin()));
    }
  }
  if (!missing.empty()) {
    return {"no position for joint " + joinNames(missing) + "; given are: " + joinNames(names)};
  }
  source_ = std::move(source);
  names_ = names;
  return {};
}

JointMapper::Status JointMapper::map(const std::vector<std::string>& names, const double* positions,
                                     std::size_t n, Eigen::VectorXd* q) {
  if (n != names.size()) {
    return {std::to_string(names.size()) + " joint names, but " + std::to_string(n) + " positions"};
  }
  if (source_.size() != wanted_.size() || names != names_) {
    Status found = find(names);
    if (!found.ok()) return found;
  }
  for (std::size_t i = 0; i < wanted_.size(); ++i) {
    const double position = positions[source_[i]];
    if (!std::isfinite(position)) {
      return {"the position of joint '" + wanted_[i] + "' is " + std::to_string(position) +
              "; it must be finite"};
    }
  }
  q->resize(static_cast<Eigen::Index>(wanted_.size()));
  for (std::size_t i = 0; i < wanted_.size(); ++i) {
    (*q)[static_cast<Eigen::Index>(i)] = positions[source_[i]];
  }
  return {};
}

}  // namespace palpate::instrument

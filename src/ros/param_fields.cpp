// SPDX-License-Identifier: GPL-3.0-or-later
#include "param_fields.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "palpate/base/vector_text.h"

namespace palpate::node {

using keys::Field;
using keys::Range;
using XmlRpc::XmlRpcValue;

namespace {

// Of problems, and of the letters of what is wrong: a parameter may be a list of a million numbers.
constexpr std::size_t kMostProblems = 50, kMostLetters = 200;

std::string shortened(const std::string& text) {
  return text.size() <= kMostLetters ? text : text.substr(0, kMostLetters) + " ...";
}

std::string shown(const XmlRpcValue& value) {
  std::ostringstream s;
  value.write(s);
  return shortened(s.str());
}

}  // namespace

ParamFields::ParamFields(const ros::NodeHandle& handle) : handle_(handle) {}

void ParamFields::check() const {
  if (problems_.empty()) return;
  std::vector<Problem> problems = problems_;
  if (more_problems_ > 0) problems.push_back({"", "", std::to_string(more_problems_) + " more"});
  throw InputError("parameters of " + handle_.getNamespace(), problems);
}

void ParamFields::refuseOthers(const std::vector<std::string>& known) {
  const std::string prefix = handle_.getNamespace() + "/";
  std::vector<std::string> all;
  handle_.getParamNames(all);
  for (const std::string& name : all) {
    if (name.rfind(prefix, 0) != 0) continue;
    const std::string key = shortened(name.substr(prefix.size()));
    const bool is_known = std::any_of(known.begin(), known.end(), [&](const std::string& k) {
      return key == k || key.rfind(k + "/", 0) == 0;
    });
    if (is_known) continue;
    // Known are names of one part, and of two.
    const std::size_t first = key.find('/');
    std::string near = nearestName(key.substr(0, key.find('/', first + 1)), known);
    if (near.empty()) near = nearestName(key.substr(0, first), known);
    refuse(key, "",
           near.empty() ? "is unknown; known: " + joinNames(known)
                        : "is unknown; did you mean " + near + "?");
  }
}

void ParamFields::begin(const std::string& path) {
  XmlRpcValue section;
  if (handle_.getParam(path, section) && section.getType() != XmlRpcValue::TypeStruct) {
    refuse(path, shown(section), "must have keys below it");
  }
  open_ = {path};
  known_.clear();
}

// What is set below the section but was not visited is a mistyped key.
void ParamFields::end() {
  const std::string prefix = handle_.resolveName(open_.front()) + "/";
  std::vector<std::string> all;
  handle_.getParamNames(all);
  const std::vector<std::string> known(known_.begin(), known_.end());
  for (const std::string& name : all) {
    if (name.rfind(prefix, 0) != 0) continue;
    const std::string key = shortened(open_.front() + "/" + name.substr(prefix.size()));
    const bool visited = std::any_of(known.begin(), known.end(), [&](const std::string& k) {
      return key == k || key.rfind(k + "/", 0) == 0;
    });
    if (visited) continue;
    const std::string near = nearestName(key, known);
    refuse(key, "",
           near.empty() ? "is unknown; known: " + joinNames(known)
                        : "is unknown; did you mean " + near + "?");
  }
  open_.clear();
}

std::string ParamFields::path(const std::string& key) const {
  std::string p;
  for (const std::string& section : open_) p += section + "/";
  return p + key;
}

bool ParamFields::given(const std::string& key, XmlRpcValue* value) {
  known_.insert(path(key));
  return handle_.getParam(path(key), *value);
}

void ParamFields::refuse(const std::string& key, const std::string& value,
                         const std::string& allowed) {
  if (problems_.size() >= kMostProblems) {
    ++more_problems_;
    return;
  }
  problems_.push_back({key, shortened(value), allowed});
}

bool ParamFields::toNumber(const std::string& key, XmlRpcValue& value, const Range& range,
                           double* number) {
  const bool whole = value.getType() == XmlRpcValue::TypeInt;
  if (!whole && value.getType() != XmlRpcValue::TypeDouble) {
    refuse(path(key), shown(value), "must be a number");
    return false;
  }
  const double x = whole ? static_cast<int>(value) : static_cast<double>(value);
  if (!range.contains(x)) {
    refuse(path(key), shown(value), "must be " + range.text());
    return false;
  }
  *number = x;
  return true;
}

bool ParamFields::number(const Field& field, double& value, const Range& range) {
  XmlRpcValue v;
  if (!given(field.key, &v)) return false;
  toNumber(field.key, v, range, &value);
  return true;
}

bool ParamFields::integer(const Field& field, int& value, const Range& range) {
  XmlRpcValue v;
  if (!given(field.key, &v)) return false;
  double x = 0.0;
  if (v.getType() != XmlRpcValue::TypeInt) {
    refuse(path(field.key), shown(v), "must be a whole number");
  } else if (toNumber(field.key, v, range, &x)) {
    value = static_cast<int>(x);
  }
  return true;
}

bool ParamFields::flag(const Field& field, bool& value) {
  XmlRpcValue v;
  if (!given(field.key, &v)) return false;
  if (v.getType() == XmlRpcValue::TypeBoolean) {
    value = static_cast<bool>(v);
  } else {
    refuse(path(field.key), shown(v), "must be true or false");
  }
  return true;
}

bool ParamFields::text(const Field& field, std::string& value) {
  XmlRpcValue v;
  if (!given(field.key, &v)) return false;
  if (v.getType() == XmlRpcValue::TypeString) {
    value = static_cast<std::string>(v);
  } else {
    refuse(path(field.key), shown(v), "must be a text");
  }
  return true;
}

bool ParamFields::texts(const Field& field, std::vector<std::string>& values) {
  XmlRpcValue v;
  if (!given(field.key, &v)) return false;
  if (!handle_.getParam(path(field.key), values)) {
    refuse(path(field.key), shown(v), "must be a list of texts");
  }
  return true;
}

bool ParamFields::numbers(const Field& field, std::vector<double>& values) {
  XmlRpcValue v;
  if (!given(field.key, &v)) return false;
  std::vector<double> read;
  if (!handle_.getParam(path(field.key), read)) {
    refuse(path(field.key), shown(v), "must be a list of numbers");
  } else if (std::any_of(read.begin(), read.end(), [](double x) { return !std::isfinite(x); })) {
    refuse(path(field.key), shown(v), "must be finite");
  } else {
    values = read;
  }
  return true;
}

// A name is how things are found: it stays.
bool ParamFields::name(const Field&, std::string&) { return true; }

bool ParamFields::choice(const Field& field, std::string& value,
                         const std::vector<std::string>& allowed) {
  std::string chosen = value;
  if (!text(field, chosen)) return false;
  if (std::find(allowed.begin(), allowed.end(), chosen) == allowed.end()) {
    refuse(path(field.key), chosen, "must be one of " + joinNames(allowed));
  } else {
    value = chosen;
  }
  return true;
}

bool ParamFields::vector3(const Field& field, Vec3& value, const Range& range) {
  XmlRpcValue v;
  if (!given(field.key, &v)) return false;
  if (v.getType() != XmlRpcValue::TypeArray || v.size() != 3) {
    refuse(path(field.key), shown(v), "must be three numbers");
    return true;
  }
  Vec3 x;
  bool good = true;
  for (int i = 0; i < 3; ++i) good &= toNumber(field.key, v[i], range, &x[i]);
  if (good) value = x;
  return true;
}

bool ParamFields::integers3(const Field& field, Eigen::Vector3i& value, const Range& range) {
  Vec3 x = value.cast<double>();
  if (!vector3(field, x, range)) return false;
  if (x == x.array().round().matrix()) {
    value = x.cast<int>();
  } else {
    refuse(path(field.key), vectorText(x), "must be three whole numbers");
  }
  return true;
}

// These stand in lists of organs only, which parameters do not reach.
bool ParamFields::vectors3(const Field&, std::vector<Vec3>&, const Range&, int) { return false; }
bool ParamFields::partialVector3(const Field&, keys::PartialVec3&, const Range&) { return false; }
bool ParamFields::numbersOfKind(const std::string&, const std::vector<keys::Kind>&,
                                const std::string&, keys::NumberLists&) {
  return false;
}
int ParamFields::enterList(const Field&, int) { return 0; }
bool ParamFields::enterItem(const Field&, int) { return false; }

void ParamFields::rule(bool holds, const std::string& key, const std::string& text) {
  if (!holds) refuse(path(key), "", text);
}

keys::FieldVisitor::Entered ParamFields::enterSection(const Field& field) {
  const bool there = handle_.hasParam(path(field.key));
  open_.push_back(field.key);
  return {there, true};
}

keys::FieldVisitor::Entered ParamFields::enterNumberOrSection(const Field& field, double& value,
                                                              const Range& range) {
  XmlRpcValue v;
  if (!given(field.key, &v)) return {false, false};
  if (v.getType() == XmlRpcValue::TypeStruct) return enterSection(field);
  toNumber(field.key, v, range, &value);
  return {true, false};
}

void ParamFields::leaveSection() { open_.pop_back(); }
void ParamFields::beginAlternative(bool, const std::string&) {}
void ParamFields::endAlternative() {}

}  // namespace palpate::node

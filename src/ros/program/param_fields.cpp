// SPDX-License-Identifier: GPL-3.0-or-later
#include "param_fields.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <utility>

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

std::optional<double> numberIn(const XmlRpcValue& value) {
  if (value.getType() == XmlRpcValue::TypeInt) return static_cast<const int&>(value);
  if (value.getType() == XmlRpcValue::TypeDouble) return static_cast<const double&>(value);
  return {};
}

std::optional<std::string> textIn(const XmlRpcValue& value) {
  if (value.getType() != XmlRpcValue::TypeString) return {};
  return static_cast<const std::string&>(value);
}

// Each item, if it is a list of what `item` finds in all of them.
template <class T>
std::optional<std::vector<T>> listIn(const XmlRpcValue& value,
                                     std::optional<T> (*item)(const XmlRpcValue&)) {
  if (value.getType() != XmlRpcValue::TypeArray) return {};
  std::vector<T> items;
  for (int i = 0; i < value.size(); ++i) {
    std::optional<T> found = item(value[i]);
    if (!found) return {};
    items.push_back(std::move(*found));
  }
  return items;
}

}  // namespace

ParamFields::ParamFields(ParamTree params) : params_(std::move(params)) {}

void ParamFields::check() const {
  if (problems_.empty()) return;
  std::vector<Problem> problems = problems_;
  if (more_problems_ > 0) problems.push_back({"", "", std::to_string(more_problems_) + " more"});
  throw InputError("parameters of " + params_.name(), problems);
}

void ParamFields::refuseOthers(const std::vector<std::string>& known) {
  for (const std::string& name : params_.keys()) {
    const std::string key = shortened(name);
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
  const XmlRpcValue* section = params_.find(path);
  if (section && section->getType() != XmlRpcValue::TypeStruct) {
    refuse(path, shown(*section), "must have keys below it");
  }
  open_ = {path};
  known_.clear();
}

// What is set below the section but was not visited is a mistyped key.
void ParamFields::end() {
  const std::string prefix = open_.front() + "/";
  const std::vector<std::string> known(known_.begin(), known_.end());
  for (const std::string& name : params_.keys()) {
    if (name.rfind(prefix, 0) != 0) continue;
    const std::string key = shortened(name);
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

const XmlRpcValue* ParamFields::given(const std::string& key) {
  known_.insert(path(key));
  return params_.find(path(key));
}

void ParamFields::close(const std::string& key) {
  if (const XmlRpcValue* v = given(key)) {
    refuse(path(key), shown(*v), "cannot be a parameter: change it in the scene file");
  }
}

void ParamFields::refuse(const std::string& key, const std::string& value,
                         const std::string& allowed) {
  if (problems_.size() >= kMostProblems) {
    ++more_problems_;
    return;
  }
  problems_.push_back({key, shortened(value), allowed});
}

bool ParamFields::toNumber(const std::string& key, const XmlRpcValue& value, const Range& range,
                           double* number) {
  const std::optional<double> x = numberIn(value);
  if (!x) {
    refuse(path(key), shown(value), "must be a number");
    return false;
  }
  if (!range.contains(*x)) {
    refuse(path(key), shown(value), "must be " + range.text());
    return false;
  }
  *number = *x;
  return true;
}

bool ParamFields::number(const Field& field, double& value, const Range& range) {
  const XmlRpcValue* v = given(field.key);
  if (v) toNumber(field.key, *v, range, &value);
  return v != nullptr;
}

bool ParamFields::integer(const Field& field, int& value, const Range& range) {
  const XmlRpcValue* v = given(field.key);
  if (!v) return false;
  double x = 0.0;
  if (v->getType() != XmlRpcValue::TypeInt) {
    refuse(path(field.key), shown(*v), "must be a whole number");
  } else if (toNumber(field.key, *v, range, &x)) {
    value = static_cast<int>(x);
  }
  return true;
}

bool ParamFields::flag(const Field& field, bool& value) {
  const XmlRpcValue* v = given(field.key);
  if (!v) return false;
  if (v->getType() == XmlRpcValue::TypeBoolean) {
    value = static_cast<const bool&>(*v);
  } else {
    refuse(path(field.key), shown(*v), "must be true or false");
  }
  return true;
}

bool ParamFields::text(const Field& field, std::string& value) {
  const XmlRpcValue* v = given(field.key);
  if (!v) return false;
  if (const std::optional<std::string> text = textIn(*v)) {
    value = *text;
  } else {
    refuse(path(field.key), shown(*v), "must be a text");
  }
  return true;
}

bool ParamFields::texts(const Field& field, std::vector<std::string>& values) {
  const XmlRpcValue* v = given(field.key);
  if (!v) return false;
  if (const auto read = listIn(*v, textIn)) {
    values = *read;
  } else {
    refuse(path(field.key), shown(*v), "must be a list of texts");
  }
  return true;
}

bool ParamFields::numbers(const Field& field, std::vector<double>& values) {
  const XmlRpcValue* v = given(field.key);
  if (!v) return false;
  const auto read = listIn(*v, numberIn);
  if (!read) {
    refuse(path(field.key), shown(*v), "must be a list of numbers");
  } else if (std::any_of(read->begin(), read->end(), [](double x) { return !std::isfinite(x); })) {
    refuse(path(field.key), shown(*v), "must be finite");
  } else {
    values = *read;
  }
  return true;
}

// A name is how things are found: it stays.
bool ParamFields::name(const Field& field, std::string&) {
  close(field.key);
  return true;
}

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
  const XmlRpcValue* v = given(field.key);
  if (!v) return false;
  if (v->getType() != XmlRpcValue::TypeArray || v->size() != 3) {
    refuse(path(field.key), shown(*v), "must be three numbers");
    return true;
  }
  Vec3 x;
  bool good = true;
  for (int i = 0; i < 3; ++i) good &= toNumber(field.key, (*v)[i], range, &x[i]);
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

bool ParamFields::vectors3(const Field& field, std::vector<Vec3>&, const Range&, int) {
  close(field.key);
  return false;
}

bool ParamFields::partialVector3(const Field& field, keys::PartialVec3&, const Range&) {
  close(field.key);
  return false;
}

bool ParamFields::numbersOfKind(const std::string&, const std::vector<keys::Kind>& kinds,
                                const std::string&, keys::NumberLists&) {
  for (const keys::Kind& kind : kinds) {
    for (const std::string& key : kind.keys) close(key);
  }
  return false;
}

keys::FieldVisitor::Items ParamFields::enterList(const Field& field, int, int) {
  close(field.key);
  return {0, false};
}

bool ParamFields::enterItem(const Field&, int) { return false; }

void ParamFields::rule(bool holds, const std::string& key, const std::string& text) {
  if (!holds) refuse(path(key), "", text);
}

keys::FieldVisitor::Entered ParamFields::enterSection(const Field& field) {
  const XmlRpcValue* v = params_.find(path(field.key));
  if (v && v->getType() != XmlRpcValue::TypeStruct) {
    known_.insert(path(field.key));
    refuse(path(field.key), shown(*v), "must have keys below it");
  }
  open_.push_back(field.key);
  return {v != nullptr, true};
}

keys::FieldVisitor::Entered ParamFields::enterNumberOrSection(const Field& field, double& value,
                                                              const Range& range) {
  const XmlRpcValue* v = params_.find(path(field.key));
  if (v && v->getType() == XmlRpcValue::TypeStruct) return enterSection(field);
  known_.insert(path(field.key));
  if (v) toNumber(field.key, *v, range, &value);
  return {v != nullptr, false};
}

void ParamFields::leaveSection() { open_.pop_back(); }
void ParamFields::beginAlternative(bool, const std::string&) {}
void ParamFields::endAlternative() {}

}  // namespace palpate::node

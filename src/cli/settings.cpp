// SPDX-License-Identifier: GPL-3.0-or-later
#include "settings.h"

#include <algorithm>
#include <optional>
#include <set>

#include "palpate/base/error.h"
#include "palpate/base/number.h"
#include "palpate/scene/scene_fields.h"

namespace palpate::cli {
namespace {

// Walks over the fields as the scene reader does, but takes values from the command line.
class SettingsVisitor final : public keys::FieldVisitor {
 public:
  explicit SettingsVisitor(Settings given) : given_(std::move(given)) {}

  // The optional forms of the base class.
  using FieldVisitor::integer;
  using FieldVisitor::number;
  using FieldVisitor::vector3;

  bool number(const keys::Field& field, double& value, const keys::Range& range) override {
    const std::string* text = find(field);
    if (text) {
      const std::optional<double> parsed = parseNumber(*text);
      if (parsed && range.contains(*parsed)) {
        value = *parsed;
      } else {
        refuse(field, *text, "must be " + range.text());
      }
    }
    record(field, formatNumber(value));
    return text != nullptr;
  }
  bool integer(const keys::Field& field, int& value, const keys::Range& range) override {
    double number_value = value;
    const bool given = number(field, number_value, range);
    if (number_value != static_cast<int>(number_value)) {
      refuse(field, formatNumber(number_value), "must be a whole number");
    }
    value = static_cast<int>(number_value);
    return given;
  }
  bool flag(const keys::Field& field, bool& value) override {
    const std::string* text = find(field);
    if (text) {
      if (*text != "true" && *text != "false") refuse(field, *text, "must be true or false");
      value = *text == "true";
    }
    record(field, value ? "true" : "false");
    return text != nullptr;
  }
  bool text(const keys::Field& field, std::string& value) override {
    const std::string* given = find(field);
    if (given) value = *given;
    record(field, value);
    return given != nullptr;
  }
  bool name(const keys::Field& field, std::string& value) override { return text(field, value); }
  bool choice(const keys::Field& field, std::string& value,
              const std::vector<std::string>& allowed) override {
    const bool given = text(field, value);
    if (!std::count(allowed.begin(), allowed.end(), value)) {
      refuse(field, value, "must be one of " + joinNames(allowed));
    }
    return given;
  }
  // No section that is walked here has fields of these kinds.
  bool vector3(const keys::Field& field, Vec3&, const keys::Range&) override {
    return closed(field);
  }
  bool vectors3(const keys::Field& field, std::vector<Vec3>&, const keys::Range&, int) override {
    return closed(field);
  }
  bool integers3(const keys::Field& field, Eigen::Vector3i&, const keys::Range&) override {
    return closed(field);
  }
  bool partialVector3(const keys::Field& field, keys::PartialVec3&, const keys::Range&) override {
    return closed(field);
  }
  bool numbersOfKind(const std::string&, const std::vector<keys::Kind>&, const std::string&,
                     keys::NumberLists&) override {
    return false;
  }

  void rule(bool holds, const std::string& key, const std::string& text) override {
    if (!holds && hidden_ == 0) problems_.push_back({path(key), "", text});
  }

  /// @throws InputError if anything was wrong or is left over.
  void finish() {
    for (const auto& [key, value] : given_) {
      if (used_.count(key)) continue;
      const std::string nearest = nearestName(key, known_);
      problems_.push_back({key, value,
                           "is no key of a scene" +
                               (nearest.empty() ? "" : " (did you mean " + nearest + "?)") +
                               "; there are " + joinNames(known_)});
    }
    if (!problems_.empty()) throw InputError("command line", problems_);
  }
  const Settings& all() const { return all_; }

 protected:
  Entered enterSection(const keys::Field& field) override {
    const std::string below = path(field.key) + ".";
    sections_.push_back(field.key);
    const bool given = std::any_of(given_.begin(), given_.end(), [&](const auto& setting) {
      return setting.first.compare(0, below.size(), below) == 0;
    });
    return {given, true};
  }
  Entered enterNumberOrSection(const keys::Field& field, double& value,
                               const keys::Range& range) override {
    if (number(field, value, range)) return {true, false};
    return enterSection(field);
  }
  Items enterList(const keys::Field& field, int, int) override {
    closed(field);
    return {0, false};
  }
  bool enterItem(const keys::Field&, int) override { return false; }
  void leaveSection() override { sections_.pop_back(); }
  void beginAlternative(bool chosen, const std::string&) override {
    if (hidden_ > 0 || !chosen) ++hidden_;
  }
  void endAlternative() override {
    if (hidden_ > 0) --hidden_;
  }

 private:
  std::string path(const std::string& key) const {
    std::string whole;
    for (const std::string& section : sections_) whole += section + ".";
    return whole + key;
  }
  const std::string* find(const keys::Field& field) {
    if (hidden_ > 0) return nullptr;  // a key of another alternative
    const std::string key = path(field.key);
    known_.push_back(key);
    const std::string* last = nullptr;
    for (const auto& [name, value] : given_) {
      if (name == key) last = &value;
    }
    if (last) used_.insert(key);
    return last;
  }
  void record(const keys::Field& field, const std::string& value) {
    if (hidden_ == 0) all_.emplace_back(path(field.key), value);
  }
  void refuse(const keys::Field& field, const std::string& value, const std::string& allowed) {
    problems_.push_back({path(field.key), value, allowed});
  }
  bool closed(const keys::Field& field) {
    if (find(field)) refuse(field, "", "cannot be set on the command line");
    return false;
  }

  Settings given_, all_;
  std::vector<std::string> sections_, known_;
  std::set<std::string> used_;
  std::vector<Problem> problems_;
  int hidden_ = 0;  // depth of alternatives that are not chosen
};

Settings walk(const Settings& settings, scene::Scene* scene) {
  SettingsVisitor visitor(settings);
  visitor.section({"solver", "", ""}, scene->solver);
  visitor.section({"contact", "", ""}, scene->contact);
  visitor.finish();
  return visitor.all();
}

}  // namespace

void applySettings(const Settings& settings, scene::Scene* scene) { walk(settings, scene); }

Settings settingsOf(const scene::Scene& scene) {
  scene::Scene copy = scene;
  return walk({}, &copy);
}

}  // namespace palpate::cli

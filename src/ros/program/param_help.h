// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "palpate/keys/fields.h"

namespace palpate::node {

/// Writes the parameters that it visits as a table: name, default, unit, range and meaning. Has the
/// functions of ParamFields that visit, so one function can visit by either.
class ParamHelp : public keys::FieldVisitor {
 public:
  /// A line for each parameter visited. One whose rule its default breaks is "required".
  std::string table() const;

  /// Parameters directly below the node's name.
  template <class Config>
  void applyHere(Config& config) {
    describe(*this, config);
  }
  /// Parameters below ~<path>/.
  template <class Config>
  void apply(const std::string& path, Config& config) {
    open_.push_back(path);
    describe(*this, config);
    open_.pop_back();
  }
  bool texts(const keys::Field& field, std::vector<std::string>& values);
  bool numbers(const keys::Field& field, std::vector<double>& values);
  /// A parameter, or several, of which nothing but the meaning is said.
  void line(const std::string& name, const std::string& meaning);

  bool number(const keys::Field& field, double& value, const keys::Range& range) override;
  bool integer(const keys::Field& field, int& value, const keys::Range& range) override;
  bool flag(const keys::Field& field, bool& value) override;
  bool text(const keys::Field& field, std::string& value) override;
  bool name(const keys::Field& field, std::string& value) override;
  bool choice(const keys::Field& field, std::string& value,
              const std::vector<std::string>& allowed) override;
  bool vector3(const keys::Field& field, Vec3& value, const keys::Range& range) override;
  bool vectors3(const keys::Field& field, std::vector<Vec3>& values, const keys::Range& range,
                int min_size) override;
  bool integers3(const keys::Field& field, Eigen::Vector3i& value,
                 const keys::Range& range) override;
  bool partialVector3(const keys::Field& field, keys::PartialVec3& value,
                      const keys::Range& range) override;
  bool numbersOfKind(const std::string& choice, const std::vector<keys::Kind>& kinds,
                     const std::string& chosen, keys::NumberLists& values) override;
  void rule(bool holds, const std::string& key, const std::string& text) override;

 protected:
  Entered enterSection(const keys::Field& field) override;
  Entered enterNumberOrSection(const keys::Field& field, double& number,
                               const keys::Range& range) override;
  Items enterList(const keys::Field& field, int min_size, int present) override;
  bool enterItem(const keys::Field& field, int index) override;
  void leaveSection() override;
  void beginAlternative(bool chosen, const std::string& condition) override;
  void endAlternative() override;

 private:
  struct Row {
    std::string name, value, meaning;
  };
  std::string path(const std::string& key) const;
  void add(const keys::Field& field, const std::string& value, const std::string& allowed);

  std::vector<std::string> open_;  // sections that the visit is in
  std::vector<Row> rows_;
};

}  // namespace palpate::node

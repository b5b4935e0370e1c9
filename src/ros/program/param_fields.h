// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <set>
#include <string>
#include <vector>

#include "palpate/base/error.h"
#include "palpate/scene/scene_fields.h"
#include "param_tree.h"

namespace palpate::node {

/// Replaces fields of a scene by private parameters of the same name, checked by the same list of
/// keys that reads the file. A field without a parameter keeps its value. Lists of sections, of
/// points and of constants stand in files only: a parameter in their place is refused.
class ParamFields : public keys::FieldVisitor {
 public:
  explicit ParamFields(ParamTree params);
  explicit ParamFields(const ros::NodeHandle& handle) : ParamFields(ParamTree(handle)) {}

  /// The parameters below ~<path>/ go to `config`.
  template <class Config>
  void apply(const std::string& path, Config& config) {
    begin(path);
    describe(*this, config);
    end();
  }

  /// The parameters directly below the node's name go to `config`.
  template <class Config>
  void applyHere(Config& config) {
    open_.clear();
    known_.clear();
    describe(*this, config);
  }
  /// Lists of texts and of numbers, which no file has.
  bool texts(const keys::Field& field, std::vector<std::string>& values);
  bool numbers(const keys::Field& field, std::vector<double>& values);

  /// Refuses all parameters below the node's name that are none of `known`, names or sections of
  /// which each has been applied.
  void refuseOthers(const std::vector<std::string>& known);
  /// The same where known is what was visited since applyHere().
  void refuseOthers() { refuseOthers({known_.begin(), known_.end()}); }
  /// @throws InputError with everything that was wrong.
  void check() const;

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
  void begin(const std::string& path);
  void end();
  std::string path(const std::string& key) const;
  /// What ~<path>/<key> is set to, or nullptr; remembers that the key is known.
  const XmlRpc::XmlRpcValue* given(const std::string& key);
  /// Refuses what is set there.
  void close(const std::string& key);
  bool toNumber(const std::string& key, const XmlRpc::XmlRpcValue& value, const keys::Range& range,
                double* number);
  void refuse(const std::string& key, const std::string& value, const std::string& allowed);

  ParamTree params_;
  std::vector<std::string> open_;  // sections that we are in
  std::set<std::string> known_;
  std::vector<Problem> problems_;
  std::size_t more_problems_ = 0;  // than anybody reads
};

}  // namespace palpate::node

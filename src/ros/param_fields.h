// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ros/node_handle.h>

#include <set>
#include <string>
#include <vector>

#include "palpate/base/error.h"
#include "palpate/sim/scene_fields.h"

namespace palpate::node {

/// Replaces fields of a scene by private parameters of the same name, checked by the same list of
/// keys that reads the file.
class ParamFields : public sim::FieldVisitor {
 public:
  explicit ParamFields(const ros::NodeHandle& handle);

  /// The parameters below ~<path>/ go to `config`.
  template <class Config>
  void apply(const std::string& path, Config& config) {
    begin(path);
    describe(*this, config);
    end();
  }

  /// @throws InputError with everything that was wrong.
  void check() const;

  bool number(const sim::Field& field, double& value, const sim::Range& range) override;
  bool integer(const sim::Field& field, int& value, const sim::Range& range) override;
  bool flag(const sim::Field& field, bool& value) override;
  bool text(const sim::Field& field, std::string& value) override;
  bool name(const sim::Field& field, std::string& value) override;
  bool choice(const sim::Field& field, std::string& value,
              const std::vector<std::string>& allowed) override;
  bool vector3(const sim::Field& field, Vec3& value, const sim::Range& range) override;
  bool integers3(const sim::Field& field, Eigen::Vector3i& value, const sim::Range& range) override;
  bool partialVector3(const sim::Field& field, sim::PartialVec3& value,
                      const sim::Range& range) override;
  void materialConstants(const std::string& law, material::Constants& constants) override;
  void rule(bool holds, const std::string& key, const std::string& text) override;

 protected:
  Entered enterSection(const sim::Field& field) override;
  int enterList(const sim::Field& field, int min_size) override;
  bool enterItem(const sim::Field& field, int index) override;
  void leaveSection() override;
  void beginAlternative(bool chosen, const std::string& condition) override;
  void endAlternative() override;

 private:
  void begin(const std::string& path);
  void end();
  std::string path(const std::string& key) const;
  /// Whether ~<path>/<key> is set; remembers that the key is known.
  bool given(const std::string& key, XmlRpc::XmlRpcValue* value);
  bool toNumber(const std::string& key, XmlRpc::XmlRpcValue& value, const sim::Range& range,
                double* number);
  void refuse(const std::string& key, const std::string& value, const std::string& allowed);

  ros::NodeHandle handle_;
  std::vector<std::string> open_;  // sections that we are in
  std::set<std::string> known_;
  std::vector<Problem> problems_;
};

}  // namespace palpate::node

// SPDX-License-Identifier: GPL-3.0-or-later
#include "urdf_model.h"

#include <console_bridge/console.h>
#include <urdf_parser/urdf_parser.h>

#include <exception>
#include <mutex>

#include "palpate/base/error.h"

namespace palpate::instrument {
namespace {

/// Captures urdfdom's error messages.
class Collector : public console_bridge::OutputHandler {
 public:
  void log(const std::string& message, console_bridge::LogLevel level, const char*, int) override {
    if (level < console_bridge::CONSOLE_BRIDGE_LOG_ERROR) return;
    text_ += (text_.empty() ? "" : "; ") + message;
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// Replaces console_bridge's process-wide handler by a collector, under a lock.
class Listening {
 public:
  explicit Listening(Collector* collector) : lock_(mutex()) {
    console_bridge::useOutputHandler(collector);
  }
  ~Listening() { console_bridge::restorePreviousOutputHandler(); }
  Listening(const Listening&) = delete;
  Listening& operator=(const Listening&) = delete;

 private:
  static std::mutex& mutex() {
    static std::mutex one;
    return one;
  }
  std::lock_guard<std::mutex> lock_;
};

/// Whether the model is complete: urdfdom keeps partial links after errors.
bool isWhole(const urdf::ModelInterface& model, const UrdfOutline& outline) {
  if (model.links_.size() != outline.links.size()) return false;
  if (model.joints_.size() != outline.joints.size()) return false;
  for (std::size_t i = 0; i < outline.links.size(); ++i) {
    const auto link = model.getLink(outline.links[i]);
    if (!link) return false;
    if (link->visual_array.size() + link->collision_array.size() != outline.shapes[i]) return false;
  }
  return true;
}

/// urdfdom and the outline may read names that are no valid UTF-8 differently.
/// @throws InputError for a joint that has another name in the model, or joins others.
void refuseJointsReadOtherwise(const std::string& file, const urdf::ModelInterface& model,
                               const UrdfOutline& outline) {
  for (const JointOutline& of : outline.joints) {
    const auto joint = model.getJoint(of.name);
    if (joint && joint->parent_link_name == of.parent && joint->child_link_name == of.child) {
      continue;
    }
    throw InputError(file, of.where, "", "is read as another joint; names must be UTF-8");
  }
}

}  // namespace

ParsedUrdf parseUrdf(const std::string& file, const UrdfOutline& outline) {
  Collector collector;
  urdf::ModelInterfaceSharedPtr model;
  try {
    const Listening listening(&collector);
    model = urdf::parseURDF(outline.xml);
  } catch (const std::exception& error) {
    throw InputError(file, "", "", std::string("is not a valid URDF: ") + error.what());
  }
  if (!model || !isWhole(*model, outline)) {
    throw InputError(file, "", "", "is not a valid URDF: " + collector.text());
  }
  refuseJointsReadOtherwise(file, *model, outline);
  for (auto& [name, link] : model->links_) link->inertial.reset();
  return {model, collector.text()};
}

}  // namespace palpate::instrument

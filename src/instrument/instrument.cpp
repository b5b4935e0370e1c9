// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/instrument/instrument.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "collision_shapes.h"
#include "kinematics.h"
#include "palpate/base/error.h"
#include "palpate/base/text_file.h"
#include "urdf_model.h"
#include "urdf_outline.h"

namespace palpate::instrument {

struct Instrument::Impl {
  std::string name;
  Kinematics kinematics;
  std::vector<CollisionBody> bodies;
  std::vector<std::string> warnings, notes;
};

Instrument::Instrument(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Instrument::~Instrument() = default;
Instrument::Instrument(Instrument&&) noexcept = default;
Instrument& Instrument::operator=(Instrument&&) noexcept = default;

const std::string& Instrument::name() const { return impl_->name; }
const std::vector<Joint>& Instrument::joints() const { return impl_->kinematics.joints; }
const std::vector<std::string>& Instrument::linkNames() const { return impl_->kinematics.links; }
const std::vector<CollisionBody>& Instrument::bodies() const { return impl_->bodies; }
const std::vector<std::string>& Instrument::warnings() const { return impl_->warnings; }
const std::vector<std::string>& Instrument::notes() const { return impl_->notes; }

std::vector<std::string> Instrument::jointNames() const {
  std::vector<std::string> names;
  for (const Joint& joint : joints()) names.push_back(joint.name);
  return names;
}

int Instrument::linkIndex(const std::string& link) const {
  const auto& links = linkNames();
  const auto at = std::find(links.begin(), links.end(), link);
  return at == links.end() ? -1 : static_cast<int>(at - links.begin());
}

void Instrument::linkPoses(const Eigen::VectorXd& q, std::vector<Pose>* X_BL) const {
  if (q.size() != static_cast<Eigen::Index>(joints().size())) {
    throw std::invalid_argument(name() + " has " + std::to_string(joints().size()) +
                                " joints, not " + std::to_string(q.size()));
  }
  const std::vector<Segment>& segments = impl_->kinematics.segments;
  X_BL->resize(segments.size());
  for (std::size_t i = 0; i < segments.size(); ++i) {
    const Pose X_PL = segmentPose(segments[i], q);
    const int parent = segments[i].parent;
    (*X_BL)[i] = parent < 0 ? X_PL : (*X_BL)[static_cast<std::size_t>(parent)] * X_PL;
  }
}

Instrument readInstrument(const std::string& urdf_file, const InstrumentOptions& options) {
  const std::string text = readTextFile(urdf_file, kMaxUrdfBytes);
  UrdfOutline outline = readOutline(urdf_file, text);
  checkTopology(&outline);
  if (!outline.problems.empty()) throw InputError(urdf_file, outline.problems);

  const ParsedUrdf parsed = parseUrdf(urdf_file, outline);
  auto impl = std::make_unique<Instrument::Impl>();
  impl->name = outline.robot;
  try {
    impl->kinematics = buildKinematics(*parsed.model, outline);
  } catch (const std::invalid_argument& error) {
    throw InputError(urdf_file, "robot " + outline.robot, "", error.what());
  }
  Shapes shapes = readShapes(*parsed.model, impl->kinematics.links,
                             std::filesystem::path(urdf_file).parent_path().string(), options);
  if (!shapes.problems.empty()) throw InputError(urdf_file, shapes.problems);
  impl->bodies = std::move(shapes.bodies);
  impl->warnings = std::move(shapes.warnings);
  impl->notes = std::move(shapes.notes);
  if (!parsed.complaints.empty()) impl->warnings.push_back("urdfdom: " + parsed.complaints);
  return Instrument(std::move(impl));
}

}  // namespace palpate::instrument

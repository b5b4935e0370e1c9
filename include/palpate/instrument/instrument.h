// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "palpate/base/types.h"
#include "palpate/instrument/geometry.h"
#include "palpate/instrument/mesh_shape.h"

namespace palpate::instrument {

/// Conversion of URDF shapes to collision bodies.
struct InstrumentOptions {
  bool cylinder_as_capsule = true;  ///< Replace cylinders by capsules of the same total length.
  MeshShapeSettings collision_meshes;
  ShapeProgress progress;  ///< Progress of sampling non-convex meshes; may be empty.
};

/// A driven joint: revolute, prismatic or continuous, neither fixed nor mimic.
struct Joint {
  std::string name;
  bool prismatic = false;  ///< Whether positions are in [m]; else in [rad].
  double lower, upper;     ///< Limits [m or rad]; -inf, +inf for a continuous joint.
};

/// Rigid links on joints, from a URDF. Immutable after loading; const calls are thread-safe.
class Instrument {
 public:
  ~Instrument();
  Instrument(Instrument&&) noexcept;
  Instrument& operator=(Instrument&&) noexcept;

  const std::string& name() const;
  /// Joints of the input, in depth-first order from the root.
  const std::vector<Joint>& joints() const;
  std::vector<std::string> jointNames() const;
  /// Links in depth-first order; the root is link 0.
  const std::vector<std::string>& linkNames() const;
  /// Index of `link`, or -1.
  int linkIndex(const std::string& link) const;
  const std::vector<CollisionBody>& bodies() const;
  /// Harmless irregularities of loading, for example a missing visual mesh.
  const std::vector<std::string>& warnings() const;
  /// Decisions of loading: the sampling of meshes.
  const std::vector<std::string>& notes() const;

  /// Forward kinematics: `X_BL->at(i)` maps link i to the root link B, for positions `q` of
  /// joints() [m or rad]. Mimic joints follow. Does not allocate if `X_BL` has the right size.
  void linkPoses(const Eigen::VectorXd& q, std::vector<Pose>* X_BL) const;

 private:
  friend Instrument readInstrument(const std::string&, const InstrumentOptions&);
  struct Impl;
  explicit Instrument(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// Reads a URDF file. Mesh URIs may be package://, file:// or relative to the file.
/// @throws InputError: missing file, no XML, a joint loop, a mimic of an unknown joint, an
/// unsupported joint type, a collision mesh that is missing, empty, or neither convex nor closed.
Instrument readInstrument(const std::string& urdf_file, const InstrumentOptions& options = {});

}  // namespace palpate::instrument

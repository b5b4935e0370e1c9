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

/// How URDF shapes become collision bodies.
struct InstrumentOptions {
  bool cylinder_as_capsule = true;  ///< A capsule of the same total length; else exact.
  MeshShapeSettings collision_meshes;
  ShapeProgress progress;  ///< Of sampling meshes that are not convex; may be empty.
};

/// A joint that the input drives (revolute, prismatic, continuous; not fixed, not mimic).
struct Joint {
  std::string name;
  bool prismatic = false;  ///< Positions in [m]; else [rad].
  double lower, upper;     ///< Limits [m or rad]; -inf, +inf for a continuous joint.
};

/// Rigid links on joints, from a URDF. Immutable after loading; const calls are thread-safe.
class Instrument {
 public:
  ~Instrument();
  Instrument(Instrument&&) noexcept;
  Instrument& operator=(Instrument&&) noexcept;

  const std::string& name() const;
  /// Joints that the input must give, in the URDF's order (depth first from the root).
  const std::vector<Joint>& joints() const;
  std::vector<std::string> jointNames() const;
  /// Links in depth-first order; the root is link 0.
  const std::vector<std::string>& linkNames() const;
  /// Index of `link`, or -1.
  int linkIndex(const std::string& link) const;
  const std::vector<CollisionBody>& bodies() const;
  /// What was odd but not wrong while loading (a missing visual mesh, ...).
  const std::vector<std::string>& warnings() const;
  /// What was decided while loading: how meshes are sampled.
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
/// @throws InputError: file missing, not XML, a joint loop, a mimic of an unknown joint, a joint
/// type that is not supported, a collision mesh that is missing or empty, or neither convex nor
/// closed.
Instrument readInstrument(const std::string& urdf_file, const InstrumentOptions& options = {});

}  // namespace palpate::instrument

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <string>

#include "palpate/mesh/tet_mesh.h"
#include "palpate/scene/body_config.h"

namespace palpate::scene {

/// Directions of tetrahedra: the same everywhere, or from the mesh's cell data. The mesh must
/// outlive it.
class FibreFrames {
 public:
  /// `file` and `key`: where the fibres stand, for messages.
  /// @throws InputError for cell data that the mesh does not have, or not with three components.
  FibreFrames(const FibreConfig& fibres, const mesh::TetMesh& mesh, const std::string& file,
              const std::string& key);

  /// Fibre, sheet and their cross product as columns: unit, orthogonal, right-handed, in the mesh's
  /// frame. The sheet is the given one's part across the fibre; without any, that of the axis
  /// which is the least along the fibre.
  /// @throws InputError for a direction that is zero or not finite, or a sheet along the fibre.
  Mat3 frame(Eigen::Index tet) const;

 private:
  const Eigen::MatrixXd* find(const mesh::TetMesh& mesh, const std::string& key,
                              const std::string& name) const;
  [[noreturn]] void fail(const std::string& key, Eigen::Index tet, const Vec3& value,
                         const std::string& allowed) const;

  FibreConfig config_;
  const Eigen::MatrixXd* field_ = nullptr;        // 3 x m
  const Eigen::MatrixXd* sheet_field_ = nullptr;  // 3 x m
  std::string file_, key_;
};

}  // namespace palpate::scene

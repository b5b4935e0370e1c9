// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <string>

#include "palpate/mesh/tet_mesh.h"
#include "palpate/scene/body_config.h"

namespace palpate::scene {

/// Directions of tetrahedra, uniform or from cell data. @pre The mesh outlives this.
class FibreFrames {
 public:
  /// `file` and `key`: position of the fibres, for messages.
  /// @throws InputError for missing cell data, or without three components.
  FibreFrames(const FibreConfig& fibres, const mesh::TetMesh& mesh, const std::string& file,
              const std::string& key);

  /// Right-handed orthonormal columns in the mesh's frame: fibre, sheet, their cross product. The
  /// sheet is projected normal to the fibre; without sheet, the coordinate axis with the least
  /// component along the fibre is.
  /// @throws InputError for a zero or non-finite direction, or a sheet parallel to the fibre.
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

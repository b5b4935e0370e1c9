// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "palpate/base/types.h"
#include "palpate/scene/surroundings_config.h"
#include "palpate/tissue/surroundings.h"

namespace palpate::scene {

/// A support, and where it is on a mesh.
struct SelectedSupport {
  const SupportConfig& config;
  std::vector<int> nodes;                ///< Selected, ascending.
  Points points;                         ///< Of the whole mesh, world, 3 x n [m].
  Eigen::MatrixXi faces;                 ///< Boundary faces with all corners selected.
  double young_modulus;                  ///< Of the organ's material at small strain [Pa].
  std::optional<tissue::Motion> motion;  ///< World.
};

/// A kind of support: what it adds to an organ's surroundings.
struct SupportKind {
  const char* name;
  bool on_faces;  ///< It needs a face.
  void (*add)(const SelectedSupport& place, tissue::Surroundings* surroundings);
};
/// `name`: one of supportKindNames().
const SupportKind& supportKind(const std::string& name);

/// Stiffness [Pa/m] of a slide that hardly gives way: of an organ of this modulus [Pa] and size
/// [m].
double slideStiffness(double young_modulus, double size);

}  // namespace palpate::scene

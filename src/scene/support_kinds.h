// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "palpate/base/types.h"
#include "palpate/scene/surroundings_config.h"
#include "palpate/tissue/surroundings.h"

namespace palpate::scene {

/// A support with its nodes and faces on a mesh.
struct SelectedSupport {
  const SupportConfig& config;
  std::vector<int> nodes;                ///< Selected, ascending.
  Points points;                         ///< Of the whole mesh, world, 3 x n [m].
  Eigen::MatrixXi faces;                 ///< Boundary faces with all corners selected.
  double young_modulus;                  ///< Of the organ's material at small strain [Pa].
  std::optional<tissue::Motion> motion;  ///< World.
};

/// A kind of support, with the function that adds it to an organ's boundary conditions.
struct SupportKind {
  const char* name;
  bool on_faces;  ///< Whether it needs faces.
  void (*add)(const SelectedSupport& place, tissue::Surroundings* surroundings);
};
/// `name`: one of supportKindNames().
const SupportKind& supportKind(const std::string& name);

/// Stiffness [Pa/m] of a nearly rigid slide, for an organ of this modulus [Pa] and size [m].
double slideStiffness(double young_modulus, double size);

}  // namespace palpate::scene

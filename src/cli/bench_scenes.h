// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "palpate/scene/scene.h"

namespace palpate::cli {

/// What may be asked of a scene; what is left open is the scene's own choice.
struct BenchChoice {
  std::optional<int> tets;            ///< About so many; scenes that are boxes only.
  std::optional<double> edge_length;  ///< [m]; scenes that are meshed from a surface, or graded.
  std::optional<double> finest;       ///< Edges where the tool goes [m]: a graded mesh.
  std::optional<double> adapt;        ///< Edges where the tool is [m]: meshes that follow it.
  std::optional<double> growth;       ///< What both grow by for each metre farther away.
  std::optional<double> poisson_ratio;
  std::optional<std::string> element;
};

/// A scene in memory, ready for sim::Simulator, and what is done in it.
struct BenchCase {
  scene::Scene scene;
  double duration = 0.5;  ///< [s]
  /// Joint positions of instrument 0 at a time [s]; empty where there is none.
  std::function<Eigen::VectorXd(double)> joints;
  Vec3 start_velocity = Vec3::Zero();  ///< Of all nodes that are not held [m/s].
};

/// A scene of `palpate bench`. `make` writes meshes and the tool into `folder`, to which paths in
/// the scene are relative. @throws InputError for a choice that the scene does not have.
struct BenchScene {
  const char* name;
  const char* what;  ///< One line for the list.
  int small_tets;    ///< For --small; 0: as it is.
  BenchCase (*make)(const BenchChoice& choice, const std::string& folder);
};

const std::vector<BenchScene>& benchScenes();

/// @throws InputError for an unknown name, with the nearest known one.
const BenchScene& benchScene(const std::string& name);

}  // namespace palpate::cli

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <visualization_msgs/MarkerArray.h>

#include <memory>
#include <vector>

#include "cutaway_config.h"
#include "palpate/mesh/cutaway.h"
#include "palpate/sim/simulator.h"
#include "ros/messages/channels.h"

namespace palpate::node {

/// Builds the MarkerArray of organs that are cut open, in world:
///  - namespace "cut", id = organ: what is left, a TRIANGLE_LIST with the colour of each solid,
///    where it is cut lighter than outside, as light from above makes it;
///  - namespace "nodes", id = organ: the points of its mesh where it was taken away (SPHERE_LIST).
/// What is taken away is fixed in the organ at rest and deforms with it. It is found when an organ
/// has become another mesh; else vertices are put in place, and nothing is allocated.
class CutawayMarkers {
 public:
  CutawayMarkers(const sim::Simulator& simulator, const CutawayConfig& config);

  /// Of organs whose picture has no cells nothing is changed.
  const visualization_msgs::MarkerArray& update(const Picture& picture);

 private:
  struct Organ {
    Pose X_OW;
    std_msgs::ColorRGBA colour;  // of its first solid
    bool placed = false;
    mesh::CutBox box;  // in its frame
    std::shared_ptr<const mesh::CellMesh> cells;
    mesh::Cutaway cut;
    std::vector<std_msgs::ColorRGBA> colours;  // of the cut's triangles, before light
    Points vertices;
  };
  void cut(std::size_t organ);
  void updateOrgan(const SurfacePicture& picture, std::size_t organ);

  CutawayConfig config_;
  std::vector<Organ> organs_;
  visualization_msgs::MarkerArray message_;  // cuts, nodes
};

}  // namespace palpate::node

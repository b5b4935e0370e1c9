// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "palpate/enrichment/pressed_body.h"
#include "palpate/enrichment/surrogate_file.h"
#include "palpate/enrichment/surrogate_training.h"
#include "palpate/mesh/used_points.h"
#include "support/temp_folder.h"

namespace palpate::test {

/// What was learned of presses of a box from the origin that is held at its bottom, around the
/// middle of its top; a file as long as the object lives.
class LearnedBox {
 public:
  static constexpr double kPatch = 0.012;  ///< [m]

  /// `force`: the largest [N]; `around`: half the side of the square that is pressed [m].
  LearnedBox(const Vec3& size, const Eigen::Vector3i& cells, const material::Material& law,
             double force, double around) {
    const mesh::TetMesh mesh = mesh::boxMesh(size, cells);
    fem::FreeMask free = fem::FreeMask::Ones(3, mesh.numPoints());
    for (Eigen::Index i = 0; i < mesh.numPoints(); ++i) {
      if (mesh.points(2, i) == 0.0) free.col(i).setZero();
    }
    enrichment::DeformationDatabase database;
    database.coarse = database.fine =
        mesh::onlyUsedPoints({mesh.points, mesh::trianglesOf(mesh::boundaryFaces(mesh))});
    database.made_by = "a box, patch 0.012 m, ";
    const Points& X = database.fine.points;
    enrichment::PressedBody body(fem::elementNames().front(), mesh,
                                 fem::Composition::uniform(law, 1060.0), free, X, kPatch, nullptr);
    solver::StaticSettings settings;
    const Vec3 middle(0.5 * size.x(), 0.5 * size.y(), size.z());
    for (Eigen::Index i = 0; i < X.cols(); ++i) {
      if ((X.col(i) - middle).cwiseAbs().maxCoeff() > around) continue;
      for (const Vec3& way : {Vec3(0, 0, -1), Vec3(0.3, 0, -0.9), Vec3(0, -0.3, -0.9)}) {
        for (const double part : {0.3, 1.0}) {
          enrichment::Deformation sample;
          sample.contact = static_cast<int>(i);
          sample.force = part * force * way;
          body.press({X.col(i), sample.force}, settings, &sample.fine);
          database.samples.push_back(sample);
        }
      }
    }
    enrichment::TrainingSettings training;
    training.held_out = 0.0;
    training.modes = 8;
    enrichment::writeSurrogate(file(), enrichment::trainSurrogate(database, training));
  }
  std::string file() const { return folder_.path("box.net"); }

 private:
  TempFolder folder_;
};

/// Of the slab of SlabScene, less deep than that is pressed.
inline LearnedBox learnedSlab() {
  return {Vec3(0.1, 0.1, 0.04), Eigen::Vector3i(6, 6, 3),
          material::makeMaterial("stable_neo_hookean",
                                 {{"young_modulus", {6.0e3}}, {"poisson_ratio", {0.45}}}),
          0.15, 0.018};
}

}  // namespace palpate::test

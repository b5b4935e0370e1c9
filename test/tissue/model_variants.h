// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "palpate/tissue/honeycomb/honeycomb_settings.h"
#include "palpate/tissue/springs/spring_settings.h"
#include "support/learned_box.h"
#include "two_organs.h"

namespace palpate::test {

/// A tissue model that is no finite elements, in one of its ways to go on.
struct ModelVariant {
  std::string name, model;
  tissue::SpringSettings springs;
  tissue::SamplingSettings sampling;
  double back = 1e-5;  ///< So near to rest it comes again [m].
  tissue::HoneycombSettings honeycomb = {};
  bool has_inertia = true;  ///< It can fly.
  tissue::HybridSettings hybrid = {};
  double stiffness_damping = 0.002;  ///< [s]
  tissue::EnrichedSettings enriched = {};
  std::string learned = {};  ///< File of model neural.

  /// Whether its sums are exact, for nothing is solved for.
  bool isExplicit() const {
    return (model == "mass_spring" || model == "cloth") && springs.scheme != "implicit";
  }
};

inline void PrintTo(const ModelVariant& variant, std::ostream* out) { *out << variant.name; }

inline ModelVariant springVariant(const std::string& name, const std::string& scheme,
                                  double step = 0.0, double region = 0.0) {
  ModelVariant variant{name, "mass_spring", {}, {}};
  variant.springs.scheme = scheme;
  variant.springs.step = step;
  variant.springs.region = region;
  return variant;
}

/// What it learned of the block covers a visit, or its beginning.
inline ModelVariant neuralVariant(bool covers) {
  const auto learn = [](double force) {
    return LearnedBox(Vec3(0.06, 0.06, 0.03), Eigen::Vector3i(6, 6, 3), kLiver, force, 0.011);
  };
  static const LearnedBox much = learn(0.8), little = learn(0.1);
  ModelVariant variant{covers ? "neural" : "neural_and_elements", "neural", {}, {}};
  variant.has_inertia = false;
  variant.learned = (covers ? much : little).file();
  return variant;
}

inline std::vector<ModelVariant> modelVariants() {
  std::vector<ModelVariant> all;
  for (const std::string& scheme : tissue::springSchemeNames()) {
    all.push_back(springVariant("springs_" + scheme, scheme));
  }
  all.push_back(springVariant("springs_region", "symplectic_euler", 0.0, 0.03));
  for (const char* scheme : {"implicit", "symplectic_euler"}) {
    all.push_back({std::string("cloth_") + scheme, "cloth", {}, {}});
    all.back().springs.scheme = scheme;
  }
  all.push_back({"tensor_mass", "tensor_mass", {}, {}});
  all.push_back({"sampled", "sampled_elasticity", {}, {}});
  // What it parted it joins only where that makes less than this of a difference.
  all.back().back = all.back().sampling.coarsen_below;
  for (const std::string& volume : tissue::honeycombVolumeNames()) {
    ModelVariant cells{"honeycomb_" + volume, "honeycomb", {}, {}};
    cells.honeycomb.volume = volume;
    cells.has_inertia = false;
    all.push_back(cells);
  }
  all.push_back({"bem", "bem", {}, {}});
  all.back().has_inertia = false;
  ModelVariant hybrid{"hybrid", "hybrid", {}, {}};
  hybrid.hybrid.region = mesh::SphereRegion{Vec3(0.02, 0.03, 0.03), 0.02};
  hybrid.stiffness_damping = 0.0;
  all.push_back(hybrid);
  for (const char* detail : {"residual", "displacement", "none"}) {
    all.push_back({std::string("enriched_") + detail, "enriched", {}, {}});
    all.back().enriched.detail = detail;
  }
  all.push_back(neuralVariant(true));
  all.push_back(neuralVariant(false));
  return all;
}

/// A sheet of rubber, 60 x 62 x 1 mm, in the place of a block's top, held at its edges.
inline OrganSketch sheetSketch(bool held = true) {
  OrganSketch organ;
  organ.name = "sheet";
  organ.cloth.thickness = 0.001;
  organ.cloth.width = 0.06;
  organ.cloth.length = 0.062;
  organ.cloth.spacing = 0.006;
  organ.solid.law =
      material::makeMaterial("neo_hookean", {{"young_modulus", {1e6}}, {"poisson_ratio", {0.3}}});
  organ.X_WO.translation().z() = 0.03;
  organ.damping = {20.0, 1e-5};
  organ.held = [held](const Vec3& X) {
    return held && (X.x() < 0.004 || X.x() > 0.059 || X.y() < 1e-6 || X.y() > 0.061);
  };
  return organ;
}

/// A block 60 x 60 x 30 mm that is held at its bottom, or not at all; of model cloth its top.
inline OrganSketch variantBlock(const ModelVariant& variant, bool held = true) {
  if (variant.model == "cloth") {
    OrganSketch sheet = sheetSketch(held);
    sheet.springs = variant.springs;
    return sheet;
  }
  OrganSketch organ = block("block", Vec3::Zero(), Vec3(0.06, 0.06, 0.03), Eigen::Vector3i(6, 6, 3),
                            [held](const Vec3& X) { return held && X.z() <= 0.0; });
  organ.damping = {10.0, variant.stiffness_damping};
  organ.springs = variant.springs;
  organ.sampling = variant.sampling;
  organ.honeycomb = variant.honeycomb;
  organ.hybrid = variant.hybrid;
  organ.enriched = variant.enriched;
  organ.neural.file = variant.learned;
  return organ;
}

inline tissue::ModelSettings variantSettings() {
  tissue::ModelSettings settings;
  settings.gravity = Vec3(0.0, 0.0, -9.81);
  settings.sample_spacing = 0.004;
  return settings;
}

inline std::unique_ptr<tissue::TissueModel> makeVariant(const ModelVariant& variant,
                                                        const OrganSketch& organ,
                                                        const tissue::ModelSettings& settings,
                                                        ThreadPool* pool = nullptr) {
  return makeOrgans({organ}, settings, pool, variant.model);
}

/// A ball of 8 mm that comes down on the block's middle at 50 mm/s to `depth` [m], stays, and goes
/// up again after `up` [s].
class Visit {
 public:
  explicit Visit(double depth = 0.004, double up = 0.4) : depth_(depth), up_(up) {}
  contact::Obstacle next() {
    const contact::Obstacle way{&shape_, 0, at(t_), at(t_ + kStep)};
    t_ += kStep;
    return way;
  }
  double time() const { return t_; }
  void setTime(double t) { t_ = t; }

 private:
  Pose at(double t) const {
    const double down = std::min(0.05 * t - 0.002, depth_), back = 0.1 * std::max(0.0, t - up_);
    return poseFromXyzRpy(Vec3(0.03, 0.03, 0.038 - down + back), Vec3::Zero());
  }
  instrument::Geometry shape_ = instrument::Sphere{0.008};
  double depth_, up_, t_ = 0.0;
};

}  // namespace palpate::test

// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/enrichment/press_plan.h"

#include <Eigen/Geometry>
#include <cmath>
#include <random>

namespace palpate::enrichment {
namespace {

// Area-weighted normal of a closed surface, outward.
Vec3 normalAt(const mesh::SurfaceMesh& surface, int point) {
  Vec3 normal = Vec3::Zero();
  for (const auto& t : surface.triangles.colwise()) {
    if ((t.array() != point).all()) continue;
    const Vec3 a = surface.points.col(t[0]);
    normal += (surface.points.col(t[1]) - a).cross(surface.points.col(t[2]) - a);
  }
  return normal.normalized();
}

// Uniform in [0, 1), equal on every machine.
class Unit {
 public:
  Unit(int seed, int index)
      : random_((static_cast<std::uint64_t>(static_cast<std::uint32_t>(seed)) << 32) |
                static_cast<std::uint32_t>(index)) {
    random_.discard(8);
  }
  double operator()() { return static_cast<double>(random_() >> 11) * 0x1p-53; }

 private:
  std::mt19937_64 random_;
};

}  // namespace

Deformation drawPress(const PressPlan& plan, const mesh::SurfaceMesh& coarse,
                      const std::vector<int>& contacts, int index) {
  Unit random(plan.seed, index);
  Deformation press;
  press.contact =
      contacts[static_cast<std::size_t>(random() * static_cast<double>(contacts.size()))];
  const Vec3 inward = -normalAt(coarse, press.contact), across = inward.unitOrthogonal();
  // Uniform on the spherical cap.
  const double cosine = 1.0 - random() * (1.0 - std::cos(plan.cone));
  const double turn = 2.0 * std::acos(-1.0) * random();
  const Vec3 aside = Eigen::AngleAxisd(turn, inward) * across;
  const double size = plan.force * (0.25 + 0.75 * random());
  press.force = size * (cosine * inward + std::sqrt(1.0 - cosine * cosine) * aside);
  return press;
}

}  // namespace palpate::enrichment

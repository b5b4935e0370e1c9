// SPDX-License-Identifier: GPL-3.0-or-later
#include "checks.h"
#include "organ_cells.h"

namespace palpate::torture {
namespace {

// Whether the mechanics of the organ's model are those of its tetrahedra.
bool hasTets(const TortureOrgan& organ) {
  return organ.model == "fem" || organ.model == "mass_spring" || organ.model == "tensor_mass" ||
         organ.model == "hybrid" || organ.model == "enriched";
}

class Inverted : public Criterion {
 public:
  explicit Inverted(const TortureScene& scene) : tets_(hasTets(scene.organs.front())) {}

  std::string check(const Cycle& cycle) override {
    const sim::StepReport& report = cycle.result.report;
    if (!report.ok() || !tets_) return "";
    if (report.min_jacobian <= 0.0)
      return said("converged with a told det F of", report.min_jacobian, "");
    for (int i = 0; i < cycle.simulator.numOrgans(); ++i) {
      const mesh::CellMesh& cells = cells_.of(cycle.simulator, i);
      const Points& x = cycle.simulator.positions(i);
      double least = 1.0;
      if (areLinearTets(cells)) least = leastVolumeRatio(cells, x);
      if (areQuadraticTets(cells)) least = leastAtQuadraturePoints(cells, x);
      if (least <= 0.0) return said("converged with a computed det F of", least, "");
    }
    return "";
  }

 private:
  bool tets_;
  OrganCells cells_;
};

}  // namespace

std::unique_ptr<Criterion> checkInverted(const TortureScene& scene) {
  return std::make_unique<Inverted>(scene);
}

}  // namespace palpate::torture

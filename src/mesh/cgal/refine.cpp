// SPDX-License-Identifier: GPL-3.0-or-later
#include "refine.h"

#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Polyhedral_mesh_domain_with_features_3.h>
#include <CGAL/Random.h>
#include <CGAL/make_mesh_3.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <vector>

#include "convert.h"

namespace palpate::mesh::cgal {
namespace {

using Polyhedron = CGAL::Mesh_polyhedron_3<Kernel>::type;
using Domain = CGAL::Polyhedral_mesh_domain_with_features_3<Kernel, Polyhedron>;
using Triangulation = CGAL::Mesh_triangulation_3<Domain>::type;
using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation, Domain::Corner_index,
                                                        Domain::Curve_index>;
using Criteria = CGAL::Mesh_criteria_3<Triangulation>;
namespace parameters = CGAL::parameters;

// Sizes over the wanted mean edge length. Measured: on the shipped organs the mean edge is within 8
// %.
constexpr double kFacetSize = 0.68;       // bound on a surface triangle's circumscribed ball
constexpr double kCellSize = 0.76;        // bound on the circumradius of a tetrahedron
constexpr double kFacetDistance = 0.06;   // bound on the surface's distance from its triangles
constexpr double kFacetAngle = 28.0;      // [degrees]; termination is proven up to 30
constexpr double kRadiusEdgeRatio = 2.0;  // termination is proven from 2
constexpr double kSliverBound = 12.0;     // [degrees]; perturbation works up to here

// Called at each size query of the mesher, the only available sign of progress.
using Tick = std::function<void()>;

// A multiple of the wanted local size.
class PartOfSize {
 public:
  using FT = Kernel::FT;
  using Point_3 = Kernel::Point_3;
  using Index = Domain::Index;

  PartOfSize(double part, const BodySizes* sizes, const Tick* tick)
      : part_(part), sizes_(sizes), tick_(tick) {}

  FT operator()(const Point_3& p, int, const Index&) const {
    (*tick_)();
    return part_ * sizes_->at(Vec3(p.x(), p.y(), p.z()));
  }

 private:
  double part_;
  const BodySizes* sizes_;
  const Tick* tick_;
};

Criteria criteriaFor(const BodySizes& sizes, const Tick& tick) {
  const auto part = [&](double of_size) { return PartOfSize(of_size, &sizes, &tick); };
  if (sizes.field().uniform()) {
    const double size = sizes.field().coarsest;
    return Criteria(parameters::edge_size = size, parameters::facet_angle = kFacetAngle,
                    parameters::facet_size = kFacetSize * size,
                    parameters::facet_distance = kFacetDistance * size,
                    parameters::cell_radius_edge_ratio = kRadiusEdgeRatio,
                    parameters::cell_size = part(kCellSize));
  }
  return Criteria(parameters::edge_size = part(1.0), parameters::facet_angle = kFacetAngle,
                  parameters::facet_size = part(kFacetSize),
                  parameters::facet_distance = part(kFacetDistance),
                  parameters::cell_radius_edge_ratio = kRadiusEdgeRatio,
                  parameters::cell_size = part(kCellSize));
}

TetMesh extract(const Complex& complex) {
  const Triangulation& triangulation = complex.triangulation();
  std::unordered_map<Triangulation::Vertex_handle, int> index;
  std::vector<Vec3> points;
  std::vector<Eigen::Vector4i> tets;
  for (auto cell = complex.cells_in_complex_begin(); cell != complex.cells_in_complex_end();
       ++cell) {
    Eigen::Vector4i tet;
    for (int i = 0; i < 4; ++i) {
      const auto vertex = cell->vertex(i);
      const auto [at, fresh] = index.emplace(vertex, static_cast<int>(points.size()));
      if (fresh) {
        const auto& p = triangulation.point(vertex);
        points.emplace_back(CGAL::to_double(p.x()), CGAL::to_double(p.y()), CGAL::to_double(p.z()));
      }
      tet[i] = at->second;
    }
    tets.push_back(tet);
  }
  TetMesh mesh;
  mesh.points.resize(3, points.size());
  for (std::size_t i = 0; i < points.size(); ++i) mesh.points.col(i) = points[i];
  mesh.tets.resize(4, tets.size());
  for (std::size_t i = 0; i < tets.size(); ++i) mesh.tets.col(i) = tets[i];
  return mesh;
}

}  // namespace

TetMesh refine(const SurfaceMesh& surface, const BodySizes& sizes, bool keep_sharp,
               double sharp_degrees, double expected_tets, const MeshingProgress& progress) {
  const auto report = [&](const char* stage, double fraction) {
    if (progress) progress(stage, fraction);
  };
  report("reading the surface", 0.0);

  // The mesher's only randomness, seeded anew for reproducible bits.
  CGAL::Random random(0);
  CGAL::get_default_random() = CGAL::Random(0);
  const Polyhedron polyhedron = toMesh<Polyhedron>(toSoup(surface));
  Domain domain(polyhedron, &random);
  if (keep_sharp) domain.detect_features(sharp_degrees);

  // Measured: a tetrahedron of the final mesh takes about four size queries.
  double asked = 0.0, next = 0.0;
  const double expected = std::max(1.0, 4.0 * expected_tets);
  const Tick tick = [&] {
    asked += 1.0;
    if (asked < next) return;
    next += 0.01 * expected;
    report("refining", 0.7 * (1.0 - std::exp(-2.0 * asked / expected)));
  };
  const Criteria criteria = criteriaFor(sizes, tick);
  Complex complex = CGAL::make_mesh_3<Complex>(domain, criteria, parameters::manifold(),
                                               parameters::no_perturb(), parameters::no_exude());
  // No time limits, so that the result does not depend on the clock.
  if (complex.number_of_cells_in_complex() > 0) {
    report("perturbing slivers", 0.7);
    CGAL::perturb_mesh_3(complex, domain, parameters::sliver_bound = kSliverBound);
    report("exuding slivers", 0.9);
    CGAL::exude_mesh_3(complex, parameters::sliver_bound = kSliverBound);
  }
  report("done", 1.0);
  return extract(complex);
}

}  // namespace palpate::mesh::cgal

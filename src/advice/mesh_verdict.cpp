// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/advice/mesh_verdict.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>
#include <variant>

#include "palpate/contact/contact_models.h"
#include "palpate/instrument/geometry.h"
#include "palpate/mesh/cell_mesh.h"
#include "palpate/mesh/tet_mesh.h"
#include "palpate/tissue/fem/force_excess.h"

namespace palpate::advice {
namespace {

constexpr double kWorthSaying = 0.15;  // relative force error
constexpr double kWanted = 0.08;       // relative force error that a hand hardly feels

Eigen::Matrix3Xi outside(const mesh::CellMesh& cells) {
  if (cells.cells.rows() == 3) return cells.cells;
  const bool tetrahedra = cells.cells.rows() == 4 || cells.cells.rows() == 10;
  if (!tetrahedra) return Eigen::Matrix3Xi(3, 0);
  return mesh::boundaryTriangles(cells.cells.topRows(4));
}

double meanOf(std::vector<double>::const_iterator first, std::vector<double>::const_iterator last) {
  return std::accumulate(first, last, 0.0) / static_cast<double>(last - first);
}

// Ball of equivalent size: its radius is the geometric mean of the shape's half extents.
struct LikeABall {
  double operator()(const instrument::Sphere& ball) const { return ball.radius; }
  double operator()(const instrument::Capsule& c) const {
    return std::cbrt(c.radius * c.radius * (c.radius + c.half_length));
  }
  double operator()(const instrument::Cylinder& c) const {
    return std::cbrt(c.radius * c.radius * c.half_length);
  }
  double operator()(const instrument::Box& box) const { return std::cbrt(box.half_extents.prod()); }
  double operator()(const instrument::ConvexHull& hull) const { return ofPoints(hull.surface); }
  double operator()(const instrument::SampledSurface& surface) const {
    return ofPoints(surface.grid->surface);
  }
  static double ofPoints(const mesh::SurfaceMesh& surface) {
    const Points& points = surface.points;
    return std::cbrt(
        (0.5 * (points.rowwise().maxCoeff() - points.rowwise().minCoeff())).eval().prod());
  }
};

struct Tool {
  std::string name;
  double radius;  // [m]
  bool ball;
};

// Tip of an instrument: the smallest shape on the link of its control frame, else the smallest of
// all.
std::optional<Tool> toolOf(const sim::Simulator& simulator, int index) {
  const instrument::Instrument& instrument = simulator.instrument(index);
  const scene::InstrumentConfig& config =
      simulator.scene().instruments[static_cast<std::size_t>(index)];
  const int link = instrument.linkIndex(config.control_frame);
  std::optional<Tool> tool;
  bool of_link = false;
  for (const instrument::CollisionBody& body : instrument.bodies()) {
    const double radius = std::visit(LikeABall{}, body.geometry);
    const bool here = body.link == link;
    if (tool && (here < of_link || (here == of_link && radius >= tool->radius))) continue;
    of_link = here;
    tool = Tool{config.name, radius, std::holds_alternative<instrument::Sphere>(body.geometry)};
  }
  return tool;
}

std::string roundedText(double x) {
  std::ostringstream text;
  text.precision(2);
  text << x;
  return text.str();
}

std::string millimetres(double length) { return roundedText(1e3 * length) + " mm"; }

// Rounded to 10 %, the accuracy of the estimate.
std::string percent(double part) {
  std::ostringstream text;
  text << 10.0 * std::max(1.0, std::round(10.0 * part)) << " %";
  return text.str();
}

bool hasBentEdges(const mesh::CellMesh& cells) {
  if (cells.cells.rows() != 10) return false;
  return mesh::firstBentTet(
             {cells.points, cells.cells.topRows(4), cells.cells.bottomRows(6), {}, {}}) >= 0;
}

// Text that proposes edges for a force error of kWanted.
std::string remedy(const mesh::CellMesh& cells, double edge) {
  if (hasBentEdges(cells)) return "a mesh with edges of " + roundedText(edge) + " m there";
  return "adapt: {finest: " + roundedText(edge) + "}";
}

std::string adviceFor(const scene::OrganConfig& organ, const mesh::CellMesh& cells,
                      const SurfaceEdges& edges, const Tool& tool) {
  const bool adapts = organ.adapt.on();
  const double edge = adapts ? organ.adapt.finest : edges.graded() ? edges.finest : edges.mean;
  const double excess = tissue::forceExcess(organ.element, edge / tool.radius).value_or(0.0);
  const double wanted = tissue::edgeRatioFor(organ.element, kWanted).value_or(0.0) * tool.radius;
  return "organ " + organ.name + ": " + (adapts || edges.graded() ? "where it is finest, " : "") +
         "edges of " + millimetres(edge) + " against a " +
         (tool.ball ? "ball of " : "shape like a ball of ") + millimetres(tool.radius) + " (" +
         tool.name + "): the force will be about " + percent(excess) + " too large; 8 % with " +
         remedy(cells, wanted);
}

std::string adviceForSegments(const scene::OrganConfig& organ, const SurfaceEdges& edges) {
  return "organ " + organ.name +
         ": contact.model prescribed presses at a point: the force is that of edges of " +
         millimetres(edges.mean) +
         ", and finer ones make it less without end; another contact.model converges";
}

}  // namespace

SurfaceEdges surfaceEdges(const mesh::CellMesh& cells) {
  const Eigen::Matrix3Xi triangles = outside(cells);
  const std::size_t points = static_cast<std::size_t>(cells.numPoints());
  std::vector<double> sum(points, 0.0);
  std::vector<int> count(points, 0);
  double area = 0.0, weighted = 0.0;
  for (Eigen::Index t = 0; t < triangles.cols(); ++t) {
    Mat3 edge;
    for (int k = 0; k < 3; ++k) {  // each edge twice, once per triangle
      const int a = triangles(k, t), b = triangles((k + 1) % 3, t);
      edge.col(k) = cells.points.col(b) - cells.points.col(a);
      for (const int i : {a, b}) {
        sum[static_cast<std::size_t>(i)] += edge.col(k).norm();
        ++count[static_cast<std::size_t>(i)];
      }
    }
    const double twice_area = edge.col(0).cross(edge.col(1)).norm();
    area += twice_area;
    weighted += twice_area * edge.colwise().norm().mean();
  }
  std::vector<double> local;  // mean edge at each point of the surface
  for (std::size_t i = 0; i < points; ++i) {
    if (count[i] > 0) local.push_back(sum[i] / count[i]);
  }
  if (local.empty()) return {};
  std::sort(local.begin(), local.end());
  const auto tenth = static_cast<std::ptrdiff_t>((local.size() + 9) / 10);
  return {meanOf(local.begin(), local.begin() + tenth), meanOf(local.end() - tenth, local.end()),
          area > 0.0 ? weighted / area : 0.0};
}

std::vector<std::string> adviseOnMeshes(const sim::Simulator& simulator) {
  std::vector<std::string> advice;
  for (int i = 0; i < simulator.numOrgans(); ++i) {
    const scene::OrganConfig& organ = simulator.scene().organs[static_cast<std::size_t>(i)];
    if (organ.model != "fem") continue;
    const mesh::CellMesh cells = simulator.cells(i);
    const SurfaceEdges edges = surfaceEdges(cells);
    if (contact::isPrescribed(simulator.scene().contact)) {
      advice.push_back(adviceForSegments(organ, edges));
      continue;
    }
    double edge = edges.graded() ? edges.finest : edges.mean;
    if (organ.adapt.on()) edge = std::min(edge, organ.adapt.finest);
    std::optional<Tool> thinnest;
    for (int k = 0; k < simulator.numInstruments(); ++k) {
      const std::optional<Tool> tool = toolOf(simulator, k);
      if (tool && (!thinnest || tool->radius < thinnest->radius)) thinnest = tool;
    }
    if (!thinnest || !(edge > 0.0)) continue;
    if (tissue::forceExcess(organ.element, edge / thinnest->radius).value_or(0.0) > kWorthSaying) {
      advice.push_back(adviceFor(organ, cells, edges, *thinnest));
    }
  }
  return advice;
}

std::vector<std::string> loadingNotes(const sim::Simulator& simulator) {
  std::vector<std::string> notes = simulator.notes();
  const std::vector<std::string> advice = adviseOnMeshes(simulator);
  notes.insert(notes.end(), advice.begin(), advice.end());
  return notes;
}

}  // namespace palpate::advice

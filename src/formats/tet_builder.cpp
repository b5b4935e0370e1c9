// SPDX-License-Identifier: GPL-3.0-or-later
#include "tet_builder.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "palpate/formats/tet_io.h"

namespace palpate::formats {
namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

/// "3 of 596, the first is tetrahedron 12", counted from 1.
std::string countAndFirst(std::size_t count, std::size_t total, std::size_t first) {
  return std::to_string(count) + " of " + std::to_string(total) + ", the first is number " +
         std::to_string(first + 1);
}

/// Exchanges corners 1 and 2, with the mid-edge nodes.
void turnOver(mesh::TetMesh* mesh) {
  mesh->tets.row(1).swap(mesh->tets.row(2));
  if (!mesh->quadratic()) return;
  // Edges 01 12 20 03 13 23 become 02 21 10 03 23 13.
  mesh->midnodes.row(0).swap(mesh->midnodes.row(2));
  mesh->midnodes.row(4).swap(mesh->midnodes.row(5));
}

bool allInverted(const mesh::TetMesh& mesh) {
  for (Eigen::Index i = 0; i < mesh.numTets(); ++i) {
    if (!(mesh::signedVolume(mesh.points, mesh.tets.col(i)) < 0.0)) return false;
  }
  return true;
}

}  // namespace

void TetBuilder::addTet(const TetNodes& nodes, int num_nodes) {
  tets_.push_back(nodes);
  if (num_nodes == 10) {
    ++num_quadratic_;
  } else {
    std::fill(tets_.back().begin() + 4, tets_.back().end(), nodes[0]);
  }
}

void TetBuilder::setRegion(int region) {
  region_.resize(tets_.size(), 0);
  region_.back() = region;
}

void TetBuilder::setData(const std::string& name, int components, const double* values) {
  Data& data = data_[name];
  if (data.components == 0) data.components = components;
  if (data.components != components) {
    throw InputError(file_, "cell data " + name, std::to_string(components) + " components",
                     "must have as many in all pieces of the file");
  }
  data.values.resize(static_cast<std::size_t>(components) * (tets_.size() - 1), kNothing);
  data.values.insert(data.values.end(), values, values + components);
}

void TetBuilder::checkNodes() const {
  std::size_t bad = 0, first = 0;
  const auto end = static_cast<std::int64_t>(points_.size());
  for (std::size_t i = 0; i < tets_.size(); ++i) {
    const TetNodes& nodes = tets_[i];
    if (std::all_of(nodes.begin(), nodes.end(),
                    [&](std::int64_t n) { return n >= 0 && n < end; })) {
      continue;
    }
    if (bad++ == 0) first = i;
  }
  if (bad == 0) return;
  throw InputError(
      file_, "tetrahedra", countAndFirst(bad, tets_.size(), first),
      "a node index is out of range; there are " + std::to_string(points_.size()) + " points");
}

void TetBuilder::checkPoints() const {
  std::size_t bad = 0, first = 0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (!points_[i].allFinite() && bad++ == 0) first = i;
  }
  if (bad == 0) return;
  throw InputError(file_, "points", countAndFirst(bad, points_.size(), first),
                   "the coordinates must be finite");
}

/// A repeated tetrahedron would double the stiffness. Gmsh 2 writes it for a volume in two physical
/// groups.
void TetBuilder::checkDoubles() const {
  std::vector<std::array<std::int64_t, 4>> corners(tets_.size());
  for (std::size_t i = 0; i < tets_.size(); ++i) {
    std::copy_n(tets_[i].begin(), 4, corners[i].begin());
    std::sort(corners[i].begin(), corners[i].end());
  }
  std::vector<std::size_t> order(tets_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return corners[a] < corners[b]; });
  std::size_t bad = 0, first = tets_.size();
  for (std::size_t i = 1; i < order.size(); ++i) {
    if (corners[order[i]] != corners[order[i - 1]]) continue;
    ++bad;
    first = std::min(first, order[i]);
  }
  if (bad == 0) return;
  throw InputError(file_, "tetrahedra", countAndFirst(bad, tets_.size(), first),
                   "the same corners as another tetrahedron's");
}

mesh::TetMesh TetBuilder::finish() {
  if (tets_.empty()) throw InputError(file_, "", "", "there is no tetrahedron in this file");
  if (num_quadratic_ != 0 && num_quadratic_ != tets_.size()) {
    throw InputError(file_, "tetrahedra",
                     std::to_string(tets_.size() - num_quadratic_) + " with 4 nodes, " +
                         std::to_string(num_quadratic_) + " with 10 nodes",
                     "all must have 4 or all must have 10");
  }
  checkNodes();
  checkPoints();
  checkDoubles();

  mesh::TetMesh mesh;
  std::vector<int> renamed(points_.size(), -1);
  for (const TetNodes& nodes : tets_) {
    for (const std::int64_t n : nodes) renamed[n] = 0;
  }
  mesh.points.resize(3, std::count(renamed.begin(), renamed.end(), 0));
  int used = 0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (renamed[i] < 0) continue;
    mesh.points.col(used) = points_[i];
    renamed[i] = used++;
  }
  const auto num_tets = static_cast<Eigen::Index>(tets_.size());
  mesh.tets.resize(4, num_tets);
  mesh.midnodes.resize(6, num_quadratic_ > 0 ? num_tets : 0);
  for (Eigen::Index i = 0; i < num_tets; ++i) {
    for (int c = 0; c < 4; ++c) mesh.tets(c, i) = renamed[tets_[i][c]];
    for (int c = 0; c < 6 && num_quadratic_ > 0; ++c) {
      mesh.midnodes(c, i) = renamed[tets_[i][4 + c]];
    }
  }
  if (!region_.empty()) region_.resize(tets_.size(), 0);
  mesh.region = region_;
  for (auto& [name, data] : data_) {
    data.values.resize(static_cast<std::size_t>(data.components) * tets_.size(), kNothing);
    mesh.cell_data[name] =
        Eigen::Map<const Eigen::MatrixXd>(data.values.data(), data.components, num_tets);
  }
  if (allInverted(mesh)) turnOver(&mesh);
  checkTets(mesh, file_);
  return mesh;
}

}  // namespace palpate::formats

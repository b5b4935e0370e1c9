// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/scene/composition.h"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <vector>

#include "fibre_frames.h"
#include "palpate/base/error.h"
#include "palpate/base/number.h"
#include "palpate/base/vector_text.h"
#include "palpate/mesh/selection.h"
#include "palpate/scene/tissue_file.h"

namespace palpate::scene {
namespace {

constexpr std::size_t kMostValues = 10;  // of cell data shown in a message

std::string metres(double x) { return formatNumber(x) + " m"; }

// Available values of cell data, for the message of an empty region.
struct WhatThereIs {
  const mesh::TetMesh& mesh;

  std::string operator()(const mesh::DepthRegion&) const {
    const Eigen::VectorXd depth = mesh::surfaceDistances(mesh, mesh::tetCentroids(mesh));
    return "the centroids of the tetrahedra lie " + metres(depth.minCoeff()) + " to " +
           metres(depth.maxCoeff()) +
           " below the surface; a layer thinner than the tetrahedra needs smaller ones";
  }
  std::string operator()(const mesh::CellDataRegion& region) const {
    std::set<double> values(mesh.region.begin(), mesh.region.end());
    const auto found = mesh.cell_data.find(region.name);
    if (found != mesh.cell_data.end()) {
      values = {found->second.data(), found->second.data() + found->second.size()};
    }
    std::string text = "the values are";
    std::size_t count = 0;
    for (const double value : values) {
      if (count++ == kMostValues) return text + " ...";
      text += (count > 1 ? ", " : " ") + formatNumber(value);
    }
    return text;
  }
  template <class Shape>
  std::string operator()(const Shape&) const {
    const Points centroids = mesh::tetCentroids(mesh);
    return "the body reaches from " + vectorText(mesh.points.rowwise().minCoeff()) + " to " +
           vectorText(mesh.points.rowwise().maxCoeff()) +
           " m in its own frame, the centroids of its tetrahedra from " +
           vectorText(centroids.rowwise().minCoeff()) + " to " +
           vectorText(centroids.rowwise().maxCoeff()) + " m";
  }
};

// Builds the composition of a body.
class Composer {
 public:
  Composer(const BodyConfig& body, const mesh::TetMesh& mesh, const std::string& file,
           const std::string& key)
      : body_(body), mesh_(mesh), file_(file), prefix_(key.empty() ? "" : key + ".") {}

  fem::Composition compose(const Mat3& R_WB) {
    composition_.solids.push_back(makeSolid(body_.material, file_, prefix_ + "material"));
    owner_.push_back(prefix_ + "material");
    if (body_.fibres) addFibres(*body_.fibres, prefix_ + "fibres");
    for (std::size_t i = 0; i < body_.regions.size(); ++i) addRegion(i);
    addFrames(R_WB);
    return std::move(composition_);
  }

 private:
  std::vector<int> select(const RegionConfig& region, const std::string& key) const {
    std::vector<int> tets;
    try {
      tets = mesh::selectTets(mesh_, region.select);
    } catch (const std::invalid_argument& error) {
      throw InputError(file_, key + ".select", region.name, error.what());
    }
    if (!tets.empty()) return tets;
    throw InputError(
        file_, key + ".select", region.name,
        "must select at least one tetrahedron; " + std::visit(WhatThereIs{mesh_}, region.select));
  }

  void addFibres(const FibreConfig& fibres, const std::string& key) {
    fibres_.emplace_back(fibres, mesh_, file_, key);
    if (fibres_.size() == 1 && body_.fibres) fibres_of_.assign(mesh_.numTets(), 0);
  }

  void addRegion(std::size_t index) {
    const RegionConfig& region = body_.regions[index];
    const std::string key = prefix_ + "regions[" + std::to_string(index) + "]";
    const std::vector<int> tets = select(region, key);
    const auto n = static_cast<std::size_t>(mesh_.numTets());
    if (region.material) {
      composition_.solid_of.resize(n, 0);
      for (int t : tets) composition_.solid_of[t] = static_cast<int>(composition_.solids.size());
      composition_.solids.push_back(makeSolid(*region.material, file_, key + ".material"));
      owner_.push_back(key + ".material (region " + region.name + ")");
    }
    if (region.fibres) {
      addFibres(*region.fibres, key + ".fibres");
      fibres_of_.resize(n, -1);
      for (int t : tets) fibres_of_[t] = static_cast<int>(fibres_.size()) - 1;
    }
  }

  void addFrames(const Mat3& R_WB) {
    const auto needed = [](const material::Solid& s) { return material::needsFibres(s.law); };
    if (std::none_of(composition_.solids.begin(), composition_.solids.end(), needed)) return;
    fibres_of_.resize(mesh_.numTets(), -1);
    composition_.frames.assign(mesh_.numTets(), Mat3::Identity());
    for (Eigen::Index t = 0; t < mesh_.numTets(); ++t) {
      if (!needed(composition_.solid(static_cast<int>(t)))) continue;
      if (fibres_of_[t] < 0) {
        const int solid = composition_.solid_of.empty() ? 0 : composition_.solid_of[t];
        throw InputError(file_, owner_[solid], "",
                         "the law needs directions: give the body or the region `fibres`");
      }
      composition_.frames[t] = R_WB * fibres_[fibres_of_[t]].frame(t);
    }
  }

  const BodyConfig& body_;
  const mesh::TetMesh& mesh_;
  const std::string file_, prefix_;
  fem::Composition composition_;
  std::vector<std::string> owner_;  // key of each solid in the file
  std::vector<FibreFrames> fibres_;
  std::vector<int> fibres_of_;  // index into fibres_ of each tetrahedron; -1: none
};

}  // namespace

fem::Composition composeBody(const BodyConfig& body, const mesh::TetMesh& mesh, const Mat3& R_WB,
                             const std::string& file, const std::string& key) {
  return Composer(body, mesh, file, key).compose(R_WB);
}

}  // namespace palpate::scene

// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/tissue/fem/islands.h"

#include <algorithm>
#include <stdexcept>

#include "fem_organ.h"
#include "palpate/base/state_bytes.h"
#include "palpate/base/vector_text.h"
#include "palpate/mesh/tet_parts.h"
#include "palpate/tissue/skips.h"

namespace palpate::tissue {
namespace {

struct Island {
  std::string name;        // "part 2 of 3, from [..] to [..] m in the world: "
  std::vector<int> nodes;  // indices in the whole
  std::unique_ptr<FemOrgan> body;
};

fem::Composition compositionOf(const fem::Composition& whole, const std::vector<int>& tets) {
  fem::Composition part;
  part.solids = whole.solids;
  for (int t : tets) {
    if (!whole.solid_of.empty()) part.solid_of.push_back(whole.solid_of[t]);
    if (!whole.frames.empty()) part.frames.push_back(whole.frames[t]);
  }
  return part;
}

Points gather(const Points& whole, const std::vector<int>& nodes) {
  Points part(3, nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) part.col(i) = whole.col(nodes[i]);
  return part;
}

void scatter(const Points& part, const std::vector<int>& nodes, Points* whole) {
  for (std::size_t i = 0; i < nodes.size(); ++i) whole->col(nodes[i]) = part.col(i);
}

void addIsland(const TissueStep& island, TissueStep* out) {
  mergeFigures(Over::kParts, island, out);
  mergeSkips(Over::kParts, island, out);
  out->contacts.insert(out->contacts.end(), island.contacts.begin(), island.contacts.end());
  out->support_force += island.support_force;
  out->gravity_force += island.gravity_force;
  out->inertia_force += island.inertia_force;
  out->interaction_force += island.interaction_force;
}

class Islands final : public OrganBodies {
 public:
  Islands(const mesh::TetMesh& mesh, std::vector<int> solid_of, std::vector<Island> islands,
          const FemSettings& settings)
      : mesh_(mesh),
        solid_of_(std::move(solid_of)),
        kind_(stateKind(settings, mesh.numPoints()) + " in " + std::to_string(islands.size()) +
              " parts"),
        triangles_(mesh::trianglesOf(mesh::boundaryFaces(mesh))),
        islands_(std::move(islands)),
        x_(mesh.points),
        v_(Points::Zero(3, mesh.numPoints())) {
    for (const Island& island : islands_) take(island);
  }

  SurfaceState surfaceState(int) const override { return {x_, v_, triangles_, 0}; }
  mesh::CellMesh cells(int) const override {
    mesh::CellMesh cells = mesh::cellsOf(mesh_);
    cells.solid = solid_of_;
    return cells;
  }

  void addBodies(std::vector<FemOrgan*>* bodies) override {
    for (const Island& island : islands_) bodies->push_back(island.body.get());
  }

  const TissueStep& endCycle(const std::vector<contact::Obstacle>&, double) override {
    out_.clear();
    out_.slept = out_.satisfied = true;
    for (const Island& island : islands_) {
      const TissueStep& done = island.body->report();
      addIsland(done, &out_);
      if (!done.slept) take(island);
    }
    if (out_.slept) out_.satisfied = false;
    return out_;
  }

  std::vector<std::string> methods(int) const override {
    std::vector<const Island*> by_size;
    for (const Island& island : islands_) by_size.push_back(&island);
    std::stable_sort(by_size.begin(), by_size.end(), [](const Island* a, const Island* b) {
      return a->nodes.size() > b->nodes.size();
    });
    std::vector<std::string> all;
    for (const Island* island : by_size) {
      for (const std::string& method : island->body->methods(0)) {
        if (!std::count(all.begin(), all.end(), method)) all.push_back(method);
      }
    }
    return all;
  }

  std::vector<std::string> notes() const override {
    std::vector<std::string> all;
    for (const Island& island : islands_) {
      for (const std::string& note : island.body->notes()) all.push_back(island.name + note);
    }
    return all;
  }

  void setInterrupt(const solver::Interrupt* interrupt) override {
    for (const Island& island : islands_) island.body->setInterrupt(interrupt);
  }

  void reset() override {
    for (const Island& island : islands_) {
      island.body->reset();
      take(island);
    }
    out_.clear();
  }

  void setPositions(int, const Points& positions, const Points& velocities) override {
    x_ = positions;
    v_ = velocities;
    for (const Island& island : islands_) {
      island.body->setPositions(0, gather(positions, island.nodes),
                                gather(velocities, island.nodes));
    }
    out_.clear();
  }

  State state() const override {
    StateWriter out;
    for (const Island& island : islands_) {
      const State part = island.body->state();
      out.put(part.kind);
      out.put(part.bytes);
    }
    return {kind_, out.bytes()};
  }

  void restore(const State& state) override {
    checkKind(state, kind_);
    StateReader in(state.bytes);
    for (const Island& island : islands_) {
      State part;
      in.get(&part.kind);
      in.get(&part.bytes);
      island.body->restore(part);
      take(island);
    }
    in.finish();
    out_.clear();
  }

 private:
  void take(const Island& island) {
    scatter(island.body->positions(), island.nodes, &x_);
    scatter(island.body->velocities(), island.nodes, &v_);
  }

  mesh::TetMesh mesh_;
  std::vector<int> solid_of_;
  std::string kind_;
  Eigen::Matrix3Xi triangles_;
  std::vector<Island> islands_;
  Points x_, v_;
  TissueStep out_;
};

// "part 2 of 3, from [..] to [..] m: "
std::string nameOf(std::size_t index, std::size_t count, const Points& points) {
  return "part " + std::to_string(index + 1) + " of " + std::to_string(count) + ", from " +
         vectorText(points.rowwise().minCoeff()) + " to " +
         vectorText(points.rowwise().maxCoeff()) + " m in the world: ";
}

}  // namespace

std::unique_ptr<OrganBodies> makeOrganBodies(const mesh::TetMesh& mesh,
                                             const fem::Composition& composition,
                                             const Surroundings& surroundings,
                                             const FemSettings& settings, ThreadPool* pool) {
  std::vector<mesh::TetPart> parts;
  if (settings.skip.islands) parts = mesh::splitParts(mesh);
  std::size_t used = 0;
  for (const mesh::TetPart& part : parts) used += part.nodes.size();
  const bool stray_nodes = used < static_cast<std::size_t>(mesh.numPoints());
  if (parts.size() < 2 || stray_nodes) {
    return makeFemOrgan(mesh, composition, surroundings, settings, pool);
  }
  std::vector<Island> islands;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const mesh::TetPart& part = parts[k];
    const std::string name = nameOf(k, parts.size(), part.mesh.points);
    try {
      islands.push_back({name, part.nodes,
                         makeFemOrgan(part.mesh, compositionOf(composition, part.tets),
                                      partOf(surroundings, part.nodes), settings, pool)});
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(name + error.what());
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(name + error.what());
    }
  }
  return std::make_unique<Islands>(mesh, composition.solid_of, std::move(islands), settings);
}

std::unique_ptr<TissueModel> makeIslands(const mesh::TetMesh& mesh,
                                         const fem::Composition& composition,
                                         const Surroundings& surroundings,
                                         const FemSettings& settings, ThreadPool* pool) {
  return makeOrganBodies(mesh, composition, surroundings, settings, pool);
}

}  // namespace palpate::tissue

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "anatomy_contact.h"
#include "palpate/base/state_bytes.h"
#include "palpate/contact/obstacle.h"
#include "palpate/haptics/wrench_fade.h"
#include "palpate/scene/scene_parts.h"
#include "palpate/sim/simulator.h"

namespace palpate::sim {

bool inReach(const std::vector<LinkPoses>& poses);

/// Of the largest force on a tool: what may be unbalanced where that force is still felt.
constexpr double kToldWithin = 0.5;

struct Simulator::Impl {
  scene::Scene scene;
  scene::SceneParts parts;
  std::vector<contact::Obstacle> bodies;         // of the instruments, then of the anatomy
  std::vector<std::pair<int, int>> body_source;  // instrument, index into its bodies()
  std::vector<LinkPoses> poses;                  // where the tools are
  std::vector<LinkPoses> next_poses;             // and where they go
  StepResult result;
  AnatomyContact anatomy;
  std::vector<haptics::WrenchFade> fades;   // one an instrument
  std::vector<haptics::ToolProxy> proxies;  // likewise
  double time = 0.0;
  solver::Interrupt interrupt;

  Impl(const scene::Scene& s, const Progress& progress)
      : scene(s), parts(scene::assembleScene(s, progress)), anatomy(parts) {
    for (std::size_t i = 0; i < parts.instruments.size(); ++i) {
      const auto& shapes = parts.instruments[i].bodies();
      std::vector<std::size_t> links;
      for (std::size_t b = 0; b < shapes.size(); ++b) {
        bodies.push_back({&shapes[b].geometry, static_cast<int>(i), Pose(), Pose()});
        const scene::NeedleConfig& needle = scene.instruments[i].needle;
        if (shapes[b].link == parts.instruments[i].linkIndex(needle.link)) {
          bodies.back().needle = &needle;
        }
        body_source.emplace_back(i, b);
        links.push_back(static_cast<std::size_t>(shapes[b].link));
      }
      proxies.emplace_back(scene.instruments[i].proxy,
                           static_cast<std::size_t>(parts.control_links[i]), std::move(links));
    }
    for (std::size_t i = 0; i < parts.anatomy.size(); ++i) {
      const scene::AnatomyPart& part = parts.anatomy[i];
      bodies.push_back(
          {&part.geometry, contact::Owner::anatomy(static_cast<int>(i)), part.X_WG, part.X_WG});
    }
    clear();
  }

  void clear() {
    time = 0.0;
    poses.assign(parts.instruments.size(), LinkPoses());
    for (haptics::ToolProxy& proxy : proxies) proxy.leave();
    result.clear(parts.instruments.size());
    fades.assign(parts.instruments.size(), haptics::WrenchFade(scene.rates.ramp, 1.0));
  }

  bool accepts(const std::vector<LinkPoses>& next, double dt) const;
  bool isFree(std::size_t i, const LinkPoses& links) const;
  /// Where the tools go in a cycle in which they are commanded to these poses.
  const std::vector<LinkPoses>& follow(const std::vector<LinkPoses>& commanded, double dt);
  void moveBodies(const std::vector<LinkPoses>& next);
  void placeControlFrames() {
    for (std::size_t i = 0; i < poses.size(); ++i) {
      InstrumentResult& tool = result.instruments[i];
      tool.there = !poses[i].empty();
      tool.waiting = proxies[i].waiting();
      if (tool.there) tool.X_WC = poses[i][parts.control_links[i]];
    }
  }

  void sumWrenches(const tissue::TissueStep& cycle, const std::vector<int>& organs) {
    for (const tissue::TissueContact& c : cycle.contacts) {
      ContactPoint point;
      point.organ = organs[static_cast<std::size_t>(c.organ)];
      point.p_W = c.p_W;
      point.force_W = c.force_W;
      (c.owner.isInstrument() ? point.instrument : point.anatomy) = c.owner.index;
      result.contacts.push_back(point);
      if (!c.owner.isInstrument()) continue;
      InstrumentResult& tool = result.instruments[static_cast<std::size_t>(c.owner.index)];
      tool.spatial += Wrench{c.force_W, (c.p_W - tool.X_WC.translation()).cross(c.force_W)};
      tool.max_penetration = std::max(tool.max_penetration, c.penetration);
      ++tool.contacts;
    }
  }

  /// Grows with every change of the mesh of one of its organs.
  static std::uint64_t revision(const tissue::TissueModel& model) {
    std::uint64_t sum = 0;
    for (int i = 0; i < model.numOrgans(); ++i) sum += model.surfaceState(i).revision;
    return sum;
  }
  /// `before`: revision(model) when the cycle began.
  void countMeshes(const tissue::TissueModel& model, std::uint64_t before) {
    result.report.mesh_changes += static_cast<int>(revision(model) - before);
    for (int i = 0; i < model.numOrgans(); ++i) {
      result.report.nodes += static_cast<int>(model.positions(i).cols());
    }
  }

  std::string modelName(const scene::ModelPart& model) const {
    return scene.organs[static_cast<std::size_t>(model.organs.front())].model;
  }
  std::vector<std::string> organNames(const scene::ModelPart& model) const {
    std::vector<std::string> names;
    for (int i : model.organs) names.push_back(scene.organs[static_cast<std::size_t>(i)].name);
    return names;
  }

  /// Whether a state is one of this scene and its models; what the models remember they check.
  void checkScene(const SimulatorState& state) const;
  void restore(const SimulatorState& state);
  /// Where the tools are, and the wrenches, which fade if the next solve fails.
  void saveTools(StateWriter* out) const;
  void restoreTools(StateReader* in);

  /// Whether the wrenches of the tissue, before the anatomy's are added, say something: one that
  /// ended early, as the best that there was, may be far from a balance, and is wherever it was
  /// stopped.
  bool isTold() const {
    const solver::SolveStatus status = result.report.status;
    if (solver::balanced(status)) return true;
    if (!solver::usable(status) || status == solver::SolveStatus::kDeadline) return false;
    double largest = 0.0;
    for (const InstrumentResult& tool : result.instruments) {
      largest = std::max(largest, tool.spatial.force.norm());
    }
    return result.report.residual <= kToldWithin * largest;
  }

  /// The hand feels solved states only; after a cycle that failed what it felt fades.
  void fade(double dt, bool told) {
    for (std::size_t i = 0; i < fades.size(); ++i) {
      InstrumentResult& tool = result.instruments[i];
      tool.live = tool.there && told;
      tool.spatial = fades[i].update(tool.spatial, tool.live, dt);
      tool.solved = fades[i].held();
    }
  }

  /// Of all that a cycle shows, in the scene's order.
  std::uint64_t stateHash() const;

  void finish(double dt, bool told) {
    fade(dt, told);
    for (const InstrumentResult& tool : result.instruments) {
      result.report.contacts += tool.contacts;
      result.report.max_penetration = std::max(result.report.max_penetration, tool.max_penetration);
    }
    result.report.time = time;
    result.report.step = dt;
    result.report.state_hash = stateHash();
  }
};

}  // namespace palpate::sim

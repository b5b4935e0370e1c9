// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "palpate/base/state_bytes.h"
#include "palpate/contact/obstacle.h"
#include "palpate/haptics/wrench_fade.h"
#include "palpate/scene/scene_parts.h"
#include "palpate/sim/simulator.h"

namespace palpate::sim {

bool allFinite(const std::vector<LinkPoses>& poses);

struct Simulator::Impl {
  scene::Scene scene;
  scene::SceneParts parts;
  std::vector<contact::Obstacle> bodies;
  std::vector<std::pair<int, int>> body_source;  // instrument, index into its bodies()
  std::vector<LinkPoses> poses;                  // where the tools are; empty: nowhere yet
  StepResult result;
  std::vector<haptics::WrenchFade> fades;  // one an instrument
  double time = 0.0;
  solver::Interrupt interrupt;

  Impl(const scene::Scene& s, const Progress& progress)
      : scene(s), parts(scene::assembleScene(s, progress)) {
    for (std::size_t i = 0; i < parts.instruments.size(); ++i) {
      const auto& shapes = parts.instruments[i].bodies();
      for (std::size_t b = 0; b < shapes.size(); ++b) {
        bodies.push_back({&shapes[b].geometry, static_cast<int>(i), Pose(), Pose()});
        body_source.emplace_back(i, b);
      }
    }
    clear();
  }

  void clear() {
    time = 0.0;
    poses.clear();
    result.clear(parts.instruments.size());
    fades.assign(parts.instruments.size(), haptics::WrenchFade(scene.rates.ramp, 1.0));
  }

  bool accepts(const std::vector<LinkPoses>& next, double dt) const;
  void moveBodies(const std::vector<LinkPoses>& next) {
    const std::vector<LinkPoses>& from = poses.empty() ? next : poses;
    for (std::size_t k = 0; k < bodies.size(); ++k) {
      const auto [i, b] = body_source[k];
      const instrument::CollisionBody& shape = parts.instruments[i].bodies()[b];
      bodies[k].X_WG_begin = from[i][shape.link] * shape.X_LG;
      bodies[k].X_WG_end = next[i][shape.link] * shape.X_LG;
    }
    poses = next;
  }

  void placeControlFrames() {
    for (std::size_t i = 0; i < poses.size(); ++i) {
      result.instruments[i].X_WC = poses[i][parts.control_links[i]];
    }
  }

  void sumWrenches(const tissue::TissueStep& cycle, const std::vector<int>& organs) {
    for (const tissue::TissueContact& c : cycle.contacts) {
      InstrumentResult& tool = result.instruments[c.instrument];
      tool.spatial += Wrench{c.force_W, (c.p_W - tool.X_WC.translation()).cross(c.force_W)};
      tool.max_penetration = std::max(tool.max_penetration, c.penetration);
      ++tool.contacts;
      const int organ = organs[static_cast<std::size_t>(c.organ)];
      result.contacts.push_back({c.instrument, organ, c.p_W, c.force_W});
    }
  }

  /// Grows with every change of the mesh of one of its organs.
  static std::uint64_t revision(const tissue::TissueModel& model) {
    std::uint64_t sum = 0;
    for (int i = 0; i < model.numOrgans(); ++i) sum += model.shape(i).revision;
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

  /// The hand feels solved states only; after a cycle that failed what it felt fades.
  void fade(double dt) {
    for (std::size_t i = 0; i < fades.size(); ++i) {
      InstrumentResult& tool = result.instruments[i];
      tool.spatial = fades[i].update(tool.spatial, result.report.usable(), dt);
      tool.solved = fades[i].held();
    }
  }

  void finish(double dt) {
    fade(dt);
    for (const InstrumentResult& tool : result.instruments) {
      result.report.contacts += tool.contacts;
      result.report.max_penetration = std::max(result.report.max_penetration, tool.max_penetration);
    }
    result.report.time = time;
    result.report.step = dt;
  }
};

}  // namespace palpate::sim

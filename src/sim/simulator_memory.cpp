// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "palpate/base/error.h"
#include "palpate/sim/state_hash.h"
#include "simulator_impl.h"

namespace palpate::sim {
namespace {

constexpr double kMostForce = 1e6;  // of what was saved [N] or [N m]
constexpr double kSkew = 1e-6;      // of a rotation

// Whether what was saved is a place that a tool can have.
bool arePoses(const LinkPoses& poses) {
  return inReach(poses) && std::all_of(poses.begin(), poses.end(), [](const Pose& X) {
           const Mat3 R = X.linear();
           return (R.transpose() * R - Mat3::Identity()).cwiseAbs().maxCoeff() <= kSkew &&
                  X.matrix().row(3) == Eigen::RowVector4d(0.0, 0.0, 0.0, 1.0);
         });
}

// Whether what was saved is a body of which geometry can be computed.
bool isSensible(const tissue::SurfaceState& shape) {
  return (shape.positions.array().abs() <= kReach).all() && shape.velocities.allFinite();
}

}  // namespace

void Simulator::Impl::checkScene(const SimulatorState& state) const {
  const auto require = [](bool holds, const std::string& what) {
    if (!holds) throw std::invalid_argument("the state is of another scene: " + what);
  };
  require(state.scene == scene.name, "'" + state.scene + "', not '" + scene.name + "'");
  require(state.models.size() == parts.models.size(), "it has other organs or models");
  for (std::size_t k = 0; k < parts.models.size(); ++k) {
    const ModelState& given = state.models[k];
    const std::vector<std::string> organs = organNames(parts.models[k]);
    const std::string model = modelName(parts.models[k]);
    require(given.organs == organs,
            "it has organ " + joinNames(given.organs) + " where this has " + joinNames(organs));
    require(given.model == model,
            "model " + given.model + " of organ " + organs.front() + ", which here is " + model);
  }
  require(std::isfinite(state.time), "its time is not finite");
}

void Simulator::Impl::restore(const SimulatorState& state) {
  clear();
  for (std::size_t k = 0; k < parts.models.size(); ++k) {
    try {
      parts.models[k].tissue->restore(state.models[k].state);
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument("organ " + joinNames(state.models[k].organs) + ": " +
                                  error.what());
    }
  }
  for (const scene::OrganHandle& organ : parts.organs) {
    if (!isSensible(organ.surfaceState())) throw std::invalid_argument("an organ is nowhere");
  }
  StateReader tools(state.tools);
  restoreTools(&tools);
  time = result.report.time = state.time;
}

void Simulator::Impl::saveTools(StateWriter* out) const {
  out->put(static_cast<std::int64_t>(poses.size()));
  for (const LinkPoses& links : poses) {
    out->put(static_cast<std::int64_t>(links.size()));
    for (const Pose& X : links) out->put(X.matrix());
  }
  for (const InstrumentResult& tool : result.instruments) {
    out->put(tool.spatial.force);
    out->put(tool.spatial.torque);
    out->put(tool.contacts);
    out->put(tool.max_penetration);
  }
  for (const haptics::WrenchFade& fade : fades) fade.save(out);
  for (const haptics::ToolProxy& proxy : proxies) proxy.save(out);
}

void Simulator::Impl::restoreTools(StateReader* in) {
  if (in->count(1) != static_cast<std::int64_t>(poses.size())) StateReader::fail();
  for (std::size_t i = 0; i < poses.size(); ++i) {
    poses[i].resize(static_cast<std::size_t>(in->count(sizeof(Pose))));
    const std::size_t links = parts.instruments[i].linkNames().size();
    if (!poses[i].empty() && poses[i].size() != links) StateReader::fail();
    for (Pose& X : poses[i]) in->get(&X.matrix());
  }
  if (!std::all_of(poses.begin(), poses.end(), arePoses)) StateReader::fail();
  placeControlFrames();
  for (InstrumentResult& tool : result.instruments) {
    in->get(&tool.spatial.force);
    in->get(&tool.spatial.torque);
    in->get(&tool.contacts);
    in->get(&tool.max_penetration);
    const bool sensible = tool.spatial.force.norm() <= kMostForce &&
                          tool.spatial.torque.norm() <= kMostForce && tool.contacts >= 0 &&
                          std::isfinite(tool.max_penetration);
    if (!sensible) StateReader::fail();
  }
  for (std::size_t i = 0; i < fades.size(); ++i) {
    fades[i].restore(in);
    result.instruments[i].solved = fades[i].held();
  }
  for (std::size_t i = 0; i < proxies.size(); ++i) {
    proxies[i].restore(in);
    const LinkPoses& links = proxies[i].poses();
    const bool fits = links.empty() || links.size() == parts.instruments[i].linkNames().size();
    if (!fits || !arePoses(links)) StateReader::fail();
  }
  in->finish();
  // A state may be of a scene whose tools had no proxy.
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const bool active = scene.instruments[i].proxy.active;
    if (active && proxies[i].poses().size() != poses[i].size()) proxies[i].startAt(poses[i]);
  }
}

std::uint64_t Simulator::Impl::stateHash() const {
  StateHash hash;
  for (const scene::OrganHandle& organ : parts.organs) {
    const tissue::SurfaceState shape = organ.surfaceState();
    hash.add(static_cast<std::uint64_t>(shape.positions.cols()));
    hash.add(shape.positions.data(), static_cast<std::size_t>(shape.positions.size()));
    hash.add(shape.velocities.data(), static_cast<std::size_t>(shape.velocities.size()));
  }
  for (const InstrumentResult& tool : result.instruments) {
    hash.add(tool.spatial.force.data(), 3);
    hash.add(tool.spatial.torque.data(), 3);
  }
  return hash.value();
}

double Simulator::time() const { return impl_->time; }

SimulatorState Simulator::state() const {
  SimulatorState state;
  state.scene = impl_->scene.name;
  state.time = impl_->time;
  for (const scene::ModelPart& model : impl_->parts.models) {
    state.models.push_back(
        {impl_->modelName(model), impl_->organNames(model), model.tissue->state()});
  }
  StateWriter tools;
  impl_->saveTools(&tools);
  state.tools = tools.bytes();
  return state;
}

void Simulator::restore(const SimulatorState& state) {
  impl_->checkScene(state);
  const SimulatorState before = this->state();
  try {
    impl_->restore(state);
  } catch (...) {
    impl_->restore(before);
    throw;
  }
}

}  // namespace palpate::sim

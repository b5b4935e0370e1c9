// SPDX-License-Identifier: GPL-3.0-or-later
#include "state_scenes.h"

#include <map>
#include <memory>
#include <stdexcept>

#include "palpate/base/error.h"
#include "palpate/formats/vtu_writer.h"
#include "scratch_file.h"
#include "targets.h"

namespace palpate::fuzz {
namespace {

constexpr char kProbe[] = R"(<robot name="probe">
<link name="base"/>
<link name="tip"><collision><geometry><sphere radius="0.005"/></geometry></collision></link>
<joint name="z" type="prismatic"><parent link="base"/><child link="tip"/><axis xyz="0 0 1"/>
<limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
</robot>
)";

/// Further lines of the organ, and of the scene.
struct Variant {
  const char* organ;
  const char* rest;
};
constexpr Variant kVariants[] = {
    {"", "contact: {friction: {static: 0.4, teeth: 100.0}}\n"},
    {"", "solver: {method: implicit_direct, integrator: bdf2}\n"},
    {"", "solver: {method: implicit_async}\n"},
    {"", "solver: {method: lbfgs}\n"},
    {"", "solver: {method: tled}\n"},
    {"", "solver: {method: linear_precomputed}\n"},
    {"    element: tet10\n", ""},
    {"    adapt: {finest: 0.004}\n", ""},
    {"    model: mass_spring\n    springs: {scheme: symplectic_euler}\n", ""},
    {"    model: tensor_mass\n", ""},
    {"    model: hybrid\n    hybrid: {region: {half_space: {point: [0.02, 0, 0], normal: [1, 0, "
     "0]}}}\n",
     ""},
    {"    model: sampled_elasticity\n", ""},
    {"    model: honeycomb\n    honeycomb: {cell_size: 0.01}\n", ""},
};

constexpr char kOrgan[] = R"(name: block
organs:
  - name: block
    tetrahedra: block.vtu
    pose: {position: [-0.02, -0.02, 0]}
    material: {law: stable_neo_hookean, young_modulus: 6.0e3, poisson_ratio: 0.45, density: 1060}
    supports: [{select: {plane: {axis: z, at: 0}}}]
)";
constexpr char kInstrument[] = R"(instruments:
  - name: probe
    urdf: probe.urdf
    control_frame: tip
)";

std::vector<sim::LinkPoses> pressing(const sim::Simulator& simulator, double depth) {
  return {simulator.linkPoses(0, Eigen::VectorXd::Constant(1, 0.025 - depth))};
}

struct Pressed {
  std::unique_ptr<sim::Simulator> simulator;
  sim::SimulatorState state;
};

Pressed& pressed(int scene) {
  static std::map<int, Pressed> all;
  Pressed& one = all[scene];
  if (one.simulator) return one;
  one.simulator = makeBlock(kVariants[scene].organ, kVariants[scene].rest);
  for (const double depth : {0.0, 1e-3, 2e-3})
    one.simulator->step(pressing(*one.simulator, depth), 0.01);
  one.state = one.simulator->state();
  return one;
}

void look(const sim::Simulator& simulator, const sim::StepResult& result) {
  for (const sim::InstrumentResult& tool : result.instruments) {
    require(tool.spatial.force.allFinite() && tool.spatial.torque.allFinite(), "a wrench of NaN");
  }
  require(simulator.positions(0).allFinite(), "a point that is nowhere");
}

}  // namespace

std::unique_ptr<sim::Simulator> makeBlock(const std::string& organ, const std::string& rest) {
  const test::TempFolder folder;
  formats::writeVtu(folder.path("block.vtu"),
                    mesh::boxMesh(Vec3(0.04, 0.04, 0.02), Eigen::Vector3i(2, 2, 1)), {}, {});
  folder.write("probe.urdf", kProbe);
  const std::string file = folder.write("scene.yaml", kOrgan + organ + kInstrument + rest);
  return std::make_unique<sim::Simulator>(scene::readScene(file));
}

int numStateScenes() { return static_cast<int>(std::size(kVariants)); }

sim::SimulatorState stateOf(int scene) { return pressed(scene).state; }

void restoreInto(int scene, const std::string& payload) {
  Pressed& one = pressed(scene % numStateScenes());
  sim::Simulator& simulator = *one.simulator;
  simulator.restore(one.state);
  try {
    simulator.restore(sim::SimulatorState::fromBytes(payload));
  } catch (const std::invalid_argument& error) {
    require(simulator.state() == one.state, "what was refused left something behind");
    throw InputError("payload", "", "", error.what());
  }
  for (const double depth : {2e-3, 1e-3})
    look(simulator, simulator.step(pressing(simulator, depth), 0.01));
}

}  // namespace palpate::fuzz

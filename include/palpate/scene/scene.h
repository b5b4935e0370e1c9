// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "palpate/base/types.h"
#include "palpate/contact/needle.h"
#include "palpate/contact/response_settings.h"
#include "palpate/fem/elasticity.h"
#include "palpate/haptics/device.h"
#include "palpate/haptics/passivity.h"
#include "palpate/haptics/tool_coupling.h"
#include "palpate/haptics/tool_proxy.h"
#include "palpate/haptics/wrench_filter.h"
#include "palpate/instrument/instrument.h"
#include "palpate/keys/value_list.h"
#include "palpate/scene/body_config.h"
#include "palpate/scene/edge_length_config.h"
#include "palpate/scene/surroundings_config.h"
#include "palpate/solver/integrator.h"
#include "palpate/solver/step_settings.h"
#include "palpate/tissue/adapt_settings.h"
#include "palpate/tissue/cloth/cloth_settings.h"
#include "palpate/tissue/enriched/enriched_settings.h"
#include "palpate/tissue/honeycomb/honeycomb_settings.h"
#include "palpate/tissue/hybrid/hybrid_settings.h"
#include "palpate/tissue/neural/neural_settings.h"
#include "palpate/tissue/sampled/sampling_settings.h"
#include "palpate/tissue/skip_switches.h"
#include "palpate/tissue/springs/spring_settings.h"
#include "palpate/tissue/touching_organs.h"

namespace palpate::scene {

// The scene file as plain data. Defaults are member initialisers, of these structs or of what they
// set up; scene_fields.cpp lists every key once, with unit, range and meaning, for the reader, the
// checks and the documentation.

struct PoseConfig {
  Vec3 position = Vec3::Zero();        ///< [m]
  Vec3 roll_pitch_yaw = Vec3::Zero();  ///< [rad], about fixed x, y, z

  Pose pose() const { return poseFromXyzRpy(position, roll_pitch_yaw); }
};

/// The body's own frame is the organ's, after scaling.
struct OrganConfig : BodyConfig {
  std::string name;
  std::string surface;           ///< Surface file, or
  std::string tetrahedra;        ///< tetrahedra file, or what `cloth` makes: exactly one of them.
  double scale = 1.0;            ///< File unit to metre.
  EdgeLengthConfig edge_length;  ///< Of the tetrahedra that fill a surface.
  PoseConfig pose;               ///< Organ to world.
  std::string model = "fem";     ///< One of tissue::modelNames().
  std::string element = fem::elementNames().front();
  tissue::AdaptSettings adapt;
  tissue::SpringSettings springs;
  tissue::ClothSettings cloth;
  tissue::SamplingSettings sampling;
  tissue::HoneycombSettings honeycomb;
  tissue::HybridSettings hybrid;
  tissue::EnrichedSettings enriched;
  tissue::NeuralSettings neural;
  solver::RayleighDamping damping;
  std::vector<SupportConfig> supports;
  std::vector<PressureConfig> pressure;
};

struct ProxyConfig : haptics::ProxySettings, haptics::CouplingSettings {
  bool active = false;  ///< In replays; the live node's always are.
};

/// The device through which an instrument is felt.
struct DeviceConfig : haptics::DeviceSettings {
  std::string model = "other";  ///< One of haptics::deviceModelNames().
};

/// What the device of one instrument sustains; 0: as HapticsConfig says for all.
struct LimitsConfig {
  double max_force = 0.0;       ///< [N]
  double max_torque = 0.0;      ///< [N m]
  double max_force_rate = 0.0;  ///< [N/s]
};

/// How a mesh becomes a rigid shape.
struct MeshShapeConfig : instrument::MeshShapeSettings {};

/// Of an instrument: which of its links goes into tissue, and how.
struct NeedleConfig : contact::NeedleSettings {
  std::string link;  ///< Its collision shapes are capsules or cylinders; empty: none.
};

struct InstrumentConfig {
  std::string name;
  std::string urdf;
  PoseConfig base;               ///< The URDF's root link in world (used with joint input).
  std::string input = "joints";  ///< joints | tf
  std::string joint_topic;       ///< Empty: <name>/measured_js.
  std::string tf_prefix;         ///< Put before link names in tf.
  std::string control_frame;     ///< Link where the wrench is given.
  bool cylinder_as_capsule = instrument::InstrumentOptions().cylinder_as_capsule;
  MeshShapeConfig collision_meshes;
  NeedleConfig needle;
  ProxyConfig proxy;
  DeviceConfig device;
  LimitsConfig limits;
};

/// Something rigid that never moves: bone and the like. Its own frame is the file's, scaled.
struct AnatomyConfig {
  std::string name;
  std::string surface;  ///< Surface file.
  double scale = 1.0;   ///< File unit to metre.
  PoseConfig pose;      ///< Its frame to world.
  /// Of what a tool feels of it [N/m]: the strongest device that we know, of 20 N
  /// (docs/devices.md), presses a tool in by 1 mm. Devices render less, which
  /// haptics::VirtualCoupling sees to.
  double felt_stiffness = 2.0e4;
  MeshShapeConfig shape;
};

/// Friction of what is named, where not everything is alike; empty: of any.
struct FrictionPairConfig : contact::Friction {
  std::string organ, instrument, link, anatomy;
};

struct FrictionConfig : contact::Friction {
  std::vector<FrictionPairConfig> pairs;  ///< The most specific holds, of two alike the later.
};

struct ContactConfig : contact::ResponseSettings, tissue::TouchingOrgans {
  double sample_spacing = 0.0;  ///< Contact samples on the surface at most this apart [m]; 0: half
                                ///< the inscribed radius of the thinnest tool, or part of the
                                ///< anatomy, which then meets samples of its own.
  FrictionConfig friction;
};

struct SkipConfig : tissue::SkipSwitches {
  bool unwatched_markers = true;
};

struct SolverConfig : solver::StepSettings {
  int threads = 1;
  bool thread_for_tasks = false;  ///< One more, for background tasks; no key, the node's.
  double deadline = 2.0;          ///< Of a live step, as part of 1/rates.simulation; 0: none.
  SkipConfig skip;
};

struct RatesConfig {
  double simulation = 100.0;                           ///< At most [Hz].
  double haptic = 1000.0;                              ///< [Hz]
  double markers = 30.0;                               ///< At most [Hz].
  double stale_after = 0.2;                            ///< Input older than this pauses [s].
  double ramp = haptics::WrenchFilterSettings().ramp;  ///< For the wrench to come or go fully [s].
};

struct HapticsConfig : haptics::PassivitySettings {
  double max_force = haptics::WrenchFilterSettings().max_force;            ///< [N]
  double max_torque = haptics::WrenchFilterSettings().max_torque;          ///< [N m]
  double max_force_rate = haptics::WrenchFilterSettings().max_force_rate;  ///< [N/s]
};

struct Scene {
  std::string file;  ///< Where it was read; relative paths in it start from its folder.
  std::string name;
  Vec3 gravity = Vec3(0.0, 0.0, -9.81);  ///< [m/s^2], world.
  std::vector<OrganConfig> organs;
  std::vector<InstrumentConfig> instruments;
  std::vector<AnatomyConfig> anatomy;
  ContactConfig contact;
  SolverConfig solver;
  RatesConfig rates;
  HapticsConfig haptics;
};

/// Reads and checks a scene file (not the files it names).
/// @throws InputError with all problems of the file.
Scene readScene(const std::string& file);

/// The instruments follow as those that hands move, which may let go or leap: by their proxies.
void driveByHands(Scene* scene);

/// All keys of the scene and what they are set to, by the file, by default or since.
std::vector<keys::KeyValue> sceneValues(const Scene& scene);

/// docs/scene_format.md, from the list of keys.
std::string sceneFormatMarkdown();

}  // namespace palpate::scene

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

// The scene file as plain data. Defaults are member initialisers of these structs or of settings
// that they contain. scene_fields.cpp lists every key once, for reader, checks and documentation.

struct PoseConfig {
  Vec3 position = Vec3::Zero();        ///< [m]
  Vec3 roll_pitch_yaw = Vec3::Zero();  ///< [rad], about fixed x, y, z

  Pose pose() const { return poseFromXyzRpy(position, roll_pitch_yaw); }
};

/// The body's frame is the organ's frame, after scaling.
struct OrganConfig : BodyConfig {
  std::string name;
  std::string surface;           ///< Surface file; exclusive with `tetrahedra`.
  std::string tetrahedra;        ///< Tetrahedra file, or the source of `cloth`.
  double scale = 1.0;            ///< File unit to metre.
  EdgeLengthConfig edge_length;  ///< Of tetrahedra made from a surface.
  PoseConfig pose;               ///< Maps organ to world frame.
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
  bool active = false;  ///< In replays; always on in the live node.
};

/// Haptic device of an instrument.
struct DeviceConfig : haptics::DeviceSettings {
  std::string model = "other";  ///< One of haptics::deviceModelNames().
};

/// Continuous limits of an instrument's device; 0: those of HapticsConfig.
struct LimitsConfig {
  double max_force = 0.0;       ///< [N]
  double max_torque = 0.0;      ///< [N m]
  double max_force_rate = 0.0;  ///< [N/s]
};

/// Conversion of a mesh to a rigid shape.
struct MeshShapeConfig : instrument::MeshShapeSettings {};

/// Link of an instrument that penetrates tissue, with its settings.
struct NeedleConfig : contact::NeedleSettings {
  std::string link;  ///< Its collision shapes must be capsules or cylinders; empty: none.
};

struct InstrumentConfig {
  std::string name;
  std::string urdf;
  PoseConfig base;               ///< Maps the URDF's root link to world frame (for joint input).
  std::string input = "joints";  ///< joints | tf
  std::string joint_topic;       ///< Empty: <name>/measured_js.
  std::string tf_prefix;         ///< Prefix of link names in tf.
  std::string control_frame;     ///< Link at which the wrench is given.
  bool cylinder_as_capsule = instrument::InstrumentOptions().cylinder_as_capsule;
  MeshShapeConfig collision_meshes;
  NeedleConfig needle;
  ProxyConfig proxy;
  DeviceConfig device;
  LimitsConfig limits;
};

/// A fixed rigid body, for example bone, in the file's frame after scaling.
struct AnatomyConfig {
  std::string name;
  std::string surface;  ///< Surface file.
  double scale = 1.0;   ///< File unit to metre.
  PoseConfig pose;      ///< Maps its frame to world frame.
  /// Contact stiffness for tools [N/m]: the strongest known device, with 20 N (docs/devices.md),
  /// presses a tool in by 1 mm. haptics::VirtualCoupling renders less, for weaker devices.
  double felt_stiffness = 2.0e4;
  MeshShapeConfig shape;
};

/// Friction of named contact partners; an empty name matches any.
struct FrictionPairConfig : contact::Friction {
  std::string organ, instrument, link, anatomy;
};

struct FrictionConfig : contact::Friction {
  std::vector<FrictionPairConfig> pairs;  ///< The most specific applies, then the last.
};

struct ContactConfig : contact::ResponseSettings, tissue::TouchingOrgans {
  double sample_spacing = 0.0;  ///< Largest spacing of contact samples on the surface [m]; 0: half
                                ///< the inscribed radius of the thinnest tool or anatomy part,
                                ///< which may then have samples of its own.
  FrictionConfig friction;
};

struct SkipConfig : tissue::SkipSwitches {
  bool unwatched_markers = true;
};

struct SolverConfig : solver::StepSettings {
  int threads = 1;
  bool thread_for_tasks = false;  ///< Extra thread for background tasks; set by the node.
  double deadline = 2.0;          ///< Of a live step, over 1/rates.simulation [-]; 0: none.
  SkipConfig skip;
};

struct RatesConfig {
  double simulation = 100.0;  ///< Upper limit [Hz].
  double haptic = 1000.0;     ///< [Hz]
  double markers = 30.0;      ///< Upper limit [Hz].
  double stale_after = 0.2;   ///< Input age that pauses [s].
  double coarsening = 2.0;    ///< Largest live factor of adapt.finest, under load [-].
  int catch_up = 5;           ///< Most cycles that a live step covers, after late ones [-].
  double ramp = haptics::WrenchFilterSettings().ramp;  ///< Fade time of the wrench [s].
};

struct HapticsConfig : haptics::PassivitySettings {
  double max_force = haptics::WrenchFilterSettings().max_force;            ///< [N]
  double max_torque = haptics::WrenchFilterSettings().max_torque;          ///< [N m]
  double max_force_rate = haptics::WrenchFilterSettings().max_force_rate;  ///< [N/s]
};

struct Scene {
  std::string file;  ///< Path of the scene file; relative paths in it start from its folder.
  std::string name;
  Vec3 gravity = Vec3(0.0, 0.0, -9.81);  ///< In the world frame [m/s^2].
  std::vector<OrganConfig> organs;
  std::vector<InstrumentConfig> instruments;
  std::vector<AnatomyConfig> anatomy;
  ContactConfig contact;
  SolverConfig solver;
  RatesConfig rates;
  HapticsConfig haptics;
};

/// Reads and checks a scene file, but not the files that it names.
/// @throws InputError with all problems of the file.
Scene readScene(const std::string& file);

/// Makes all instruments follow their commands by proxies, since hands may let go or jump.
void driveByHands(Scene* scene);

/// All keys of the scene with their present values.
std::vector<keys::KeyValue> sceneValues(const Scene& scene);

/// Text of docs/scene_format.md, from the keys.
std::string sceneFormatMarkdown();

}  // namespace palpate::scene

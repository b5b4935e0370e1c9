// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/scene/scene_fields.h"

#include <algorithm>

#include "friction_keys.h"
#include "palpate/contact/contact_models.h"
#include "palpate/fem/elasticity.h"
#include "palpate/haptics/device_models.h"
#include "palpate/solver/integrator.h"
#include "palpate/tissue/fem/fem_tissue.h"
#include "palpate/tissue/model_list.h"
#include "palpate/tissue/skips.h"
#include "prescribed_contact_rules.h"

namespace palpate::scene {

void describe(keys::FieldVisitor& v, PoseConfig& pose) {
  v.vector3({"position", "m", "Origin of the frame in the outer frame."}, pose.position,
            keys::coordinateRange());
  v.vector3({"roll_pitch_yaw", "rad",
             "Turns about the outer frame's fixed x, then y, then z axis, as in URDF."},
            pose.roll_pitch_yaw, keys::Range::closed(-10.0, 10.0));
}

namespace {

// Sources of an organ's mesh.
void describeSource(keys::FieldVisitor& v, const OrganConfig& organ, bool surface,
                    bool tetrahedra) {
  const bool cloth = organ.model == "cloth";
  v.rule(cloth ? surface != organ.cloth.made() : surface != tetrahedra, "",
         cloth ? "model cloth needs either a surface or cloth.width, .length and .spacing"
               : "needs exactly one of surface, tetrahedra");
  v.rule(!(cloth && tetrahedra), "tetrahedra", "model cloth is a sheet, and takes no tetrahedra");
  v.rule(!cloth || organ.cloth.thickness > 0.0, "cloth.thickness", "model cloth needs one above 0");
  v.rule(cloth || !organ.cloth.made(), "cloth.width", "is for model cloth");
}

}  // namespace

void describe(keys::FieldVisitor& v, OrganConfig& organ) {
  v.name({"name", "", "Names the organ in markers and reports.", keys::Need::kRequired},
         organ.name);
  const bool surface = v.text({"surface", "",
                               "Closed surface to be filled with tetrahedra, or of model `cloth` "
                               "the sheet, open or closed, "
                               "as it is: .obj, .off, .stl, .ply or .wrl; a path from "
                               "the scene's folder, absolute, `file://` or `package://`."},
                              organ.surface);
  const bool tetrahedra = v.text({"tetrahedra", "",
                                  "Mesh that is used as it is: .msh, .vtk, .vtu or .mesh; a path "
                                  "as for `surface`."},
                                 organ.tetrahedra);
  v.number({"scale", "", "Metres in one unit of the file: 0.001 for a mesh in millimetres."},
           organ.scale, keys::Range::above(0.0, 1.0e6));
  v.numberOrSection({"edge_length", "m",
                     "Wanted length of the tetrahedra's edges where a surface is filled, of model "
                     "`bem` of the surface's; a number is the section's `coarsest` and holds "
                     "everywhere."},
                    organ.edge_length.coarsest, edgeLengthRange(), organ.edge_length);
  v.rule(surface || organ.edge_length.uniform(), "edge_length",
         "near needs a surface; tetrahedra are used as they are");
  v.section({"pose", "", "The organ's frame in the world."}, organ.pose);
  v.choice({"model", "", "What computes the organ's deformation."}, organ.model,
           tissue::modelNames());
  v.choice({"element", "", "Finite element, of models `fem` and `enriched`."}, organ.element,
           fem::elementNames());
  v.section({"adapt", "",
             "Mesh adaptation of model `fem`: tetrahedra are refined near tools, before they "
             "touch, and coarsened behind them."},
            organ.adapt);
  v.section(
      {"springs", "", "Settings of models `mass_spring` and `cloth`: springs and integrator."},
      organ.springs);
  v.section({"cloth", "", "Settings of model `cloth`: the sheet and its initial positions."},
            organ.cloth);
  describeSource(v, organ, surface, tetrahedra);
  v.section({"sampling", "", "Settings of model `sampled_elasticity`."}, organ.sampling);
  v.section({"honeycomb", "", "Settings of model `honeycomb`."}, organ.honeycomb);
  v.section({"hybrid", "", "Settings of model `hybrid`."}, organ.hybrid);
  v.section(
      {"enriched", "", "Settings of model `enriched`: the fine surface and its training data."},
      organ.enriched);
  v.section({"neural", "",
             "Settings of model `neural`: the surrogate, and when finite elements take over."},
            organ.neural);
  describe(v, static_cast<BodyConfig&>(organ));
  v.rule(organ.model != "cloth" || organ.regions.empty(), "regions",
         "model cloth has one material; leave regions out");
  v.rule(organ.model != "bem" || organ.regions.empty(), "regions",
         "model bem has one material; leave regions out");
  v.section({"damping", "", "Rayleigh damping, in addition to the material's own viscosity."},
            organ.damping);
  v.list({"supports", "", "What holds the organ; it needs some where there is gravity."},
         organ.supports, 0);
  v.list(
      {"pressure", "", "What presses on the organ from inside, or from outside; pressures add up."},
      organ.pressure, 0);
}

void describe(keys::FieldVisitor& v, ProxyConfig& proxy) {
  v.flag({"active", "", "In replays too; live it always is."}, proxy.active);
  v.number({"max_speed", "m/s", "Of the control frame."}, proxy.max_speed,
           keys::Range::above(0.0, 100.0));
  v.number({"max_acceleration", "m/s^2", "Of the control frame."}, proxy.max_acceleration,
           keys::Range::above(0.0, 1.0e6));
  v.number({"max_angular_speed", "rad/s", "Of the tool, and of its links to one another."},
           proxy.max_angular_speed, keys::Range::above(0.0, 1000.0));
  v.number({"max_angular_acceleration", "rad/s^2", "Of the tool."}, proxy.max_angular_acceleration,
           keys::Range::above(0.0, 1.0e7));
  v.number({"coupling_stiffness", "N/m",
            "Live, the hand is drawn to a tool that could not follow it by this spring."},
           proxy.coupling_stiffness, keys::Range::closed(0.0, 1.0e5));
  v.number({"coupling_force", "N", "With no more than this."}, proxy.coupling_force,
           keys::Range::closed(0.0, 1000.0));
}

void describe(keys::FieldVisitor& v, DeviceConfig& device) {
  v.choice({"model", "", "Has limits of force and torque, see [devices.md](devices.md)."},
           device.model, haptics::deviceModelNames());
  v.number({"mass", "kg", "Apparent at the handle, without the hand."}, device.mass,
           keys::Range::above(0.0, 100.0));
  v.number({"damping", "N s/m", "Of the device itself, at the handle."}, device.damping,
           keys::Range::closed(0.0, 1000.0));
  v.number({"delay", "s",
            "From a pose measured to the force that answers it, on the wires there and back."},
           device.delay, keys::Range::closed(0.0, haptics::PassivityController::kLongestDelay));
  v.number({"rate", "Hz", "It reports poses and takes forces so often."}, device.rate,
           keys::Range::above(0.0, 1.0e5));
}

void describe(keys::FieldVisitor& v, LimitsConfig& limits) {
  v.number(
      {"max_force", "N",
       "A longer force is shortened to this; 0: that of `device.model`, else `haptics.max_force`."},
      limits.max_force, keys::Range::closed(0.0, 1000.0));
  v.number({"max_torque", "N m",
            "A longer torque is shortened to this; 0: that of `device.model`, else "
            "`haptics.max_torque`."},
           limits.max_torque, keys::Range::closed(0.0, 1000.0));
  v.number({"max_force_rate", "N/s",
            "The force to the hand changes no faster; 0: `haptics.max_force_rate`."},
           limits.max_force_rate, keys::Range::closed(0.0, 1.0e6));
}

void describe(keys::FieldVisitor& v, NeedleConfig& needle) {
  v.text({"link", "",
          "Its collision shapes are cylinders; their axis is the needle's. Empty: there is none."},
         needle.link);
  v.number({"puncture_force", "N", "Along the axis, with which the tip gets through a surface."},
           needle.puncture_force, keys::Range::closed(0.0, 100.0));
  v.number({"cutting_force", "N", "That the tip needs to go on."}, needle.cutting_force,
           keys::Range::closed(0.0, 100.0));
  v.number({"shaft_friction", "N/m", "Along the shaft, per length that is inside."},
           needle.shaft_friction, keys::Range::closed(0.0, 1.0e4));
}

void describe(keys::FieldVisitor& v, InstrumentConfig& instrument) {
  v.name({"name", "", "Names the instrument in topics and result files.", keys::Need::kRequired},
         instrument.name);
  v.text({"urdf", "",
          "Robot description: a path from the scene's folder, absolute, `file://` or `package://`.",
          keys::Need::kRequired},
         instrument.urdf);
  v.section({"base", "", "The URDF's root link in the world; used with joint input."},
            instrument.base);
  v.choice({"input", "",
            "Where the pose comes from: joint positions from a topic, or the frames of the links "
            "from tf."},
           instrument.input, {"joints", "tf"});
  v.text({"joint_topic", "",
          "Topic of sensor_msgs/JointState; by default the instrument's name and "
          "`/measured_js`."},
         instrument.joint_topic);
  v.text({"tf_prefix", "",
          "Put before the links' names in tf. An instrument with joint input that has a frame in "
          "common with another one gets its name and `/` before this."},
         instrument.tf_prefix);
  v.text({"control_frame", "", "Link at whose origin the wrench is given.", keys::Need::kRequired},
         instrument.control_frame);
  v.flag({"cylinder_as_capsule", "",
          "Give cylinders round ends for contact, which is smooth; the ends stay inside the "
          "cylinder's length. Else their ends are flat."},
         instrument.cylinder_as_capsule);
  v.section({"collision_meshes", "",
             "Collision meshes that are not convex. One that is, within a thousandth of its "
             "diagonal, is its convex hull, exactly."},
            instrument.collision_meshes);
  v.section({"needle", "", "A link that goes into tissue."}, instrument.needle);
  v.section({"proxy", "",
             "How fast the simulated tool may follow: it goes where the input says, but never by a "
             "jump, and comes only where it touches nothing."},
            instrument.proxy);
  v.section(
      {"device", "",
       "Through which it is felt. Tissue that is stiffer than such a device can render without "
       "swinging is felt through a spring."},
      instrument.device);
  v.section({"limits", "", "What this instrument's device sustains, where it is not that of all."},
            instrument.limits);
}

void describe(keys::FieldVisitor& v, ContactConfig& contact) {
  v.choice(
      {"model", "",
       "What answers where tissue and tools touch. `prescribed`: nothing; the tool is a segment, "
       "and where it meets the surface the tissue goes with it, of method `newton_bicgstab`."},
      contact.model, contact::contactModelNames());
  v.number({"stiffness", "Pa/m",
            "Contact pressure per penetration. `augmented_lagrangian` takes more where the tissue "
            "asks for it."},
           contact.stiffness, keys::Range::above(0.0, 1.0e12));
  v.number({"smoothing", "m",
            "Width of the blend between no contact and pressure that grows "
            "linearly."},
           contact.smoothing, keys::Range::above(0.0, 0.1));
  v.number(
      {"sample_spacing", "m",
       "Largest distance between the points of the tissue surface that can touch; 0: half the "
       "inscribed radius of the thinnest tool shape, and for the anatomy of its thinnest part, at "
       "least 0.5 mm. An edge has 3 to 32 parts. Where they are farther apart than a tool is "
       "thick, or than 1.5 mm and it has edges, the tool's own points, with edges rounded off by "
       "0.2 mm, meet the triangles."},
      contact.sample_spacing, keys::Range::closed(0.0, 1.0));
  v.section({"friction", "",
             "What keeps organs from sliding along instruments and anatomy. Not of method "
             "`newton_bicgstab`."},
            contact.friction);
  describe(v, static_cast<tissue::TouchingOrgans&>(contact));
}

void describe(keys::FieldVisitor& v, SolverConfig& solver) {
  v.choice({"method", "", "How a cycle of model `fem` is solved."}, solver.method,
           tissue::methodNames());
  v.choice({"integrator", "", "Time integration."}, solver.integrator, solver::integratorNames());
  v.number({"step", "s", "Length of a cycle when live, longest cycle in a replay."}, solver.step,
           keys::Range::above(0.0, 0.1));
  v.number({"tolerance", "",
            "Newton's iteration ends when the unbalanced force is this part of the forces."},
           solver.tolerance, keys::Range::closed(1.0e-14, 0.1));
  v.number({"position_tolerance", "m",
            "It also ends when the unbalanced force would move no node farther than this, in the "
            "time a shear wave takes through the organ."},
           solver.position_tolerance, keys::Range::closed(1.0e-15, 1.0e-3));
  v.integer({"max_newton_iterations", "",
             "Newton iterations in a solve; a cycle has four times as many for all of its solves, "
             "and more where it is solved in parts."},
            solver.max_newton_iterations, keys::Range::closed(1, 1000));
  v.number(
      {"linear_tolerance", "",
       "The linear solver ends when its residual is this part of what it began with, or less where "
       "Newton's steps are good (Eisenstat, Walker 1996)."},
      solver.linear_tolerance, keys::Range::closed(1.0e-14, 0.9));
  v.integer({"max_linear_iterations", "", "Iterations of the linear solver in a Newton iteration."},
            solver.max_linear_iterations, keys::Range::closed(1, 100000));
  v.integer({"threads", "",
             "Threads that share the work; the results are the same bits for any. The node takes "
             "at most one less than the "
             "host has cores."},
            solver.threads, keys::Range::closed(1, 256));
  v.number(
      {"deadline", "",
       "So many times 1/rates.simulation a live cycle waits for its step; then the node goes on, "
       "the force as the last step told it, and later cycles wait for it. 0: however long."},
      solver.deadline, keys::Range::closed(0.0, 100.0));
  v.section(
      {"skip", "",
       "Work to leave out where it is not needed. `false` has it done all the same, to compare "
       "results and times."},
      solver.skip);
}

void describe(keys::FieldVisitor& v, SkipConfig& skip) {
  for (const tissue::Skip& s : tissue::skips()) {
    if (s.key) v.flag({s.key, "", s.doc}, skip.*s.on);
  }
  v.flag({"unwatched_markers", "",
          "Pictures that nobody subscribes to; only `palpate_node` makes any."},
         skip.unwatched_markers);
}

void describe(keys::FieldVisitor& v, RatesConfig& rates) {
  v.number({"simulation", "Hz", "Cycles in a second, at most."}, rates.simulation,
           keys::Range::above(0.0, 10000.0));
  v.number({"haptic", "Hz", "Wrenches published in a second."}, rates.haptic,
           keys::Range::above(0.0, 10000.0));
  v.number({"markers", "Hz", "Pictures published in a second, at most."}, rates.markers,
           keys::Range::above(0.0, 1000.0));
  v.number({"stale_after", "s", "Input older than this pauses the simulation."}, rates.stale_after,
           keys::Range::above(0.0, 10.0));
  v.integer(
      {"catch_up", "",
       "Most cycles that one live step covers, after a late one, so that simulated time keeps "
       "up with real time; 1: each step is solver.step, and meshes that adapt are waited for, "
       "as in a replay. Models with steps of their own always have 1."},
      rates.catch_up, keys::Range::closed(1, 20));
  v.number({"coarsening", "",
            "Largest factor by which adapt.finest grows live while cycles are late; 1: it never "
            "does. step_report has the edge length in effect."},
           rates.coarsening, keys::Range::closed(1.0, 10.0));
  v.number({"ramp", "s",
            "Time in which the wrench goes to zero and comes back at a pause or a failed solve."},
           rates.ramp, keys::Range::above(0.0, 10.0));
}

void describe(keys::FieldVisitor& v, HapticsConfig& haptics) {
  v.number({"max_force", "N", "A longer force is shortened to this."}, haptics.max_force,
           keys::Range::above(0.0, 1000.0));
  v.number({"max_torque", "N m", "A longer torque is shortened to this."}, haptics.max_torque,
           keys::Range::above(0.0, 1000.0));
  v.number({"max_force_rate", "N/s", "The force to the hand changes no faster."},
           haptics.max_force_rate, keys::Range::above(0.0, 1.0e6));
  v.number({"max_damping", "N s/m",
            "Where more energy comes out of a wrench than went in, it is taken back by damping, at "
            "most so much; 0: by none."},
           haptics.max_damping, keys::Range::closed(0.0, 100.0));
}

namespace {

// Pairs of organs without contact.
void checkPairs(keys::FieldVisitor& v, const Scene& scene) {
  const auto known = [&](const std::string& name) {
    return std::any_of(scene.organs.begin(), scene.organs.end(),
                       [&](const OrganConfig& organ) { return organ.name == name; });
  };
  const std::string text = "must be the names of organs";
  v.rule(true, "contact.apart", "contact.apart: names in it " + text);
  for (std::size_t k = 0; k < scene.contact.apart.size(); ++k) {
    const tissue::OrganPair& pair = scene.contact.apart[k];
    if (known(pair.organ) && known(pair.other)) continue;
    v.rule(false, "contact.apart[" + std::to_string(k) + "]",
           pair.organ + ", " + pair.other + ": " + text);
  }
}

}  // namespace

void describe(keys::FieldVisitor& v, Scene& scene) {
  v.text({"name", "", "Title of the scene."}, scene.name);
  v.vector3({"gravity", "m/s^2", "Acceleration of free fall, in the world."}, scene.gravity,
            keys::Range::closed(-1000.0, 1000.0));
  v.list({"organs", "", "Soft bodies.", keys::Need::kRequired}, scene.organs, 1);
  v.uniqueNames("organs", scene.organs);
  v.list({"instruments", "", "Rigid tools."}, scene.instruments, 0);
  v.uniqueNames("instruments", scene.instruments);
  v.list({"anatomy", "", "Rigid bodies that never move: bone and the like."}, scene.anatomy, 0);
  v.uniqueNames("anatomy", scene.anatomy);
  v.section({"contact", "", "Contact of organs with instruments and with each other."},
            scene.contact);
  checkPairs(v, scene);
  checkFrictionPairs(v, scene);
  v.section({"solver", "", "Time steps and accuracy."}, scene.solver);
  checkPrescribedContact(v, scene);
  v.section({"rates", "", "How often the node does what, and when input is too old."}, scene.rates);
  v.section({"haptics", "", "Limits of what the hand gets."}, scene.haptics);
}

}  // namespace palpate::scene

// SPDX-License-Identifier: GPL-3.0-or-later
#include "node_help.h"

#include "params.h"
#include "ros/messages/topics.h"

namespace palpate::node {
namespace {

constexpr char kWrench[] = "geometry_msgs/WrenchStamped";
constexpr char kPictures[] = "visualization_msgs/MarkerArray";
constexpr char kTrigger[] = "std_srvs/Trigger";

std::string ofInstrument(const char* topic) { return instrumentTopic("<instrument>", topic); }

}  // namespace

About aboutNode() {
  About about;
  about.program = "palpate_node";
  about.what =
      "Instruments that ROS drives touch the organs of a scene. Publishes the wrench that the\n"
      "tissue exerts on each instrument, and the deformed organs.";
  NodeParams defaults;
  about.params.applyHere(defaults);
  about.params.apply(kCutawaySection, defaults.cutaway);
  for (const char* section : kSceneSections) {
    about.params.line(std::string(section) + "/...", "The scene's keys of that name.");
  }
  about.params.line(std::string(kInstrumentsSection) + "/<name>/...",
                    "Keys of an instrument of the scene.");
  about.hears = {
      {ofInstrument(kMeasuredJoints), "sensor_msgs/JointState",
       "joint positions [m], [rad]; another topic by the scene's joint_topic"},
      {"/tf, /tf_static", "tf2_msgs/TFMessage", "frames of the links, of a scene with input: tf"}};
  about.says = {
      {ofInstrument(kSpatialWrench), kWrench, "tissue on tool, axes of world [N], [N m]"},
      {ofInstrument(kBodyWrench), kWrench, "tissue on tool, axes of the control frame"},
      {ofInstrument(kContactModel), "palpate/ContactModel", "force near the pose of a solve"},
      {kOrgansTopic, kPictures, "organs, contacts and wrenches"},
      {kCutawayTopic, kPictures, "organs cut open"},
      {kAnatomyTopic, kPictures, "bone and the like, once, latched"},
      {kStateTopic, "visualization_msgs/Marker", "why there is no force, latched"},
      {kRvizTopic, "std_msgs/String", "a configuration of rviz for the scene, once, latched"},
      {"/tf, /tf_static", "tf2_msgs/TFMessage",
       "frames of the links, of a scene with input: joints"},
      {kStepReportTopic, "palpate/StepReport", "what each cycle did"},
      {kRunRecordTopic, "palpate/RunRecord", "what is simulated, once, latched"},
      {"/diagnostics", "diagnostic_msgs/DiagnosticArray", "states and rates, 1 Hz"}};
  about.serves = {{std::string("~") + kResetService, kTrigger, "back to the rest state"},
                  {std::string("~") + kSaveStateService, kTrigger,
                   "the simulation's state to a file in ~state_directory"}};
  return about;
}

}  // namespace palpate::node

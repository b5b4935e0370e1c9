// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "palpate/scene/scene.h"

namespace palpate::node {

// Names that the node gives to the ROS graph. Relative ones are in the node's namespace.

inline constexpr char kWorldFrame[] = "world";

inline constexpr char kOrgansTopic[] = "organs";           ///< visualization_msgs/MarkerArray
inline constexpr char kAnatomyTopic[] = "anatomy";         ///< visualization_msgs/MarkerArray
inline constexpr char kCutawayTopic[] = "cutaway";         ///< visualization_msgs/MarkerArray
inline constexpr char kStateTopic[] = "state_text";        ///< visualization_msgs/Marker
inline constexpr char kRvizTopic[] = "rviz_config";        ///< std_msgs/String
inline constexpr char kStepReportTopic[] = "step_report";  ///< palpate/StepReport
inline constexpr char kRunRecordTopic[] = "run_record";    ///< palpate/RunRecord
inline constexpr char kMeasuredJoints[] = "measured_js";   ///< sensor_msgs/JointState, default
inline constexpr char kSpatialWrench[] = "spatial/measured_cf";  ///< geometry_msgs/WrenchStamped
inline constexpr char kBodyWrench[] = "body/measured_cf";        ///< geometry_msgs/WrenchStamped

inline constexpr char kContactModel[] = "contact_model";  ///< palpate/ContactModel

inline constexpr char kResetService[] = "reset";           ///< std_srvs/Trigger, private
inline constexpr char kSaveStateService[] = "save_state";  ///< std_srvs/Trigger, private

// Namespaces of the markers in kOrgansTopic.
inline constexpr char kOrganMarkers[] = "organs";
inline constexpr char kContactMarkers[] = "contacts";
inline constexpr char kWrenchMarkers[] = "wrench";
// In kCutawayTopic.
inline constexpr char kCutMarkers[] = "cut";
inline constexpr char kNodeMarkers[] = "nodes";
// And in kAnatomyTopic and kStateTopic.
inline constexpr char kAnatomyMarkers[] = "anatomy";
inline constexpr char kStateMarkers[] = "state";

inline constexpr char kRobotDescription[] = "robot_description";  ///< Parameter of an instrument.

/// "<instrument>/<name>".
inline std::string instrumentTopic(const std::string& instrument, const char* name) {
  return instrument + "/" + name;
}

/// A topic's name with a "/" before it, which names in bags and scenes have or not.
inline std::string absoluteTopic(const std::string& topic) {
  return topic.empty() || topic.front() != '/' ? "/" + topic : topic;
}

/// A frame's name without the "/" before it that names of before tf2 have.
inline std::string frameName(const std::string& frame) {
  return frame.empty() || frame.front() != '/' ? frame : frame.substr(1);
}

/// Where the joint positions of an instrument come from.
inline std::string jointTopic(const scene::InstrumentConfig& instrument) {
  return instrument.joint_topic.empty() ? instrumentTopic(instrument.name, kMeasuredJoints)
                                        : instrument.joint_topic;
}

}  // namespace palpate::node

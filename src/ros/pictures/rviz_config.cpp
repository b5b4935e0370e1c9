// SPDX-License-Identifier: GPL-3.0-or-later
#include "rviz_config.h"

#include <cmath>
#include <sstream>

#include "ros/messages/topics.h"

namespace palpate::node {
namespace {

/// 1, 2 or 5 times a power of ten, not above `x` > 0.
double roundNumber(double x) {
  const double power = std::pow(10.0, std::floor(std::log10(x)));
  const double digit = x / power;
  return power * (digit < 2.0 ? 1.0 : digit < 5.0 ? 2.0 : 5.0);
}

class ConfigWriter {
 public:
  ConfigWriter() { out_.precision(6); }
  std::string text() const { return out_.str(); }

  void begin(const char* type, const std::string& name, bool enabled) {
    out_ << "    - Class: rviz/" << type << "\n      Name: " << name;
    key("Enabled", enabled);
    key("Value", enabled);
  }
  template <class Value>
  void key(const char* name, const Value& value) {
    out_ << "\n      " << name << ": " << std::boolalpha << value;
  }
  void end() { out_ << "\n"; }
  std::ostream& raw() { return out_; }

 private:
  std::ostringstream out_;
};

void writeGrid(const View& view, ConfigWriter* w) {
  w->begin("Grid", "Grid", true);
  w->key("Alpha", 0.35);
  w->key("Cell Size", roundNumber(0.3 * view.size()));
  w->key("Color", "130; 140; 155");
  w->key("Plane", "XY");
  w->key("Plane Cell Count", 12);
  w->key("Reference Frame", kWorldFrame);
  w->end();
}

void writeMarkers(const std::string& name, const std::string& topic, const std::string& namespaces,
                  bool enabled, ConfigWriter* w) {
  w->begin("MarkerArray", name, enabled);
  w->key("Marker Topic", topic);
  w->key("Queue Size", 1);
  w->key("Namespaces", "{" + namespaces + "}");
  w->end();
}

void writeTool(const RvizNames::Tool& tool, ConfigWriter* w) {
  w->begin("RobotModel", "Instrument " + tool.name, true);
  w->key("Robot Description", tool.description);
  w->key("TF Prefix", "\"\"");  // is in the names of the links
  w->key("Update Interval", 0);
  w->key("Visual Enabled", true);
  w->key("Collision Enabled", false);
  w->end();
}

// Wrenches in the control frame: of those in world rviz would draw the arrow at the origin.
void writeWrench(const RvizNames::Tool& tool, const View& view, ConfigWriter* w) {
  w->begin("WrenchStamped", "Wrench with torque of " + tool.name, false);
  w->key("Topic", tool.wrench);
  w->key("Queue Size", 100);  // until tf has come
  w->key("Force Arrow Scale", view.arrow_scale);
  w->key("Force Color", "40; 220; 115");
  w->key("Torque Arrow Scale", 10.0 * view.arrow_scale / view.size());  // as a force at a tenth
  w->key("Torque Color", "240; 200; 60");
  w->key("Arrow Width", 0.1 * view.size());
  w->key("Hide Small Values", true);
  w->key("History Length", 1);
  w->end();
}

void writeFrames(const View& view, ConfigWriter* w) {
  w->begin("TF", "Frames", false);
  w->key("Marker Scale", view.size());
  w->key("Show Arrows", false);
  w->end();
}

}  // namespace

std::string rvizConfig(const View& view, const RvizNames& names) {
  ConfigWriter w;
  w.raw() << R"(Panels:
  - Class: rviz/Displays
    Name: Displays
    Splitter Ratio: 0.5
    Tree Height: 400
    Help Height: 0
Visualization Manager:
  Class: ""
  Displays:
)";
  writeGrid(view, &w);
  writeMarkers("Organs, contacts, forces", names.organs,
               "contacts: true, organs: true, wrench: true", true, &w);
  writeMarkers("Organs cut open, with nodes", names.cutaway, "cut: true, nodes: true", false, &w);
  writeMarkers("Anatomy", names.anatomy, "anatomy: true", true, &w);
  w.begin("Marker", "State", true);
  w.key("Marker Topic", names.state);
  w.key("Queue Size", 1);
  w.end();
  for (const RvizNames::Tool& tool : names.tools) writeTool(tool, &w);
  for (const RvizNames::Tool& tool : names.tools) writeWrench(tool, view, &w);
  writeFrames(view, &w);
  w.raw() << R"(  Enabled: true
  Global Options:
    Background Color: 32; 36; 44
    Default Light: true
    Fixed Frame: )"
          << kWorldFrame << R"(
    Frame Rate: 30
  Name: root
  Tools:
    - Class: rviz/MoveCamera
    - Class: rviz/Select
    - Class: rviz/Measure
  Value: true
  Views:
    Current:
      Class: rviz/Orbit
      Name: Current View
      Value: Orbit (rviz)
      Target Frame: <Fixed Frame>
      Field of View: )"
          << kFieldOfView << R"(
      Distance: )"
          << view.distance << R"(
      Focal Point: {X: )"
          << view.focus.x() << ", Y: " << view.focus.y() << ", Z: " << view.focus.z() << R"(}
      Focal Shape Fixed Size: true
      Focal Shape Size: )"
          << 0.05 * view.size() << R"(
      Near Clip Distance: )"
          << 0.01 * view.distance << R"(
      Pitch: )"
          << view.pitch << R"(
      Yaw: )"
          << view.yaw << R"(
    Saved: ~
Window Geometry:
  Hide Left Dock: true
  Hide Right Dock: true
  Height: 800
  Width: 1280
  X: 0
  Y: 0
)";
  return w.text();
}

}  // namespace palpate::node

// SPDX-License-Identifier: GPL-3.0-or-later
// The tables of topics, services and parameters in docs/node.md say what the node has.
#include <gtest/gtest.h>
#include <ros/message_traits.h>
#include <ros/service_traits.h>

#include <algorithm>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "diagnostic_msgs/DiagnosticArray.h"
#include "geometry_msgs/WrenchStamped.h"
#include "palpate/ContactModel.h"
#include "palpate/RunRecord.h"
#include "palpate/StepReport.h"
#include "palpate/base/number.h"
#include "ros/messages/topics.h"
#include "ros/node/params.h"
#include "sensor_msgs/JointState.h"
#include "std_msgs/String.h"
#include "std_srvs/Trigger.h"
#include "support/source_folder.h"
#include "support/temp_folder.h"
#include "tf2_msgs/TFMessage.h"
#include "visualization_msgs/MarkerArray.h"

namespace palpate::node::node_page_test {
namespace {

using Row = std::vector<std::string>;  // cells

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(' ');
  return first == std::string::npos ? ""
                                    : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

/// The rows of all tables below a heading, without their heads, by the first cell.
std::map<std::string, Row> tablesBelow(const std::string& heading) {
  std::istringstream page(test::fileBytes(test::sourceFolder() + "/docs/node.md"));
  std::map<std::string, Row> rows;
  bool here = false, head = true;
  for (std::string line; std::getline(page, line);) {
    if (line.rfind("## ", 0) == 0) here = line == "## " + heading;
    if (!here || line.empty() || line[0] != '|') {
      head = true;
      continue;
    }
    if (line[1] == '-') head = false;
    if (head || line[1] == '-') continue;
    Row row;
    std::istringstream cells(line.substr(1));
    for (std::string cell; std::getline(cells, cell, '|');) row.push_back(trimmed(cell));
    rows[row.at(0)] = row;
  }
  return rows;
}

template <class Message>
std::string typeOf() {
  return ros::message_traits::DataType<Message>::value();
}

std::string code(const std::string& text) { return "`" + text + "`"; }

/// The type in a cell, which may be a link: [type](file).
std::string typeIn(const std::string& cell) {
  return cell.rfind('[', 0) == 0 ? cell.substr(1, cell.find(']') - 1) : cell;
}

TEST(NodePage, HasTheTopicsAndServicesOfTheNode) {
  const std::string wrench = typeOf<geometry_msgs::WrenchStamped>();
  const std::string trigger = ros::service_traits::DataType<std_srvs::Trigger>::value();
  const std::map<std::string, std::string> expected = {
      {code(instrumentTopic("<instrument>", kMeasuredJoints)), typeOf<sensor_msgs::JointState>()},
      {"`/tf`, `/tf_static`", typeOf<tf2_msgs::TFMessage>()},
      {code(instrumentTopic("<instrument>", kSpatialWrench)), wrench},
      {code(instrumentTopic("<instrument>", kBodyWrench)), wrench},
      {code(instrumentTopic("<instrument>", kContactModel)), typeOf<palpate::ContactModel>()},
      {code(kAnatomyTopic), typeOf<visualization_msgs::MarkerArray>()},
      {code(kCutawayTopic), typeOf<visualization_msgs::MarkerArray>()},
      {code(kOrgansTopic), typeOf<visualization_msgs::MarkerArray>()},
      {code(kStepReportTopic), typeOf<palpate::StepReport>()},
      {code(kRunRecordTopic), typeOf<palpate::RunRecord>()},
      {code(kStateTopic), typeOf<visualization_msgs::Marker>()},
      {code(kRvizTopic), typeOf<std_msgs::String>()},
      {"`/diagnostics`", typeOf<diagnostic_msgs::DiagnosticArray>()},
      {code(std::string("~") + kResetService), trigger},
      {code(std::string("~") + kSaveStateService), trigger}};
  std::map<std::string, std::string> found;
  for (const auto& [name, row] : tablesBelow("Topics and services"))
    found[name] = typeIn(row.at(1));
  EXPECT_EQ(found, expected);
}

TEST(NodePage, HasTheRatesAndFramesOfTheTopics) {
  std::map<std::string, Row> rows = tablesBelow("Topics and services");
  const scene::RatesConfig rates;
  const std::string haptic = "`rates.haptic`, " + formatNumber(1e-3 * rates.haptic) + " kHz";
  const std::string markers = "`rates.markers`, " + formatNumber(rates.markers) + " Hz";
  for (const char* topic : {kSpatialWrench, kBodyWrench}) {
    EXPECT_EQ(rows.at(code(instrumentTopic("<instrument>", topic))).at(4), haptic);
  }
  EXPECT_EQ(rows.at(code(kOrgansTopic)).at(4).substr(0, markers.size()), markers);
  const std::string cutaway = "`~cutaway/rate`, " + formatNumber(CutawayConfig().rate) + " Hz";
  EXPECT_EQ(rows.at(code(kCutawayTopic)).at(4).substr(0, cutaway.size()), cutaway);
  for (const char* topic : {kOrgansTopic, kCutawayTopic, kAnatomyTopic, kStepReportTopic}) {
    EXPECT_EQ(rows.at(code(topic)).at(2), code(kWorldFrame));
  }
}

TEST(NodePage, HasTheParametersOfTheNode) {
  const std::map<std::string, Row> rows = tablesBelow("Parameters of `palpate_node`");
  std::vector<std::string> expected, found;
  for (const char* name : kNodeParams) expected.push_back(code(std::string("~") + name));
  for (const char* name : kCutawayParams) {
    expected.push_back(code("~" + std::string(kCutawaySection) + "/" + name));
  }
  std::string sections;
  for (const char* name : kSceneSections) {
    sections += code("~" + std::string(name) + "/...") + ", ";
  }
  expected.push_back(sections + code("~" + std::string(kInstrumentsSection) + "/<name>/..."));
  for (const auto& [name, row] : rows) found.push_back(name);
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(found, expected);
  EXPECT_EQ(rows.at(code(std::string("~") + kArrowScaleParam)).at(1),
            formatNumber(NodeParams().arrow_scale));
}

}  // namespace
}  // namespace palpate::node::node_page_test

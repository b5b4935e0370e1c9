// SPDX-License-Identifier: GPL-3.0-or-later
// palpate_record: writes a bag of what moves the instruments of a palpate_node and what comes of
// it, without pictures, until it is interrupted. Its parameters: --help.
#include <ros/ros.h>
#include <rosbag/recorder.h>

#include <csignal>
#include <exception>
#include <iostream>
#include <optional>
#include <set>
#include <string>

#include "palpate/base/error.h"
#include "ros/guard/master_wait.h"
#include "ros/messages/topics.h"
#include "ros/node/node_scene.h"
#include "ros/program/param_fields.h"
#include "ros/program/program.h"

namespace palpate::node {
namespace {

struct RecordParams {
  NodeSceneParams of;
  std::string bag;
};

void describe(keys::FieldVisitor& v, RecordParams& p) {
  describe(v, p.of);
  v.text({"bag", "", "The file to write; overwritten."}, p.bag);
  v.rule(!p.bag.empty(), "bag", "must be a file to write");
}

About about() {
  About about;
  about.program = "palpate_record";
  about.what =
      "Writes a bag of what moves the instruments of a palpate_node and of what comes of it, "
      "without\n"
      "pictures, until it is interrupted.";
  RecordParams defaults;
  about.params.applyHere(defaults);
  return about;
}

std::set<std::string> topicsOf(const scene::Scene& scene) {
  std::set<std::string> topics = {kStepReportTopic, kRunRecordTopic, "/diagnostics"};
  for (const scene::InstrumentConfig& instrument : scene.instruments) {
    for (const char* name : {kSpatialWrench, kBodyWrench, kContactModel}) {
      topics.insert(instrumentTopic(instrument.name, name));
    }
    if (instrument.input == "tf") {
      topics.insert({"/tf", "/tf_static"});
    } else {
      topics.insert(jointTopic(instrument));
    }
  }
  return topics;
}

int record() {
  const ros::NodeHandle alive;  // ROS runs as long as this
  RecordParams params;
  ParamFields fields(ros::NodeHandle("~"));
  fields.applyHere(params);
  fields.refuseOthers();
  fields.check();
  rosbag::RecorderOptions options;
  options.prefix = params.bag;
  options.append_date = false;
  options.transport_hints.tcpNoDelay();
  for (const std::string& topic : topicsOf(readNodeScene(params.of))) {
    options.topics.push_back(ros::names::resolve(topic));  // rosbag keeps names as they are given
  }
  return rosbag::Recorder(options).run();
}

}  // namespace
}  // namespace palpate::node

int main(int argc, char** argv) {
  using namespace palpate::node;
  if (const std::optional<int> status = answerOptions(argc, argv, about())) return *status;
  try {
    waitForMaster(argc, argv, "palpate_record");
    ros::init(argc, argv, "palpate_record");
    std::signal(SIGTERM, [](int) { ros::requestShutdown(); });
    return record();
  } catch (const palpate::InputError& error) {
    std::cerr << error.what() << '\n';
    return kBadInput;
  } catch (const std::exception& error) {
    std::cerr << "palpate_record: " << error.what() << '\n';
    return 1;
  }
}

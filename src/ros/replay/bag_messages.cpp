// SPDX-License-Identifier: GPL-3.0-or-later
#include "bag_messages.h"

#include <rosbag/view.h>

#include <algorithm>
#include <set>
#include <vector>

#include "bag_check.h"
#include "ros/messages/topics.h"

namespace palpate::node {
namespace {

void checkTopics(const std::string& file, const scene::Scene& scene, const rosbag::Bag& bag) {
  rosbag::View view(bag);
  std::set<std::string> topics;
  for (const rosbag::ConnectionInfo* connection : view.getConnections()) {
    topics.insert(absoluteTopic(connection->topic));
  }
  const std::vector<std::string> there(topics.begin(), topics.end());
  std::vector<Problem> problems;
  if (scene.instruments.empty()) {
    problems.push_back({"", "", "the scene has no instrument to move"});
  }
  for (const scene::InstrumentConfig& instrument : scene.instruments) {
    const std::string wanted =
        instrument.input == "tf" ? "/tf" : absoluteTopic(jointTopic(instrument));
    if (topics.count(wanted) > 0) continue;
    problems.push_back({wanted, "",
                        "has no messages in the bag; topics there: " +
                            (there.empty() ? std::string("none") : joinNames(there))});
  }
  if (!problems.empty()) throw InputError(file, problems);
}

}  // namespace

bool isTf(const std::string& topic) { return absoluteTopic(topic) == "/tf"; }
bool isStaticTf(const std::string& topic) { return absoluteTopic(topic) == "/tf_static"; }

std::string bagProblem(const rosbag::BagException& error) {
  std::string message = error.what();
  std::replace(message.begin(), message.end(), '\n', ' ');
  return message;
}

void openInputBag(const std::string& file, const scene::Scene& scene, rosbag::Bag* bag) {
  checkBag(file);
  try {
    bag->open(file, rosbag::bagmode::Read);
    checkTopics(file, scene, *bag);
  } catch (const rosbag::BagUnindexedException&) {
    throw InputError(file, "", "", "is not indexed (cut off while recording?): run rosbag reindex");
  } catch (const rosbag::BagException& e) {
    throw InputError(file, "", "", "cannot be read as a bag: " + bagProblem(e));
  }
}

}  // namespace palpate::node

// SPDX-License-Identifier: GPL-3.0-or-later
// palpate_rviz [OPTION OF RVIZ...]: waits until palpate_node has loaded its scene and says how rviz
// shows that, on the topic rviz_config; writes it to $ROS_HOME/palpate and becomes rviz.
#include <ros/ros.h>
#include <std_msgs/String.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include "palpate/base/error.h"
#include "ros/guard/master_wait.h"
#include "ros/messages/topics.h"
#include "ros/node/params.h"
#include "ros/program/program.h"
#include "ros/program/program_help.h"

namespace palpate::node {
namespace {

/// "" where the program is to end.
std::string waitForConfig() {
  ros::NodeHandle handle;
  std::string config;
  const ros::Subscriber subscriber = handle.subscribe<std_msgs::String>(
      kRvizTopic, 1, [&](const std_msgs::String::ConstPtr& message) { config = message->data; });
  // By the wall clock: under use_sim_time the clock may stand still.
  while (ros::ok() && config.empty()) {
    ros::spinOnce();
    ros::WallDuration(0.05).sleep();
  }
  return config;
}

/// A file of this node's own, so that two of them do not meet.
std::string write(const std::string& config) {
  std::string name = ros::this_node::getName().substr(1);
  std::replace(name.begin(), name.end(), '/', '_');
  const std::filesystem::path folder = std::filesystem::path(rosHome()) / "palpate";
  std::filesystem::create_directories(folder);
  const std::string file = (folder / (name + ".rviz")).string();
  std::ofstream stream(file);
  stream << config;
  stream.close();
  if (!stream) throw std::runtime_error(file + " cannot be written");
  return file;
}

About aboutThis() {
  About about;
  about.program = "palpate_rviz";
  about.what =
      "Waits until palpate_node has loaded its scene, writes the configuration that the node has\n"
      "made for it to a file of its own in $ROS_HOME/palpate, and becomes rviz with that.\n"
      "Options are those of rviz, such as --fullscreen.\n";
  about.hears = {{kRvizTopic, "std_msgs/String", "the configuration of rviz, of palpate_node"}};
  return about;
}

int run(int argc, char** argv) {
  std::vector<char*> command(argv, argv + argc);  // before ros::init takes its own out
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--help") != 0 && std::strcmp(argv[i], "-h") != 0) continue;
    std::cout << "Usage: palpate_rviz [OPTION OF RVIZ...]\n\n"
              << aboutThis().what << "\n"
              << graphHelp(aboutThis());
    return 0;
  }
  waitForMaster(argc, argv, "palpate_rviz");
  ros::init(argc, argv, "rviz");
  const std::string config = waitForConfig();
  if (config.empty()) return 1;
  std::string file = write(config);
  ros::shutdown();  // rviz registers under the same name
  char program[] = "rviz", option[] = "-d";
  command[0] = program;
  command.insert(command.begin() + 1, {option, file.data()});
  command.push_back(nullptr);
  execvp(program, command.data());
  std::perror(program);
  return 127;
}

}  // namespace
}  // namespace palpate::node

int main(int argc, char** argv) {
  try {
    return palpate::node::run(argc, argv);
  } catch (const palpate::InputError& error) {
    std::cerr << error.what() << '\n';
    return palpate::node::kBadInput;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "palpate_rviz: %s\n", error.what());
    return 1;
  }
}

// SPDX-License-Identifier: GPL-3.0-or-later
// palpate_when_ready SERVICE COMMAND [ARGUMENT...]: waits until the service is there, then becomes
// the command. The node offers its services when the scene is loaded, which may take minutes.
#include <ros/ros.h>
#include <unistd.h>

#include <cstdio>
#include <string>
#include <vector>

int main(int argc, char** argv) {
  std::vector<char*> command;  // without what roslaunch adds
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    const bool added = argument.rfind("__", 0) == 0 && argument.find(":=") != std::string::npos;
    if (!added) command.push_back(argv[i]);
  }
  if (command.size() < 2) {
    std::fprintf(stderr, "usage: palpate_when_ready SERVICE COMMAND [ARGUMENT...]\n");
    return 2;
  }
  ros::init(argc, argv, "palpate_when_ready");
  {
    ros::NodeHandle handle;
    // By the wall clock: under use_sim_time nobody moves the clock before the command runs.
    while (ros::ok() && !ros::service::exists(command[0], false)) ros::WallDuration(0.05).sleep();
    if (!ros::ok()) return 1;
  }
  ros::shutdown();
  command.push_back(nullptr);
  execvp(command[1], command.data() + 1);
  std::perror(command[1]);
  return 127;
}

// SPDX-License-Identifier: GPL-3.0-or-later
// palpate_when_ready: waits until a service is there, then becomes a command. The node offers its
// services when the scene is loaded, which may take minutes.
#include <ros/ros.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <iostream>
#include <string>
#include <vector>

#include "palpate/base/error.h"
#include "program.h"
#include "ros/guard/master_wait.h"

int main(int argc, char** argv) {
  std::vector<char*> command;  // without what roslaunch adds
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    const bool added = argument.rfind("__", 0) == 0 && argument.find(":=") != std::string::npos;
    if (!added) command.push_back(argv[i]);
  }
  // What follows the command is its own.
  std::size_t ours = 0;
  while (ours < command.size() && command[ours][0] == '-') ++ours;
  ours = std::min(ours + 2, command.size());
  std::vector<std::string> arguments(command.rend() - static_cast<std::ptrdiff_t>(ours),
                                     command.rend());
  std::string service, program;
  CLI::App app("Waits until a service is there, then becomes a command.", "palpate_when_ready");
  app.add_option("SERVICE", service,
                 "such as /palpate/reset, which palpate_node offers when its scene is loaded")
      ->required();
  app.add_option("COMMAND", program, "what follows are its arguments")->required();
  app.footer("\nThe program has no parameters and no topics.");
  try {
    app.parse(arguments);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : palpate::node::kBadInput;
  }
  try {
    palpate::node::waitForMaster(argc, argv, "palpate_when_ready");
  } catch (const palpate::InputError& error) {
    std::cerr << error.what() << '\n';
    return palpate::node::kBadInput;
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

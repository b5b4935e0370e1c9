// SPDX-License-Identifier: GPL-3.0-or-later
// The command line without ROS: one file a subcommand, see commands.h.
#include <CLI/CLI.hpp>
#include <cstdint>
#include <exception>
#include <iostream>

#include "commands.h"
#include "environment.h"
#include "palpate/base/error.h"

namespace {

using palpate::cli::Action;

constexpr void (*kCommands[])(CLI::App&, Action&) = {
    palpate::cli::addMesh,   palpate::cli::addOrgan,   palpate::cli::addDocs,
    palpate::cli::addReplay, palpate::cli::addSolve,   palpate::cli::addBench,
    palpate::cli::addHand,   palpate::cli::addSprings, palpate::cli::addDatabase,
    palpate::cli::addSkin,   palpate::cli::addTorture, palpate::cli::addTrain,
    palpate::cli::addScenes,
};

// CLI11 has an exit status for each kind of mistake; here they are all bad input.
int explain(const CLI::App& app, const CLI::ParseError& e) {
  return app.exit(e) == 0 ? palpate::cli::kOk : palpate::cli::kBadInput;
}

int run(int argc, char** argv) {
  CLI::App app("Soft organs under an instrument: meshes, solves and replays, without ROS",
               "palpate");
  app.footer(
      "Exit status: 0 done, 1 a solve did not converge, 2 bad input, 3 internal error.\n"
      "`palpate COMMAND --help` explains a command.");
  app.require_subcommand(1);
  app.add_flag_function(
      "--version",
      [](std::int64_t) {
        std::cout << "palpate " << PALPATE_VERSION << "\n";
        throw CLI::Success();
      },
      "Print the version and exit");
  Action action;
  for (const auto add : kCommands) add(app, action);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return explain(app, e);
  }
  const int status = action();
  if (!std::cout.flush()) {
    throw palpate::InputError("standard output", "", "", "cannot be written");
  }
  return status;
}

}  // namespace

int main(int argc, char** argv) {
  palpate::start::restartWithSolverEnvironment(argv);
  palpate::start::keepFreedMemory();
  palpate::start::letLargeWritesFail();
  try {
    return run(argc, argv);
  } catch (const palpate::InputError& e) {
    std::cerr << e.what() << "\n";
    return palpate::cli::kBadInput;
  } catch (const std::exception& e) {
    std::cerr << "palpate: internal error: " << e.what() << "\n";
    return palpate::cli::kInternalError;
  }
}

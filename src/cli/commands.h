// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "command.h"

namespace palpate::cli {

/// What `palpate` returns to the shell.
enum ExitStatus { kOk = 0, kNotConverged = 1, kBadInput = 2, kInternalError = 3 };

/// The work of a subcommand. @returns an ExitStatus.
using Action = std::function<int()>;

// Each adds a subcommand with its options to `app`; when the user gives it, parsing leaves its
// work in `action`. To add one: write its file, declare it here, add it to the table in main.cpp.
void addBench(CLI::App& app, Action& action);
void addDatabase(CLI::App& app, Action& action);
void addDocs(CLI::App& app, Action& action);
void addHand(CLI::App& app, Action& action);
void addMesh(CLI::App& app, Action& action);
void addOrgan(CLI::App& app, Action& action);
void addReplay(CLI::App& app, Action& action);
void addScenes(CLI::App& app, Action& action);
void addSkin(CLI::App& app, Action& action);
void addSolve(CLI::App& app, Action& action);
void addSprings(CLI::App& app, Action& action);
void addTorture(CLI::App& app, Action& action);
void addTrain(CLI::App& app, Action& action);

}  // namespace palpate::cli

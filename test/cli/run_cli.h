// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <string>

#include "support/temp_folder.h"

namespace palpate::test {

struct CliResult {
  int status;  ///< Exit status; -1 if the program was killed.
  std::string out, err;
};

/// Runs `PROGRAM ARGUMENTS` through the shell, with NAME=VALUE settings of the environment.
inline CliResult runProgram(const std::string& program, const std::string& arguments,
                            const std::string& environment = "") {
  const TempFolder folder;
  const std::string command = environment + " '" + program + "' " + arguments + " > '" +
                              folder.path("out") + "' 2> '" + folder.path("err") + "'";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, fileBytes(folder.path("out")),
          fileBytes(folder.path("err"))};
}

/// Runs `palpate ARGUMENTS`.
inline CliResult runCli(const std::string& arguments, const std::string& environment = "") {
  return runProgram(PALPATE_CLI, arguments, environment);
}

}  // namespace palpate::test

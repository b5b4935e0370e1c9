// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdio.h>  // popen: POSIX

#include <filesystem>
#include <stdexcept>
#include <string>

namespace palpate::test {

/// The C library's functions and OpenBLAS's kernels that every x86-64 processor since 2008 has, as
/// settings for `env`, and those that this processor has.
constexpr char kOldestKernels[] =
    "OPENBLAS_CORETYPE=NEHALEM GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4";
constexpr char kOwnKernels[] = "-u OPENBLAS_CORETYPE -u GLIBC_TUNABLES";

/// What this program prints in a process of its own with these settings for `env`.
/// @throws std::runtime_error if its exit status is not 0.
inline std::string runThisProgram(const std::string& settings, const std::string& arguments) {
  const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
  const std::string command = "env " + settings + " '" + program + "' " + arguments;
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("cannot run " + command);
  std::string printed;
  for (int c = getc(pipe); c != EOF; c = getc(pipe)) printed += static_cast<char>(c);
  if (pclose(pipe) != 0) throw std::runtime_error(command + " failed and printed " + printed);
  return printed;
}

}  // namespace palpate::test

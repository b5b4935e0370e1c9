// SPDX-License-Identifier: GPL-3.0-or-later
// What libFuzzer calls. The environment variable PALPATE_FUZZ_TARGET names the kind of file; `list`
// prints those that there are. With PALPATE_FUZZ_SEEDS nothing is tried: files that are well are
// written into that folder.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <string>

#include "targets.h"

namespace {

const palpate::fuzz::Target* chosen = nullptr;

void writeSeeds(const std::string& folder) {
  if (chosen->seeds == nullptr) return;
  int number = 0;
  for (const std::string& bytes : chosen->seeds()) {
    std::ofstream(folder + "/made_" + std::to_string(number++), std::ios::binary) << bytes;
  }
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  const char* variable = std::getenv("PALPATE_FUZZ_TARGET");
  const std::string name = variable == nullptr ? "" : variable;
  if (name == "list") {
    for (const palpate::fuzz::Target& target : palpate::fuzz::targets()) std::puts(target.name);
    std::exit(0);
  }
  try {
    chosen = &palpate::fuzz::targetNamed(name);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "PALPATE_FUZZ_TARGET: %s\n", error.what());
    std::exit(2);
  }
  const char* seeds = std::getenv("PALPATE_FUZZ_SEEDS");
  if (seeds != nullptr) {
    writeSeeds(seeds);
    std::exit(0);
  }
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    palpate::fuzz::tryBytes(*chosen, {reinterpret_cast<const char*>(data), size});
  } catch (const palpate::fuzz::Fault& error) {  // what else is thrown ends the program where it is
    std::fprintf(stderr, "FAULT of target %s: %s\n", chosen->name, error.what());
    std::abort();
  }
  return 0;
}

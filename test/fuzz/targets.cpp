// SPDX-License-Identifier: GPL-3.0-or-later
#include "targets.h"

#include <string>

#include "palpate/base/error.h"
#include "support/heap_peak.h"

namespace palpate::fuzz {
namespace {

// A message is for somebody who reads it.
constexpr std::size_t kLongestMessage = std::size_t{1} << 16;

void checkMessage(const InputError& error) {
  require(!error.file().empty(), "a refusal names no file");
  require(!error.problems().empty(), "a refusal names no problem");
  for (const Problem& problem : error.problems()) {
    require(!problem.allowed.empty(), "a refusal does not say what is allowed");
  }
  require(std::string_view(error.what()).size() <= kLongestMessage, "a refusal is too long");
}

}  // namespace

const Target& targetNamed(const std::string& name) {
  std::vector<std::string> names;
  for (const Target& target : targets()) {
    if (target.name == name) return target;
    names.emplace_back(target.name);
  }
  throw std::invalid_argument("no target '" + name + "'; there are " + joinNames(names));
}

Outcome tryBytes(const Target& target, std::string_view bytes) {
  Outcome outcome = Outcome::kRead;
  const test::HeapPeak heap;
  try {
    target.read(bytes);
  } catch (const InputError& error) {
    checkMessage(error);
    outcome = Outcome::kRefused;
  }
  const double allowed = target.memory_each * static_cast<double>(bytes.size()) +
                         static_cast<double>(target.memory_more);
  if (static_cast<double>(heap.bytes()) > allowed) {
    throw Fault("took " + std::to_string(heap.bytes()) + " bytes of memory for a file of " +
                std::to_string(bytes.size()));
  }
  return outcome;
}

}  // namespace palpate::fuzz

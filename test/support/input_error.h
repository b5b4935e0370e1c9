// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "palpate/base/error.h"

namespace palpate::test {

/// The problems that `read` throws as InputError; a failure of the test if it does not.
template <class Read>
std::vector<Problem> problemsOf(Read&& read) {
  try {
    read();
  } catch (const InputError& e) {
    return e.problems();
  }
  ADD_FAILURE() << "no InputError";
  return {};
}

/// What `read` says when it throws InputError; "" if it does not.
template <class Read>
std::string complaint(Read&& read) {
  try {
    read();
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

/// Whether one of the problems is at `key` and its allowed text contains `part`.
inline ::testing::AssertionResult hasProblem(const std::vector<Problem>& problems,
                                             const std::string& key, const std::string& part) {
  std::string all;
  for (const Problem& p : problems) {
    if (p.key == key && p.allowed.find(part) != std::string::npos) {
      return ::testing::AssertionSuccess();
    }
    all += "\n  " + p.key + " = " + p.value + ": " + p.allowed;
  }
  return ::testing::AssertionFailure()
         << "no problem at " << key << " with \"" << part << "\" among:" << all;
}

}  // namespace palpate::test

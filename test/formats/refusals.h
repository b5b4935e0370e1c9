// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/contains.h"
#include "support/input_error.h"

namespace palpate::formats {

/// `text` with `to` in place of the first `from`, which must be there.
inline std::string changed(std::string text, const std::string& from, const std::string& to) {
  EXPECT_TRUE(test::contains(text, from));
  const std::size_t at = text.find(from);
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

/// A file that is refused, and all that the message says behind the file's name.
struct Refusal {
  std::string bytes, message;
};

/// A change that spoils a good file, and all that the message says behind the file's name.
struct Spoiling {
  std::string from, to, message;
};

/// `parse(file, bytes)` must throw InputErrors with exactly these messages.
template <class Parse>
void expectRefusals(Parse parse, const std::string& file, const std::vector<Refusal>& refusals) {
  for (const Refusal& refusal : refusals) {
    EXPECT_EQ(test::complaint([&] { parse(file, refusal.bytes); }), file + ": " + refusal.message);
  }
}

template <class Parse>
void expectRefusals(Parse parse, const std::string& file, const std::string& good,
                    const std::vector<Spoiling>& spoilings) {
  EXPECT_NO_THROW(parse(file, good));
  std::vector<Refusal> refusals;
  for (const Spoiling& s : spoilings) refusals.push_back({changed(good, s.from, s.to), s.message});
  expectRefusals(parse, file, refusals);
}

}  // namespace palpate::formats

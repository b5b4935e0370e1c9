// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <variant>

#include "palpate/material/law_list.h"

namespace palpate::test {

template <class T>
struct AsTestTypes;
template <class... Laws>
struct AsTestTypes<std::variant<Laws...>> {
  using type = ::testing::Types<Laws...>;
};

/// All laws, for a TYPED_TEST_SUITE.
using LawTypes = AsTestTypes<material::LawList>::type;

}  // namespace palpate::test

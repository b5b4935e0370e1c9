// SPDX-License-Identifier: GPL-3.0-or-later
#include "tissue/model_library.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "palpate/tissue/model_list.h"

namespace palpate::tissue::model_library_test {
namespace {

TEST(ModelLibrary, HasTheMakerOfEachModelBesideFem) {
  for (const std::string& name : modelNames()) {
    if (name == "fem") continue;
    EXPECT_NE(makerInLibrary(name), nullptr) << name;
  }
}

TEST(ModelLibrary, IsNamedWhereItIsNotThere) {
  try {
    makerInLibrary("wood");
    FAIL() << "there is no such library";
  } catch (const std::invalid_argument& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("model = wood is in the library libpalpate_model_wood.so"),
              std::string::npos)
        << text;
    EXPECT_NE(text.find("target palpate_model_wood"), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace palpate::tissue::model_library_test

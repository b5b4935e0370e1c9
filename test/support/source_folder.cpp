// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/source_folder.h"

namespace palpate::test {

std::string sourceFolder() { return PALPATE_SOURCE_DIR; }

}  // namespace palpate::test

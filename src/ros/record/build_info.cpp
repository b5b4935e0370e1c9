// SPDX-License-Identifier: GPL-3.0-or-later
#include "build_info.h"

#include <palpate_commit.h>  // written when building

namespace palpate::node {

std::string buildVersion() { return PALPATE_VERSION; }
std::string buildCommit() { return PALPATE_COMMIT; }

}  // namespace palpate::node

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "program_help.h"

namespace palpate::node {

/// What `palpate_node --help` says.
About aboutNode();

}  // namespace palpate::node

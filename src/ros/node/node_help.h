// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ros/program/program_help.h"

namespace palpate::node {

/// What `palpate_node --help` says.
About aboutNode();

}  // namespace palpate::node

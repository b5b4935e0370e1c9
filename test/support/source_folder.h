// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace palpate::test {

/// Where the package's files are: config, docs, msg. Compiled into one file alone, so that a test's
/// object does not depend on where the package lies.
std::string sourceFolder();

}  // namespace palpate::test

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace palpate::node {

/// Of the package: "0.1.0".
std::string buildVersion();

/// That this was built from, and "+" if files that git knows had changed since; "" where the
/// sources are in no git repository.
std::string buildCommit();

}  // namespace palpate::node

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace palpate::node {

/// Of the bytes of a file, 64 hexadecimal digits as sha256sum prints them; "" if it cannot be read.
std::string sha256OfFile(const std::string& file);

}  // namespace palpate::node

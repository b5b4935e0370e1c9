// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "palpate/enrichment/surrogate.h"

namespace palpate::enrichment {

/// The file appears when it is whole. For machines of the same byte order.
/// @throws InputError where it cannot be written.
void writeSurrogate(const std::string& file, const Surrogate& surrogate);

/// @throws InputError for a file that is none of this version, is cut off or changed, larger than
/// 64 MiB, or whose parts do not fit together or have numbers beyond 1e12, of which an answer might
/// not be finite.
Surrogate readSurrogate(const std::string& file);

}  // namespace palpate::enrichment

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "palpate/enrichment/surrogate.h"

namespace palpate::enrichment {

/// Writes atomically, in this machine's byte order. @throws InputError if it cannot be written.
void writeSurrogate(const std::string& file, const Surrogate& surrogate);

/// @throws InputError for another file type or version, a truncated, changed or inconsistent file,
/// one above 64 MiB, or numbers beyond 1e12, for which results might overflow.
Surrogate readSurrogate(const std::string& file);

}  // namespace palpate::enrichment

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "palpate/tissue/fem/fem_tissue.h"
#include "palpate/tissue/method_facts.h"

namespace palpate::tissue {

/// Why a method with these facts cannot treat a body with these settings, and what to change; empty
/// if it can.
std::string methodRefusal(const MethodFacts& method, const FemSettings& settings, bool viscous);

}  // namespace palpate::tissue

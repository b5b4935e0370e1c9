// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "fem_body.h"
#include "palpate/tissue/method_facts.h"

namespace palpate::tissue {

/// Why a method with these facts cannot treat a body, its settings and surroundings, and what to
/// change; empty if it can.
std::string methodRefusal(const MethodFacts& method, const FemBody& body);

}  // namespace palpate::tissue

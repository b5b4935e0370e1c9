// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "palpate/tissue/method_facts.h"
#include "tissue/body/fem_body.h"

namespace palpate::tissue {

/// Reason, with advice, why a method does not support a body with its settings and boundary
/// conditions; empty if it does.
std::string methodRefusal(const MethodFacts& method, const FemBody& body);

}  // namespace palpate::tissue

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>

#include "tissue/body/step_method.h"

namespace palpate::tissue {

/// Makes the method `name`, one of methodNames(), and sets body.method to it, or to the choice of
/// `auto`.
/// @throws std::invalid_argument for an unknown name, or a body or settings that the method does
/// not support.
std::unique_ptr<StepMethod> makeStepMethod(const std::string& name, FemBody* body);

}  // namespace palpate::tissue

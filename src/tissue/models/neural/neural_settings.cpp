// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/tissue/neural/neural_settings.h"

namespace palpate::tissue {

void describe(keys::FieldVisitor& v, NeuralSettings& neural) {
  v.text(
      {"file", "", "What `palpate train` made of presses of this organ; model `neural` needs it."},
      neural.file);
  v.number({"switch_time", "s",
            "A press that is unlike what was learned is answered by finite elements instead, and "
            "the force goes from one to the other in this time."},
           neural.switch_time, keys::Range::closed(0.02, 10.0));
}

}  // namespace palpate::tissue

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>

namespace palpate::fuzz {

// Files of keys and of tables.
void readSceneFile(std::string_view bytes);
void readCaseFile(std::string_view bytes);
void readTissue(std::string_view bytes);
void readTrajectoryFile(std::string_view bytes);
void readSpringsFile(std::string_view bytes);
/// An instrument, and where its links are for some positions of its joints. Beside it lies
/// part.obj.
void readUrdf(std::string_view bytes);

}  // namespace palpate::fuzz

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace palpate::fuzz {

/// A saved state, as a file; size and checksum in the line before its payload are set right.
void readStateFile(std::string_view bytes);
std::vector<std::string> stateFiles();

/// What was learned. The bytes are those that the file's mark is of.
void readSurrogateFile(std::string_view bytes);
std::vector<std::string> surrogateFiles();

/// A database of a body and one deformation of it: the first file's length (8 bytes), and what
/// stands behind the heads of the two files. The sample's mark is set right.
void readDatabaseFolder(std::string_view bytes);
std::vector<std::string> databaseFolders();

/// What a state's checksum is of, given to a simulator that goes on from it: the first byte says of
/// which scene, the others are the payload.
void goOnFrom(std::string_view bytes);
std::vector<std::string> payloads();

}  // namespace palpate::fuzz

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>

#include "palpate/enrichment/deformations.h"

namespace palpate::enrichment {

/// A database in a folder: one file for the body and one per sample, so that several processes can
/// make it and resume it. Files are written atomically, in this machine's byte order.
class DatabaseFolder {
 public:
  /// Opens or makes the folder for samples of this body. `made_by`: any text that identifies the
  /// request.
  /// @throws InputError for samples of another body or request, or if it cannot be written.
  DatabaseFolder(const std::string& folder, const mesh::SurfaceMesh& coarse,
                 const mesh::SurfaceMesh& fine, const std::string& made_by);

  bool has(int index) const;
  /// `solved`: whether the press has a solution. Unsolved samples keep their number and are omitted
  /// on reading.
  void write(int index, const Deformation& sample, bool solved) const;

 private:
  std::string folder_;
  std::uint64_t mark_;  // hash of body and text
};

/// Hash that identifies bodies and requests, and so databases.
std::uint64_t databaseMark(const mesh::SurfaceMesh& coarse, const mesh::SurfaceMesh& fine,
                           const std::string& made_by);

/// All solved samples below `count`, by number. `unsolved`: number of the others.
/// @throws InputError for a folder or file of no database, a truncated file, or one of another
/// body.
DeformationDatabase readDatabase(const std::string& folder, int* unsolved = nullptr,
                                 int count = 1000000);

}  // namespace palpate::enrichment

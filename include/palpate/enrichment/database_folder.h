// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>

#include "palpate/enrichment/deformations.h"

namespace palpate::enrichment {

/// A database as files of one folder, one of the body and one a sample, so that many can make it at
/// once and whoever comes later goes on. Each appears when it is whole. For machines of the same
/// byte order.
class DatabaseFolder {
 public:
  /// Opens the folder for writing, or makes it, for samples of this body, which were asked for by
  /// `made_by` (any text).
  /// @throws InputError where it has samples of another body, or asked for otherwise, or cannot be
  /// written.
  DatabaseFolder(const std::string& folder, const mesh::SurfaceMesh& coarse,
                 const mesh::SurfaceMesh& fine, const std::string& made_by);

  bool has(int index) const;
  /// `solved`: whether there is a shape. One that is not keeps its number, and is left out when the
  /// database is read.
  void write(int index, const Deformation& sample, bool solved) const;

 private:
  std::string folder_;
  std::uint64_t mark_;  // of body and text
};

/// Tells bodies apart, and ways to press them: another number for another database.
std::uint64_t databaseMark(const mesh::SurfaceMesh& coarse, const mesh::SurfaceMesh& fine,
                           const std::string& made_by);

/// All samples below `count` that were solved, in the order of their numbers. `unsolved`: the
/// number of others.
/// @throws InputError for a folder or file that is not of a database, is cut off, or is of another
/// body.
DeformationDatabase readDatabase(const std::string& folder, int* unsolved = nullptr,
                                 int count = 1000000);

}  // namespace palpate::enrichment

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "palpate/io/output_file.h"

namespace palpate::io {

/// Writes a table of comma-separated values, row by row:
///
///     CsvWriter csv("R.csv", {"t", "fz", "status"});
///     csv << t << wrench.force.z() << "converged";
///     csv.endRow();
///     csv.close();
///
/// Numbers are read back exactly. Texts with a comma, quote or line break are quoted (RFC 4180).
class CsvWriter {
 public:
  /// Creates or replaces the file and writes the header. @throws InputError if it cannot be
  /// written, for example on a full disk; so do all other functions.
  CsvWriter(const std::string& file, const std::vector<std::string>& header);

  CsvWriter& operator<<(double value);
  CsvWriter& operator<<(int value);
  CsvWriter& operator<<(const std::string& value);
  CsvWriter& operator<<(const char* value) { return *this << std::string(value); }

  /// @throws std::logic_error if the row is shorter or longer than the header.
  void endRow();
  void flush() { output_.flush(); }
  /// Closes with error checks; the destructor closes without.
  void close() { output_.close(); }

 private:
  void cell(const std::string& text);

  OutputFile output_;
  std::size_t num_columns_;
  std::size_t column_ = 0;  // index of the next value
  std::string row_;
};

}  // namespace palpate::io

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
/// Numbers have as many digits as bring back the same bits. Texts with a comma, a quote or a line
/// break are quoted (RFC 4180).
class CsvWriter {
 public:
  /// Creates or replaces the file and writes the header.
  /// @throws InputError if it cannot be written; so do all other functions (a full disk).
  CsvWriter(const std::string& file, const std::vector<std::string>& header);

  CsvWriter& operator<<(double value);
  CsvWriter& operator<<(int value);
  CsvWriter& operator<<(const std::string& value);
  CsvWriter& operator<<(const char* value) { return *this << std::string(value); }

  /// @throws std::logic_error if the row is not as long as the header.
  void endRow();
  void flush() { output_.flush(); }
  /// Without it the destructor closes, but cannot tell of a full disk.
  void close() { output_.close(); }

 private:
  void cell(const std::string& text);

  OutputFile output_;
  std::size_t num_columns_;
  std::size_t column_ = 0;  // of the next value
  std::string row_;
};

}  // namespace palpate::io

// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/io/csv_writer.h"

#include <stdexcept>

#include "palpate/base/number.h"

namespace palpate::io {
namespace {

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
  return result + "\"";
}

}  // namespace

CsvWriter::CsvWriter(const std::string& file, const std::vector<std::string>& header)
    : output_(file), num_columns_(header.size()) {
  for (const std::string& name : header) cell(quoted(name));
  endRow();
}

CsvWriter& CsvWriter::operator<<(double value) {
  cell(formatNumber(value));
  return *this;
}

CsvWriter& CsvWriter::operator<<(int value) {
  cell(std::to_string(value));
  return *this;
}

CsvWriter& CsvWriter::operator<<(const std::string& value) {
  cell(quoted(value));
  return *this;
}

void CsvWriter::cell(const std::string& text) {
  if (column_++ > 0) row_ += ',';
  row_ += text;
}

void CsvWriter::endRow() {
  if (column_ != num_columns_) {
    throw std::logic_error("a row of " + std::to_string(column_) + " values in a table of " +
                           std::to_string(num_columns_) + " columns");
  }
  row_ += '\n';
  output_.write(row_);
  row_.clear();
  column_ = 0;
}

}  // namespace palpate::io

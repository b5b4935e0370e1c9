// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/io/trajectory.h"

#include "palpate/io/csv_writer.h"

namespace palpate::io {

void writeTrajectory(const std::string& file, const formats::Trajectory& trajectory) {
  std::vector<std::string> header = {"t"};
  header.insert(header.end(), trajectory.columns.begin(), trajectory.columns.end());
  CsvWriter writer(file, header);
  for (std::size_t i = 0; i < trajectory.t.size(); ++i) {
    writer << trajectory.t[i];
    const auto column = trajectory.values.col(static_cast<Eigen::Index>(i));
    for (Eigen::Index j = 0; j < column.size(); ++j) writer << column(j);
    writer.endRow();
  }
  writer.close();
}

}  // namespace palpate::io

// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Forces for the positions of a CSV, row by row.

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <istream>
#include <ostream>
#include <string>

namespace forceshade::apps {

// Writes fx,fy,fz,status for a position; throws std::domain_error, before it writes, for one that it cannot answer.
using Answer = std::function<void(const Eigen::Vector3f&, std::ostream&)>;

struct RowCount {
  std::size_t rows = 0, unanswered = 0;
};

// A row for each row of `in`, which messages call `file`. One that cannot be answered gets nan for its force and the status
// "undecided", and a line on `complaints` that names its line. Throws csv::Error for a row that cannot be read, and
// Interrupted.
RowCount answer_rows(std::istream& in, const std::string& file, std::ostream& out, std::ostream& complaints,
                     const Answer& answer);

}  // namespace forceshade::apps

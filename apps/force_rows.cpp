// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/apps/force_rows.h"

#include <stdexcept>

#include "forceshade/apps/bad_input.h"
#include "forceshade/apps/signals.h"
#include "forceshade/csv/csv.h"
#include "forceshade/csv/printable.h"

namespace forceshade::apps {

RowCount answer_rows(std::istream& in, const std::string& file, std::ostream& out, std::ostream& complaints,
                     const Answer& answer) {
  csv::Reader rows(in, file, {"x_mm", "y_mm", "z_mm"});
  out << "x_mm,y_mm,z_mm,fx_N,fy_N,fz_N,status\n";
  RowCount count;
  for (; rows.next(); ++count.rows) {
    if (interrupted()) throw Interrupted("no output file was written");
    const Eigen::Vector3f position(rows.binary32(0), rows.binary32(1), rows.binary32(2));
    for (const float coordinate : position) out << csv::shortest(coordinate) << ',';
    try {
      answer(position, out);
    } catch (const std::domain_error& error) {
      ++count.unanswered;
      out << "nan,nan,nan,undecided";
      const std::string words = file + ':' + std::to_string(rows.line()) + ": cannot be answered: " + error.what();
      complaints << "forceshade: " << csv::printable(words) << '\n';
    }
    out << '\n';
  }
  return count;
}

}  // namespace forceshade::apps

// SPDX-License-Identifier: BSD-3-Clause
#include "apps/force_rows.h"

#include <bit>
#include <limits>
#include <stdexcept>

#include "apps/signals.h"
#include "files/csv.h"
#include "files/npy.h"
#include "files/printable.h"
#include "forceshade/checks.h"

namespace forceshade::apps {
namespace {

constexpr const char* kLayout =
    "[('x_mm', '<f4'), ('y_mm', '<f4'), ('z_mm', '<f4'), ('fx_N', '<f4'), ('fy_N', '<f4'), ('fz_N', '<f4'), ('status', '|u1')]";
static_assert(std::endian::native == std::endian::little, "numbers are written as they are in memory");

void write_row(std::ostream& out, const Eigen::Vector3f& position, const AnsweredRow& row) {
  for (const float coordinate : position) out << shortest(coordinate) << ',';
  for (std::size_t i = 0; i < 3; ++i)
    out << (row.decimal ? (*row.decimal)[i] : shortest(row.force[static_cast<Eigen::Index>(i)])) << ',';
  out << kRowStatusNames[static_cast<std::size_t>(row.status)] << '\n';
}

void append(std::string& records, const Eigen::Vector3f& position, const AnsweredRow& row) {
  for (const Eigen::Vector3f& three : {position, row.force})
    records.append(reinterpret_cast<const char*>(three.data()), 3 * sizeof(float));
  records += static_cast<char>(row.status);
}

}  // namespace

RowCount answer_rows(std::istream& in, const std::string& file, RowFormat format, std::ostream& out, std::ostream& complaints,
                     const Answer& answer) {
  constexpr std::size_t kReset = 3;
  files::Reader rows(in, file, {"x_mm", "y_mm", "z_mm"}, {"reset"});
  std::string records;
  if (format == RowFormat::csv) out << "x_mm,y_mm,z_mm,fx_N,fy_N,fz_N,status\n";
  RowCount count;
  for (; rows.next(); ++count.rows) {
    if (interrupted()) throw Interrupted("no output file was written");
    const Eigen::Vector3f position(rows.binary32(0), rows.binary32(1), rows.binary32(2));
    if (rows.has(kReset)) {
      if (rows.text(kReset) != "0" && rows.text(kReset) != "1") throw rows.unexpected(kReset, "0 or 1");
      if (rows.text(kReset) == "1") answer.begin();
    }
    AnsweredRow row;
    try {
      row = answer.answer(position);
    } catch (const std::domain_error& error) {
      ++count.unanswered;
      row = {Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN()), RowStatus::undecided, std::nullopt};
      const std::string words = file + ':' + std::to_string(rows.line()) + ": cannot be answered: " + error.what();
      complaints << "forceshade: " << files::printable(words) << '\n';
    }
    format == RowFormat::csv ? write_row(out, position, row) : append(records, position, row);
  }
  if (format == RowFormat::npy) out << files::npy_header(kLayout, count.rows) << records;
  return count;
}

}  // namespace forceshade::apps

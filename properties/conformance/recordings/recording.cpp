// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/recordings/recording.h"

#include <cmath>

#include "files/csv.h"
#include "forceshade/error.h"
#include "properties/conformance/recordings/exact_time.h"
#include "properties/conformance/recordings/path.h"

namespace forceshade::conformance {

std::string Measurements::place(std::size_t sample) const {
  return file + ':' + std::to_string(samples[sample].line);
}

Measurements read_measurements(std::istream& in, const std::string& file, const Columns& columns) {
  using Layout = files::Reader::Layout;
  files::Reader reader(in, file, {columns.names.begin(), columns.names.end()}, {"status"},
                       columns.are_numbered() ? Layout::without_header : Layout::csv);
  constexpr std::size_t kStatus = 7;
  Measurements measured{file, {}};
  ExactTime first, before;
  while (reader.next()) {
    if (reader.has(kStatus) && reader.text(kStatus) == "end") continue;
    const auto finite = [&](std::size_t i) {
      const double number = reader.binary64(i);
      if (!std::isfinite(number)) throw reader.unexpected(i, "a finite number");
      return number;
    };
    Measured next;
    const ExactTime time(reader.text(0), finite(0));
    if (measured.samples.empty()) first = before = time;
    next.time = time.seconds_since(first, columns.power_of_seconds);
    next.interval = time.seconds_since(before, columns.power_of_seconds);
    before = time;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      next.position[axis] = finite(static_cast<std::size_t>(1 + axis)) * columns.millimetres;
      next.force[axis] = reader.binary64(static_cast<std::size_t>(4 + axis)) * columns.newtons;
    }
    next.line = reader.line();
    measured.samples.push_back(next);
  }
  if (measured.samples.size() < 2)
    throw Error(file + ": expected two samples at least, got " + std::to_string(measured.samples.size()));
  return measured;
}

Measurements placed(const Measurements& measured, const Placement& placement) {
  const Path path(measured.samples);
  Measurements there{measured.file, {}};
  for (const Measured& each : measured.samples) {
    if (!path.reaches(each, placement.lag)) continue;
    there.samples.push_back(each);
    there.samples.back().position = placement.turn * path.position(each, placement.lag) + placement.shift;
    there.samples.back().force = placement.turn * (each.force - placement.offset);
  }
  return there;
}

}  // namespace forceshade::conformance

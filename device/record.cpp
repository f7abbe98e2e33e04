// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/device/record.h"

#include <string_view>

#include "forceshade/csv/csv.h"
#include "forceshade/csv/output_file.h"

namespace forceshade::device {
namespace {

std::string_view status_name(const std::optional<Status>& status) {
  if (!status) return "end";
  switch (*status) {
    case Status::free: return "free";
    case Status::contact: return "contact";
    case Status::invalid: break;
  }
  return "invalid";
}

}  // namespace

void write_record(std::span<const Tick> record, const std::string& path) {
  csv::OutputFile file(path);
  std::ostream& out = file.stream();
  out << "tick,t_s,device_t_s,x_mm,y_mm,z_mm,fx_N,fy_N,fz_N,status,compute_us\n";
  for (const Tick& tick : record) {
    out << tick.number << ',' << csv::shortest(static_cast<double>(tick.wall_ns) / 1e9) << ','
        << csv::shortest(tick.reading.time);
    for (const float coordinate : tick.reading.position) out << ',' << csv::shortest(coordinate);
    for (const float component : tick.force) out << ',' << csv::shortest(component);
    out << ',' << status_name(tick.status) << ',' << csv::shortest(static_cast<double>(tick.compute_ns) / 1e3) << '\n';
  }
  file.commit();
}

}  // namespace forceshade::device

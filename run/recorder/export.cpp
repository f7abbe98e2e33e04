// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <ostream>
#include <string_view>

#include "files/csv.h"
#include "files/npy.h"
#include "files/output_file.h"
#include "forceshade/recording.h"
#include "run/recorder/layout.h"

namespace forceshade::recorder {
namespace {

void expect_written_metadata(const Recording& recording) {
  if (const std::string& problem = recording.metadata_problem(); !problem.empty())
    throw Error(recording.path() + ": " + problem);
}

constexpr std::array<std::string_view, 4> kStatuses{"free", "contact", "invalid", "end"};

void write_row(std::ostream& out, const Sample& sample, const std::string& path) {
  if (sample.status >= kStatuses.size())
    throw Error(path + ": tick " + std::to_string(sample.tick) + " has status " + std::to_string(sample.status) +
                "; expected 0 to " + std::to_string(kStatuses.size() - 1));
  const auto number = [&](auto value) { out << ',' << shortest(value); };
  const auto scaled = [&](std::int64_t value, double unit) { number(static_cast<double>(value) / unit); };
  out << sample.tick;
  scaled(sample.wall_ns, 1e9);
  number(sample.device_time);
  for (const float coordinate : sample.position) number(coordinate);
  for (const float component : sample.force) number(component);
  const bool is_unfinished = (sample.device_state & Sample::kUnfinished) != 0;
  out << ',' << (is_unfinished ? "unfinished" : kStatuses[sample.status]);
  scaled(sample.compute_ns, 1e3);
  for (const float component : sample.law_force) number(component);
  for (const std::int64_t count : sample.encoder) out << ',' << (count == Sample::kNoCount ? "" : std::to_string(count));
  for (const float angle : sample.gimbal) number(angle);
  number(sample.energy);
  scaled(sample.wakeup_ns, 1e3);
  out << ',' << sample.buttons;
  for (const unsigned flag :
       {unsigned{sample.late}, unsigned{sample.limited}, unsigned{sample.altered}, unsigned{sample.tripped}})
    out << ',' << flag;
  out << '\n';
}

}  // namespace

void export_csv(Recording& recording, const std::string& path) {
  expect_written_metadata(recording);
  files::OutputFile file(path);
  file.stream() << "tick,t_s,device_t_s,x_mm,y_mm,z_mm,fx_N,fy_N,fz_N,status,compute_us,law_fx_N,law_fy_N,law_fz_N,encoder_1,"
                   "encoder_2,encoder_3,gimbal_1_rad,gimbal_2_rad,gimbal_3_rad,energy_mJ,wakeup_us,buttons,late,limited,"
                   "altered,tripped\n";
  recording.for_each_chunk([&](std::span<const Sample> chunk) {
    for (const Sample& sample : chunk) write_row(file.stream(), sample, recording.path());
  });
  file.commit();
}

void export_npy(Recording& recording, const std::string& path) {
  expect_written_metadata(recording);
  files::OutputFile file(path);
  file.stream() << files::npy_header(layout(), recording.extent().samples);
  recording.for_each_chunk([&](std::span<const Sample> chunk) {
    const auto bytes = std::as_bytes(chunk);
    file.stream().write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  });
  file.commit();
}

void export_table(Recording& recording, const std::string& path) {
  files::is_named_npy(path) ? export_npy(recording, path) : export_csv(recording, path);
}

}  // namespace forceshade::recorder

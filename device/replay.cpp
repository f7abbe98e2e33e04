// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/device/replay.h"

#include <cmath>
#include <utility>

#include "forceshade/csv/csv.h"

namespace forceshade::device {

Replay::Replay(std::vector<Reading> recording) noexcept : recording_(std::move(recording)) {}

Replay Replay::load(const std::string& path) {
  auto file = csv::open_input(path);
  csv::Reader rows(file, path, {"t_s", "x_mm", "y_mm", "z_mm"});
  std::vector<Reading> recording;
  while (rows.next()) {
    const Reading reading{{rows.binary32(1), rows.binary32(2), rows.binary32(3)}, rows.binary64(0)};
    if (!std::isfinite(reading.time)) throw rows.unexpected(0, "a finite time");
    if (!recording.empty() && reading.time < recording.back().time)
      throw rows.unexpected(0, "a time not before " + csv::shortest(recording.back().time));
    recording.push_back(reading);
  }
  if (recording.empty()) throw csv::Error(path + ": expected at least one recorded position, got none");
  return Replay(std::move(recording));
}

ReadResult Replay::read() noexcept {
  if (next_ == recording_.size()) return EndOfData{};
  return recording_[next_++];
}

}  // namespace forceshade::device

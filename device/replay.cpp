// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <stdexcept>
#include <utility>

#include "files/csv.h"
#include "forceshade/device.h"

namespace forceshade::device {
namespace {

// The reading that is `since` s after `from`, of `gap` s between the two. In binary64, where no difference of two binary32
// numbers overflows.
Reading between(const Reading& from, const Reading& to, double since, double gap) noexcept {
  Reading reading = from;
  const Eigen::Vector3d begin = from.position.cast<double>(), way = to.position.cast<double>() - begin;
  reading.position = (begin + since / gap * way).cast<float>();
  reading.time = from.time + since;
  return reading;
}

}  // namespace

Replay::Replay(std::vector<Reading> recording) : recording_(std::move(recording)) {
  if (recording_.empty()) throw std::invalid_argument("replay: expected at least one reading, got none");
  for (std::size_t i = 0; i < recording_.size(); ++i)
    if (!std::isfinite(recording_[i].time) || (i > 0 && !(recording_[i].time > recording_[i - 1].time)))
      throw std::invalid_argument("replay: reading " + std::to_string(i) +
                                  ": expected a finite time after the one before, got " + shortest(recording_[i].time));
}

Replay Replay::load(const std::string& path) {
  auto file = files::open_file(path);
  files::Reader rows(file, path, {"t_s", "x_mm", "y_mm", "z_mm"});
  std::vector<Reading> recording;
  while (rows.next()) {
    const Reading reading{{rows.binary32(1), rows.binary32(2), rows.binary32(3)}, rows.binary64(0)};
    if (!std::isfinite(reading.time)) throw rows.unexpected(0, "a finite time");
    if (!recording.empty() && !(reading.time > recording.back().time))
      throw rows.unexpected(0, "a time after " + shortest(recording.back().time));
    recording.push_back(reading);
  }
  if (recording.empty()) throw Error(path + ": expected at least one recorded position, got none");
  return Replay(std::move(recording));
}

std::optional<Fault> Replay::start(double rate) noexcept {
  period_ = 1 / rate;
  const double readings = std::floor((time_of(recording_.size() - 1) + kSameTime) / period_) + 1;
  // A recording that takes longer than anyone can wait.
  constexpr double kEndless = 0x1p53;
  readings_ = static_cast<std::size_t>(readings < kEndless ? readings : kEndless);
  return std::nullopt;
}

ReadResult Replay::read() noexcept {
  if (period_ == 0) return Fault{"the replay was not started"};
  if (read_ == readings_) return EndOfData{};
  const double time = static_cast<double>(read_++) * period_;
  while (last_ + 1 < recording_.size() && time_of(last_ + 1) <= time + kSameTime) ++last_;
  const double since = time - time_of(last_);
  if (since <= kSameTime || last_ + 1 == recording_.size()) return recording_[last_];
  return between(recording_[last_], recording_[last_ + 1], since, time_of(last_ + 1) - time_of(last_));
}

std::optional<std::size_t> Replay::readings_left() const noexcept {
  if (period_ == 0) return std::nullopt;
  return readings_ - read_;
}

}  // namespace forceshade::device

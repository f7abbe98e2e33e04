// SPDX-License-Identifier: BSD-3-Clause
#include "apps/last_ticks.h"

#include <Eigen/Core>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "apps/rule_names.h"

namespace forceshade::apps {
namespace {

using device::Sample;
using nlohmann::ordered_json;

Eigen::Vector3d vector(const std::array<float, 3>& v) {
  return Eigen::Map<const Eigen::Vector3f>(v.data()).cast<double>();
}

// mm/s, by the device's own clock, or by ours where the device's stands still.
double speed(const Sample& before, const Sample& last) {
  double seconds = last.device_time - before.device_time;
  if (!(seconds > 0)) seconds = static_cast<double>(last.wall_ns - before.wall_ns) / 1e9;
  return (vector(last.position) - vector(before.position)).norm() / seconds;
}

// JSON has no NaN; null stands for it.
ordered_json array(const std::array<float, 3>& v) {
  return {v[0], v[1], v[2]};
}

}  // namespace

void print_last_ticks(const std::vector<Sample>& samples) {
  if (samples.empty()) return;
  const Sample& last = samples.back();
  const Eigen::Vector3d at = vector(last.position);
  std::printf("last tick         %llu: at (%.3f, %.3f, %.3f) mm", static_cast<unsigned long long>(last.tick), at.x(), at.y(),
              at.z());
  if (samples.size() > 1) {
    const Sample& before = samples[samples.size() - 2];
    std::printf(", %.0f mm/s; force %.3f N, one tick before %.3f N", speed(before, last), vector(last.force).norm(),
                vector(before.force).norm());
  }
  std::printf("; the law's %.3f N\n", vector(last.law_force).norm());
  std::uint16_t limited = 0;
  for (const Sample& sample : samples) limited = static_cast<std::uint16_t>(limited | sample.limited);
  std::printf("before the end    %zu ticks kept for --json; %s\n", samples.size(),
              limited == 0 ? "nothing limited in them" : ("limited by " + joined_rule_names(limited)).c_str());
}

ordered_json last_ticks_json(const std::vector<Sample>& samples) {
  ordered_json all = ordered_json::array();
  for (const Sample& sample : samples) {
    ordered_json tripped = nullptr;
    if (sample.tripped != 0) tripped = name_of(static_cast<device::Rule>(sample.tripped - 1));
    all.push_back({{"tick", sample.tick},
                   {"t_s", static_cast<double>(sample.wall_ns) / 1e9},
                   {"position_mm", array(sample.position)},
                   {"law_force_N", array(sample.law_force)},
                   {"force_N", array(sample.force)},
                   {"limited", rule_names(sample.limited)},
                   {"tripped", tripped}});
  }
  return all;
}

}  // namespace forceshade::apps

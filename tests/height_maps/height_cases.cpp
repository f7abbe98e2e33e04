// SPDX-License-Identifier: BSD-3-Clause
#include "tests/height_maps/height_cases.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "files/csv.h"

namespace forceshade::tests {
namespace {

using N = fast::BigFloatBall<32>;

// log2 of the distance to the nearest tie over the size of the value; minus infinity where 2048 bits see none, 0 for zero.
double log_distance(const N& value) {
  const double size = std::fabs(approximately(value));
  if (size == 0) return 0;
  const double unit = std::ldexp(1.0, std::ilogb(size) - 23);
  const double tie = std::copysign((std::floor(size / unit) + 0.5) * unit, approximately(value));
  const N off = value - N::exactly(tie);
  if (sign(off) == fast::Sign::zero) return -HUGE_VAL;
  return static_cast<double>(off.exponent() - 1) - std::floor(std::log2(size));
}

template <class Named>
std::optional<Named> named(const std::string& name, const std::vector<std::pair<std::string, Named>>& all) {
  for (const auto& [word, value] : all)
    if (word == name) return value;
  return std::nullopt;
}

}  // namespace

bool is_about_gap(const HeightCase& one) {
  return one.why.starts_with("contact");
}

std::string case_file(const HeightScene& scene) {
  std::string name = scene.name;
  std::ranges::replace(name, '-', '_');
  return "tests/height_maps/height_" + name + ".cases";
}

std::vector<HeightCase> read_height_cases(std::istream& in, const std::string& file) {
  files::Reader reader(in, file, {"rendering", "K", "x", "y", "z", "Fx", "Fy", "Fz", "status", "closest", "why"});
  std::vector<std::pair<std::string, height::Mode>> renderings;
  for (const auto& [mode, name] : height::kModes) renderings.emplace_back(name, mode);
  std::vector<HeightCase> cases;
  while (reader.next()) {
    const auto number = [&](std::size_t i) { return reader.binary32(i); };
    const auto mode = named<height::Mode>(reader.text(0), renderings);
    if (!mode) throw reader.unexpected(0, "a rendering");
    const auto status = named<Status>(reader.text(8), {{"free", Status::free}, {"contact", Status::contact}});
    if (!status) throw reader.unexpected(8, "free or contact");
    cases.push_back({*mode,
                     number(1),
                     {number(2), number(3), number(4)},
                     {number(5), number(6), number(7)},
                     *status,
                     reader.text(9),
                     reader.text(10),
                     file + ":" + std::to_string(reader.line())});
    if (cases.back().closest.empty()) throw reader.unexpected(9, "a distance");
    if (cases.back().why.empty()) throw reader.unexpected(10, "words");
  }
  if (cases.empty()) throw Error(file + ":1: expected cases below the header");
  return cases;
}

std::vector<HeightCase> height_cases(const HeightScene& scene) {
  const std::string file = case_file(scene);
  std::ifstream in = files::open_input(std::string(FORCESHADE_SOURCE_DIR "/") + file);
  return read_height_cases(in, file);
}

std::string closeness(const Balls& balls, const HeightCase& one, bool of_gap) {
  const auto answer = balls.at<N>(one.position, one.mode, static_cast<double>(one.stiffness));
  char text[32];
  if (of_gap) {
    if (sign(answer.gap) == fast::Sign::zero) return "gap 0";
    std::snprintf(text, sizeof text, "gap %s2^%lld", sign(answer.gap) == fast::Sign::negative ? "-" : "",
                  static_cast<long long>(answer.gap.exponent()) - 1);
    return text;
  }
  double nearest = HUGE_VAL;
  std::size_t axis = 0;
  for (std::size_t i = 0; i < 3; ++i)
    if (const double distance = log_distance(answer.force[i]); distance < nearest) {
      nearest = distance;
      axis = i;
    }
  if (std::isinf(nearest))
    std::snprintf(text, sizeof text, "%c 0", "xyz"[axis]);
  else
    std::snprintf(text, sizeof text, "%c 2^%.0f", "xyz"[axis], nearest);
  return text;
}

}  // namespace forceshade::tests

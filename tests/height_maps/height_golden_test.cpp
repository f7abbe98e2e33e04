// SPDX-License-Identifier: BSD-3-Clause
// Height maps on both sides against tests/golden/height_forces.csv, which an independent program makes (exact rationals and
// enclosures by integers, in Python): every bit of a force, every digit of its decimals, every status.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "fast/heights/spline_force.h"
#include "files/csv.h"
#include "forceshade/fast.h"
#include "forceshade/reference.h"
#include "properties/binary32.h"
#include "tests/height_maps/height_cases.h"
#include "tests/height_maps/height_maps_file.h"

namespace forceshade {
namespace {

using properties::same_bits;
using properties::show;
using N = fast::BigFloatBall<32>;

const std::string kGolden = std::string(FORCESHADE_SOURCE_DIR "/tests/golden/");

// The decimal as it is written, scientific; enclosed.
N decimal(const std::string& text) {
  const std::size_t e = text.find('e');
  N value = N::exactly(0), ten = N::exactly(10);
  int power = e == std::string::npos ? 0 : std::stoi(text.substr(e + 1));
  bool is_past_point = false;
  for (const char c : text.substr(0, e)) {
    if (c == '.') is_past_point = true;
    if (c < '0' || c > '9') continue;
    value = value * ten + N::exactly(c - '0');
    power -= is_past_point;
  }
  for (; power > 0; --power) value = value * ten;
  N scale = N::exactly(1);
  for (; power < 0; ++power) scale = scale * ten;
  value = value / scale;
  return text.starts_with('-') ? -value : value;
}

// Within half a unit of the 40th digit, and a little for the enclosures.
bool has_these_digits(const N& force, const std::string& text) {
  const double size = std::fabs(approximately(force));
  if (text == "0" || size < 1e-250) return (text == "0") == (size == 0) || size < 1e-250;
  const double off = std::fabs(approximately(force - decimal(text)));
  return off <= 0.5000001 * std::pow(10, std::floor(std::log10(size)) - 39) || off <= 0.5000001e-39 * size;
}

// Digits and the power of ten of the first, of either notation: "-0.00125" and "-1.25e-3" are the same.
std::string canonical(const std::string& text) {
  const std::size_t e = text.find('e');
  int power = e == std::string::npos ? 0 : std::stoi(text.substr(e + 1));
  std::string digits;
  bool is_past_point = false;
  for (const char c : text.substr(0, e)) {
    if (c == '.') is_past_point = true;
    if (c < '0' || c > '9') continue;
    if (digits.empty() && c == '0') {
      power -= is_past_point;
      continue;
    }
    digits += c;
    power += !is_past_point;
  }
  while (digits.ends_with('0')) digits.pop_back();
  return digits.empty() ? "0" : (text.starts_with('-') ? "-." : ".") + digits + "e" + std::to_string(power);
}

TEST(height_golden, forces_are_met_to_every_bit_and_digit) {
  const auto maps = tests::height_maps_in(kGolden + "height_maps.csv");
  const std::string path = kGolden + "height_forces.csv";
  std::ifstream in = files::open_input(path);
  files::Reader rows(in, path,
                     {"map", "rendering", "K_N_per_mm", "x_mm", "y_mm", "z_mm", "fx_N", "fy_N", "fz_N", "fx_binary32",
                      "fy_binary32", "fz_binary32", "status"});
  std::array<int, 3> stages{}, methods{}, statuses{};
  std::set<std::pair<std::string, std::string>> renderings_met;
  std::set<std::size_t> kinds;
  int count = 0;
  while (rows.next()) {
    const HeightMap& map = maps.at(rows.text(0));
    const auto named = std::ranges::find(height::kModes, rows.text(1), &height::ModeName::name);
    ASSERT_NE(named, height::kModes.end()) << rows.text(1);
    const float K = rows.binary32(2);
    const auto fast = std::get<fast::HeightMapField>(fast::HeightMapField::build(map, named->mode, K));
    const auto reference = std::get<reference::HeightMapField>(reference::HeightMapField::build(map, named->mode, K));
    const Eigen::Vector3f position(rows.binary32(3), rows.binary32(4), rows.binary32(5));
    const fast::Evaluation answer = fast.evaluate(position);
    const reference::Rounded exact = reference.round_to_binary32(position);
    const auto where = [&] { return path + ":" + std::to_string(rows.line()); };
    std::vector<Eigen::Vector3f> at(fast::kSplineBatch, position), batch(at.size());
    fast.force(at, batch);
    for (int axis = 0; axis < 3; ++axis) {
      const float golden = rows.binary32(9 + static_cast<std::size_t>(axis));
      ASSERT_TRUE(same_bits(answer.force[axis], golden)) << where() << ": fast gives " << show(answer.force);
      ASSERT_TRUE(same_bits(batch.back()[axis], golden)) << where() << ": a batch gives " << show(batch.back());
      ASSERT_TRUE(same_bits(exact.force[axis], golden)) << where() << ": reference gives " << show(exact.force);
    }
    const Status status = rows.text(12) == "free"      ? Status::free
                          : rows.text(12) == "contact" ? Status::contact
                                                       : Status::invalid;
    ASSERT_EQ(answer.status, status) << where();
    ASSERT_EQ(exact.status, status) << where();
    if (status == Status::contact) {
      Eigen::Vector3f quantised = position;
      for (float& coordinate : quantised) coordinate = fast::quantised(coordinate);
      const tests::Balls balls({"", map, 0, {}});
      const auto force = balls.at<N>(quantised, named->mode, static_cast<double>(K)).force;
      const reference::DecimalMapForce digits = reference.decimal(position, 40);
      EXPECT_EQ(digits.status, status) << where();
      const std::array written{digits.x, digits.y, digits.z};
      for (std::size_t axis = 0; axis < 3; ++axis)
        EXPECT_EQ(canonical(written[axis]), canonical(rows.text(6 + axis))) << where();
      for (std::size_t axis = 0; axis < 3; ++axis)
        EXPECT_TRUE(has_these_digits(force[axis], rows.text(6 + axis))) << where() << ": " << rows.text(6 + axis);
    }
    ++count;
    ++stages[static_cast<std::size_t>(answer.stage)];
    ++methods[static_cast<std::size_t>(exact.method)];
    ++statuses[static_cast<std::size_t>(status)];
    renderings_met.emplace(rows.text(0), rows.text(1));
    for (const height::Part& part : map.parts) kinds.insert(part.shape.index());
  }
  std::printf("  %d rows of %zu maps; stages %d, %d, %d; reference %d by filter, %d by enclosure, %d by exact comparison\n",
              count, maps.size(), stages[0], stages[1], stages[2], methods[0], methods[1], methods[2]);
  EXPECT_GT(count, 1900);
  EXPECT_EQ(kinds.size(), std::variant_size_v<height::Shape>) << "a kind of height map has no golden row";
  for (const auto& [name, map] : maps)
    for (const auto& [mode, word] : height::kModes)
      if (map.surface.empty() || mode == height::Mode::force_shaded) {
        EXPECT_TRUE(renderings_met.contains({name, std::string(word)})) << name << ", " << word;
      }
  for (const auto& reached : {stages, methods, statuses})
    for (const int times : reached) EXPECT_GT(times, 0);
}

}  // namespace
}  // namespace forceshade

// SPDX-License-Identifier: BSD-3-Clause
#include "properties/height_positions.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "properties/binary32.h"
#include "reference/estimates.h"

namespace forceshade::properties {
namespace {

// mm: how far below the surface to go, for a part of this reach.
double depth_of(const PartShape& part) {
  return std::clamp(part.reach / 4, 1e-3, 5.0);
}

}  // namespace

std::array<float, 2> HeightPositionSource::anywhere() {
  const PartShape& one = part();
  const double x = one.x + uniform(-one.reach, one.reach);
  return {static_cast<float>(x), static_cast<float>(one.y + uniform(-one.reach, one.reach))};
}

// A few lines beyond the grid's own too: clamped or tiled, it goes on.
float HeightPositionSource::cell_line(const Lines& lines) {
  const auto index = static_cast<long>(bits() % (lines.count + 6)) - 3;
  return neighbour(static_cast<float>(lines.at(index)), small_step());
}

std::array<float, 2> HeightPositionSource::on_rim(const Rim& rim) {
  const double angle = uniform(0, 2 * std::numbers::pi);
  const auto x = static_cast<float>(rim.x + rim.radius * std::cos(angle));
  const double across = static_cast<double>(x) - rim.x;
  const double y = std::sqrt(std::max(0.0, (rim.radius - across) * (rim.radius + across)));
  return {x, neighbour(static_cast<float>(rim.y + (angle < std::numbers::pi ? y : -y)), small_step())};
}

std::array<float, 2> HeightPositionSource::on_a_line() {
  const PartShape& one = part();
  const std::uint64_t choice = bits() % 4;
  std::array<float, 2> at = anywhere();
  if (one.rim && choice < 2) return on_rim(*one.rim);
  if (choice != 1) at[0] = one.columns ? cell_line(*one.columns) : neighbour(mark(one.xs), small_step());
  if (choice != 0) at[1] = one.rows ? cell_line(*one.rows) : neighbour(mark(one.ys), small_step());
  return at;
}

std::array<float, 2> HeightPositionSource::at_a_centre() {
  const PartShape& one = part();
  std::array<float, 2> at{mark(one.xs), mark(one.ys)};
  if (bits() % 2 == 0) at = {neighbour(at[0], small_step()), neighbour(at[1], small_step())};
  return at;
}

double HeightPositionSource::surface(const std::array<float, 2>& at) const {
  const Eigen::Vector3f position(at[0], at[1], 0);
  return is_valid(position) ? static_cast<double>(law_.estimate(position).gap.mid()) : 0;
}

float HeightPositionSource::below(const std::array<float, 2>& at) {
  return static_cast<float>(surface(at) - uniform(-0.2, 1) * depth_of(part()));
}

float HeightPositionSource::near_surface(const std::array<float, 2>& at) {
  return neighbour(static_cast<float>(surface(at)), small_step());
}

// The one of eight neighbours in one coordinate whose force comes closest to a tie.
Eigen::Vector3f HeightPositionSource::near_tie(Eigen::Vector3f position) {
  Eigen::Vector3f best = position;
  float nearest = 1;
  float& moved = position[static_cast<Eigen::Index>(bits() % 3)];
  for (int i = 0; i < 8; ++i) {
    moved = neighbour(moved, 1);
    const float distance = law_.round_to_binary32(position).ulps_from_tie;
    if (distance >= nearest) continue;
    nearest = distance;
    best = position;
  }
  return best;
}

Aimed HeightPositionSource::next() {
  const std::uint64_t choice = bits() % 64;
  if (choice < 8) {
    const float x = any_float(), y = any_float();
    return {{x, y, any_float()}, Aim::any_bits};
  }
  const std::array<float, 2> at = choice < 42 ? anywhere() : on_a_line();
  const auto position = [](const std::array<float, 2>& xy, float z) { return Eigen::Vector3f(xy[0], xy[1], z); };
  if (choice < 32) return {position(at, below(at)), Aim::volume};
  if (choice < 42) {
    const std::array<float, 2> above = choice % 4 == 0 ? on_a_line() : at;
    return {position(above, near_surface(above)), Aim::surface};
  }
  if (choice < 48) return {position(at, choice % 3 == 0 ? any_binade() : below(at)), Aim::facet_line};
  if (choice < 51) {
    const std::array<float, 2> small{choice == 49 ? at[0] : tiny(), choice == 48 ? at[1] : tiny()};
    return {position(small, bits() % 2 == 0 ? tiny() : near_surface(small)), Aim::quantum};
  }
  if (choice < 53) {
    std::array<float, 2> end = at;
    end[choice - 51] = domain_end();
    return {position(end, bits() % 4 == 0 ? domain_end() : below(end)), Aim::domain_end};
  }
  if (choice < 55) {
    const std::array<float, 2> above = anywhere();
    return {near_tie(position(above, below(above))), Aim::tie};
  }
  if (choice < 58) {
    const std::array<float, 2> centre = at_a_centre();
    return {position(centre, choice == 55 ? near_surface(centre) : below(centre)), Aim::axis};
  }
  const PartShape& one = part();
  const double reach = kept_in_domain(one.reach + std::max(std::fabs(one.x), std::fabs(one.y)));
  const std::array<float, 2> round{few_bits(reach), few_bits(reach)};
  const double z = surface(round);
  const auto deep = static_cast<float>(std::round(16 * z) / 16);
  const double bottom = static_cast<double>(deep - std::fabs(few_bits(depth_of(one))));
  return {position(round, static_cast<float>(kept_in_domain(bottom))), Aim::few_bits};
}

}  // namespace forceshade::properties

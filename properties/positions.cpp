// SPDX-License-Identifier: BSD-3-Clause
#include "properties/positions.h"

#include <array>
#include <bit>
#include <cmath>

#include "properties/binary32.h"
#include "reference/estimates.h"

namespace forceshade::properties {
namespace {

// The distance of a force component from the nearest rounding tie, in units of the last place of the binary32 result.
long double distance_to_tie(const reference::Ball64& component) {
  const auto rounded = static_cast<float>(component.mid());
  const long double half = half_spacing(rounded);
  if (half == 0) return 1;
  return 1 - std::fabs(component.mid() - static_cast<long double>(rounded)) / half;
}

}  // namespace

std::string_view name_of(Aim aim) {
  return kAimNames[static_cast<std::size_t>(aim)];
}

double Draws::uniform(double low, double high) {
  return low + (high - low) * static_cast<double>(bits() >> 11) * 0x1p-53;
}

int Draws::small_step() {
  return static_cast<int>(bits() % 7) - 3;
}

float Draws::any_float() {
  return std::bit_cast<float>(static_cast<std::uint32_t>(bits()));
}

float Draws::any_binade() {
  const auto size = static_cast<float>(std::ldexp(uniform(1, 2), static_cast<int>(bits() % 34) - 30));
  return (bits() & 1) != 0 ? size : -size;
}

float Draws::few_bits(double reach) {
  const int places = static_cast<int>(bits() % 24);
  return static_cast<float>(std::ldexp(std::round(std::ldexp(uniform(-reach, reach), places)), -places));
}

float Draws::tiny() {
  const float size = neighbour(reference::kPositionQuantum, small_step());
  return (bits() & 1) != 0 ? size : -size;
}

float Draws::domain_end() {
  const float size = neighbour(reference::kDomainEnd, small_step());
  return (bits() & 1) != 0 ? size : -size;
}

float PositionSource::in_volume_x() {
  const double reach = claims_.R > 0 ? 0.6 * static_cast<double>(claims_.w) : 20;
  return static_cast<float>(uniform(-reach, reach));
}

float PositionSource::near_surface(float x) {
  const auto surface = static_cast<float>(claims_.surface(static_cast<long double>(x)));
  return neighbour(surface, small_step());
}

float PositionSource::near_line() {
  std::array<long double, 4> lines{0, claims_.w / 2, claims_.w_prime / 2, claims_.R};
  const auto x = static_cast<float>(lines[bits() % lines.size()]);
  return neighbour((bits() & 1) != 0 ? x : -x, small_step());
}

// The one of eight neighbours in x or z whose force comes closest to a tie.
Eigen::Vector3f PositionSource::near_tie(Eigen::Vector3f position) {
  Eigen::Vector3f best = position;
  long double best_distance = 2;
  float& moved = (bits() & 1) != 0 ? position.x() : position.z();
  for (int i = 0; i < 8; ++i) {
    moved = neighbour(moved, 1);
    const reference::Force<reference::Ball64> force = law_.estimate(position).force;
    const long double distance = std::min(distance_to_tie(force.x), distance_to_tie(force.z));
    if (distance < best_distance) {
      best_distance = distance;
      best = position;
    }
  }
  return best;
}

Aimed PositionSource::next() {
  const std::uint64_t choice = bits() % 64;
  const float y = choice % 8 == 0 ? any_float() : static_cast<float>(uniform(-100, 100));
  const double depth = static_cast<double>(claims_.R > 0 ? claims_.h + claims_.w / 8 : 5);
  const auto below_surface = [&](float x) {
    return static_cast<float>(static_cast<double>(claims_.surface(static_cast<long double>(x))) - uniform(-0.2, 1) * depth);
  };
  if (choice < 8) return {{any_float(), y, any_float()}, Aim::any_bits};
  if (choice < 32) {
    const float x = in_volume_x();
    return {{x, y, below_surface(x)}, Aim::volume};
  }
  if (choice < 42) {
    const float x = choice % 4 == 0 ? near_line() : in_volume_x();
    return {{x, y, near_surface(x)}, Aim::surface};
  }
  if (choice < 48) {
    const float x = near_line();
    return {{x, y, choice % 3 == 0 ? any_binade() : below_surface(x)}, Aim::facet_line};
  }
  if (choice < 51) {
    const float small = tiny();
    if (choice == 48) return {{small, y, (bits() & 1) != 0 ? near_surface(small) : below_surface(0)}, Aim::quantum};
    if (choice == 49) return {{near_line(), y, small}, Aim::quantum};
    return {{neighbour(0, small_step()), y, neighbour(0, small_step())}, Aim::quantum};
  }
  if (choice < 53) {
    const float end = domain_end();
    const float x = in_volume_x();
    return choice == 51 ? Aimed{{end, y, below_surface(0)}, Aim::domain_end} : Aimed{{x, y, end}, Aim::domain_end};
  }
  if (choice < 55) {
    const float x = in_volume_x();
    return {near_tie({x, 0, below_surface(x)}), Aim::tie};
  }
  if (choice < 58) {
    const auto axis = static_cast<float>(-claims_.d);
    const float x = choice == 55 ? 0.0F : choice == 56 ? neighbour(0, small_step()) * 0x1p120F : in_volume_x() * 0x1p-20F;
    return {{x, y, neighbour(axis, small_step())}, Aim::axis};
  }
  return {{few_bits(claims_.R > 0 ? 0.6 * static_cast<double>(claims_.w) : 20), y, few_bits(depth)}, Aim::few_bits};
}

}  // namespace forceshade::properties

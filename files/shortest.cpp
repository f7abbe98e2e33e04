// SPDX-License-Identifier: BSD-3-Clause
#include "files/shortest.h"

#include <array>
#include <charconv>

namespace forceshade::files {
namespace {

template <class T>
std::string shortest_decimal(T value) {
  std::array<char, 32> buffer{};
  const auto [end, code] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), end};
}

}  // namespace

std::string shortest(float value) {
  return shortest_decimal(value);
}

std::string shortest(double value) {
  return shortest_decimal(value);
}

}  // namespace forceshade::files

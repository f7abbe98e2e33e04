// SPDX-License-Identifier: BSD-3-Clause
#include "device/placement_text.h"

#include <algorithm>
#include <charconv>
#include <string_view>
#include <vector>

#include "fast/domain.h"
#include "files/csv.h"
#include "files/quantity.h"
#include "forceshade/error.h"

namespace forceshade::device {
namespace {

// "z90", "x-90deg": the axis, and how many quarter turns.
std::pair<int, int> quarter_turns(const std::string& text) {
  const auto refuse = [&] {
    return Error("--place: expected an axis and a multiple of 90 degrees, such as z90 or x-90,z180, got \"" + text +
                 "\"; another angle would round the force");
  };
  const std::size_t axis = std::string_view("xyz").find(text.empty() ? ' ' : text[0]);
  if (axis == std::string_view::npos) throw refuse();
  int degrees = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data() + 1, end, degrees);
  const std::string_view unit(rest, static_cast<std::size_t>(end - rest));
  if (error != std::errc{} || (!unit.empty() && unit != "deg") || degrees % 90 != 0) throw refuse();
  return {static_cast<int>(axis), degrees / 90};
}

}  // namespace

device::Placement parse_placement(const std::string& text) {
  const std::vector<std::string> parts = text.empty() ? std::vector<std::string>{} : files::at_commas(text);
  const auto is_turn = [](const std::string& part) { return !part.empty() && part[0] >= 'x' && part[0] <= 'z'; };
  const auto first_turn = std::ranges::find_if(parts, is_turn);
  const auto lengths = static_cast<std::size_t>(first_turn - parts.begin());
  if (lengths != 0 && lengths != 3)
    throw Error("--place: expected three lengths X,Y,Z such as 10mm,0,-1in, turns such as z90, or both, got \"" + text + '"');
  Eigen::Vector3f shift{0, 0, 0};
  for (std::size_t i = 0; i < lengths; ++i) {
    const float length = files::parse_length("--place", parts[i]);
    if (!fast::in_domain(length)) throw Error("--place: expected at most 10000 mm each way, got \"" + parts[i] + '"');
    shift[static_cast<Eigen::Index>(i)] = length;
  }
  device::Placement placement(shift);
  for (auto turn = first_turn; turn != parts.end(); ++turn) {
    const auto [axis, quarters] = quarter_turns(*turn);
    placement = placement.turned(axis, quarters);
  }
  return placement;
}

}  // namespace forceshade::device

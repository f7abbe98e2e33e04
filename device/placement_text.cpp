// SPDX-License-Identifier: BSD-3-Clause
#include "device/placement_text.h"

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
    return Error("--turn: expected an axis and a multiple of 90 degrees, such as z90 or x-90,z180, got \"" + text +
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

device::Placement parse_placement(const std::string& origin, const std::string& turn) {
  Eigen::Vector3f shift{0, 0, 0};
  if (!origin.empty()) {
    const std::vector<std::string> lengths = files::at_commas(origin);
    if (lengths.size() != 3) throw Error("--origin: expected three lengths X,Y,Z such as 10mm,0,-1in, got \"" + origin + '"');
    for (std::size_t i = 0; i < 3; ++i) {
      const float length = files::parse_length("--origin", lengths[i]);
      if (!fast::in_domain(length)) throw Error("--origin: expected at most 10000 mm each way, got \"" + lengths[i] + '"');
      shift[static_cast<Eigen::Index>(i)] = length;
    }
  }
  device::Placement placement(shift);
  if (turn.empty()) return placement;
  for (const std::string& one : files::at_commas(turn)) {
    const auto [axis, quarters] = quarter_turns(one);
    placement = placement.turned(axis, quarters);
  }
  return placement;
}

}  // namespace forceshade::device

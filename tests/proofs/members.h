// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The numbers that a law holds for its first stage, in the order in which the definitions of proofs/ take them.

#include <string>
#include <utility>
#include <vector>

#include "fast/laws/all.h"

namespace forceshade::tests {

// The names and values of the numbers that a law holds: those that its definition has of these.
using Constants = std::vector<std::pair<std::string, double>>;

inline void add(Constants& to, const std::string& prefix, const fast::LinearGap& gap) {
  to.insert(to.end(), {{prefix + "height", gap.height},
                       {prefix + "height_tail", gap.height_tail},
                       {prefix + "slope", gap.slope.head},
                       {prefix + "slope_tail", gap.slope.tail}});
}
inline void add(Constants& to, const std::string&, const fast::ThreePolygonGap& gap) {
  to.insert(to.end(), {{"top_height", gap.top.height}, {"top_height_tail", gap.top.height_tail}});  // its slope is 0
  add(to, "side_", gap.side);
}

template <class Definition>
Constants constants_of(const Definition& law) {
  Constants all;
  if constexpr (requires { law.gap; }) add(all, "", law.gap);
  if constexpr (requires { law.shading; }) all.insert(all.end(), {{"R", law.shading.R}, {"K_over_R", law.shading.K_over_R}});
  if constexpr (requires { law.K; }) all.emplace_back("K", law.K);
  if constexpr (requires { law.K_sine; }) all.insert(all.end(), {{"K_sine", law.K_sine}, {"K_cosine", law.K_cosine}});
  if constexpr (requires { law.axis; })
    all.insert(all.end(), {{"R", law.R},
                           {"anchor", law.anchor},
                           {"anchored", law.anchored},
                           {"rest", law.rest},
                           {"d_head", law.d.head},
                           {"d_tail", law.d.tail},
                           {"axis", law.axis}});
  if constexpr (requires { law.half_width; }) all.emplace_back("half_width", law.half_width);
  if constexpr (requires { law.half_top; }) all.emplace_back("half_top", static_cast<double>(law.half_top));
  return all;
}

}  // namespace forceshade::tests

// SPDX-License-Identifier: BSD-3-Clause
#include "study/analysis/profiles.h"

#include <algorithm>
#include <variant>

#include "properties/law_claims.h"

namespace forceshade::analysis {

std::vector<Position> nominal_line(LawId law, const Parameters& parameters, double centre, double from, double to) {
  const auto built = reference::Law::build(law, parameters);
  if (!std::holds_alternative<reference::Law>(built)) return {};
  const properties::LawClaims claims(std::get<reference::Law>(built));
  constexpr int kPlaces = 400;
  std::vector<double> places;
  for (int i = 0; i <= kPlaces; ++i) places.push_back(from + (to - from) * i / kPlaces);
  const double half = static_cast<double>(claims.w) / 2, flat = static_cast<double>(claims.w_prime) / 2;
  for (const double corner : {-half, -flat, 0.0, flat, half})
    if (centre + corner > from && centre + corner < to) places.push_back(centre + corner);
  std::ranges::sort(places);
  std::vector<Position> line;
  for (const double x : places) line.push_back({x, static_cast<double>(claims.surface(static_cast<long double>(x - centre)))});
  return line;
}

}  // namespace forceshade::analysis

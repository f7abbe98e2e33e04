// SPDX-License-Identifier: BSD-3-Clause
#include "properties/law_claims.h"

#include <cmath>

#include "reference/energy.h"
#include "reference/estimates.h"

namespace forceshade::properties {

LawClaims::LawClaims(const reference::Law& law)
    : id(law.id()),
      R(has_bump_geometry(id) ? law.geometry().R.mid() : 0),
      w(has_bump_geometry(id) ? law.geometry().w.mid() : 0),
      K(law.geometry().K.mid()),
      d(law.geometry().d.mid()),
      alpha(R > 0 ? std::asin(w / (2 * R)) : 0),
      theta(2 * alpha / 3),
      h(law.geometry().h.mid()),
      w_prime(law.geometry().w_prime.mid()),
      h_prime(law.geometry().h_prime.mid()),
      is_conservative(reference::potential(law).has_value()),
      steepest(0) {
  switch (id) {
    case LawId::wall:
    case LawId::cylinder:
    case LawId::bump_cylinder:
    case LawId::bump_1p: break;
    case LawId::bump_2p:
      jump_lines = {{0, h, alpha}, {w / 2, 0, alpha / 2}};
      steepest = std::tan(alpha / 2);
      break;
    case LawId::bump_3p:
      jump_lines = {{w_prime / 2, h_prime, theta}, {w / 2, 0, theta}};
      steepest = std::tan(theta);
      break;
    case LawId::bump_2p_shaded:
    case LawId::bump_3p_shaded: steepest = std::tan(id == LawId::bump_2p_shaded ? alpha / 2 : theta); [[fallthrough]];
    case LawId::bump_1p_shaded: jump_lines = {{w / 2, 0, alpha}}; break;
  }
}

long double LawClaims::surface(long double x) const {
  const long double ax = std::fabs(x);
  switch (id) {
    case LawId::wall:
    case LawId::bump_1p:
    case LawId::bump_1p_shaded: return 0;
    case LawId::cylinder: return ax < R ? std::sqrt((R - ax) * (R + ax)) - d : -d;
    case LawId::bump_cylinder: return ax < w / 2 ? (w / 2 - ax) * (w / 2 + ax) / (std::sqrt((R - ax) * (R + ax)) + d) : 0;
    case LawId::bump_2p:
    case LawId::bump_2p_shaded: return ax <= w / 2 ? steepest * (w / 2 - ax) : 0;
    case LawId::bump_3p:
    case LawId::bump_3p_shaded: return ax <= w_prime / 2 ? h_prime : ax <= w / 2 ? steepest * (w / 2 - ax) : 0;
  }
  return 0;
}

bool LawClaims::is_shaded() const {
  return id == LawId::bump_1p_shaded || id == LawId::bump_2p_shaded || id == LawId::bump_3p_shaded;
}

std::vector<std::string> LawClaims::jumps() const {
  if (has_cylinder()) return {"the axis"};
  std::vector<std::string> words;
  for (const JumpLine& line : jump_lines) words.push_back(line.x == 0 ? "x = 0" : line.x == w / 2 ? "|x| = w/2" : "|x| = w'/2");
  return words;
}

}  // namespace forceshade::properties

// SPDX-License-Identifier: BSD-3-Clause
#include "tests/laws/cases.h"

#include <cmath>
#include <cstdio>

#include "files/csv.h"
#include "reference/numbers/numbers.h"

namespace forceshade::tests {
namespace {

using reference::Multiprecision;

// log2 of the distance to the nearest tie over the size of the value; minus infinity for a tie, 0 for zero.
double log_distance(const std::string& value, bool may_tie) {
  const Multiprecision size = abs(Multiprecision(value));
  if (size == 0) return 0;
  const long exponent = ilogb(size);
  const Multiprecision places = ldexp(size, 23 - exponent);
  const Multiprecision off = abs(places - floor(places) - Multiprecision(0.5));
  if (may_tie && off < ldexp(Multiprecision(1), -200)) return -HUGE_VAL;
  return static_cast<double>(log2(off / places));
}

}  // namespace

std::vector<HardCase> read_hard_cases(std::istream& in, const std::string& file) {
  files::Reader reader(in, file, {"R", "w", "K", "x", "z", "Fx", "Fz", "from tie", "why"});
  std::vector<HardCase> cases;
  while (reader.next()) {
    const auto number = [&](std::size_t i) { return reader.binary32(i); };
    cases.push_back({{number(0), number(1), number(2)},
                     {number(3), 0, number(4)},
                     {number(5), 0, number(6)},
                     reader.text(7),
                     reader.text(8),
                     file + ":" + std::to_string(reader.line())});
    if (cases.back().from_tie.empty()) throw reader.unexpected(7, "a distance");
    if (cases.back().why.empty()) throw reader.unexpected(8, "words");
  }
  if (cases.empty()) throw Error(file + ":1: expected cases below the header");
  return cases;
}

std::vector<HardCase> hard_cases(LawId law) {
  const std::string file = "tests/laws/" + std::string(kLaws[static_cast<std::size_t>(law)].file) + ".cases";
  std::ifstream in = files::open_input(std::string(FORCESHADE_SOURCE_DIR "/") + file);
  return read_hard_cases(in, file);
}

std::string distance_from_tie(const reference::Law& law, const Eigen::Vector3f& position) {
  // A component that 768 bits leave open is a tie (docs/proofs.md): only then is a distance called 0 that 80 digits cannot
  // tell from 0.
  const bool may_tie = law.round_to_binary32(position).method == reference::Method::exact;
  const reference::DecimalForce force = law.decimal(position, 80);
  reference::set_precision(320);
  const double x = log_distance(force.x, may_tie), z = log_distance(force.z, may_tie);
  const double nearest = std::min(x, z);
  char text[32];
  if (std::isinf(nearest))
    std::snprintf(text, sizeof text, "%c 0", x < z ? 'x' : 'z');
  else
    std::snprintf(text, sizeof text, "%c 2^%.1f", x < z ? 'x' : 'z', nearest);
  return text;
}

}  // namespace forceshade::tests

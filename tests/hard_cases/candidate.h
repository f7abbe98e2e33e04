// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Measures how hard an input is for each stage of fast/, and keeps the few hardest of each kind.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "fast/evaluate.h"
#include "fast/laws/all.h"
#include "forceshade/fast.h"

namespace forceshade::tests {

using fast::DoubleDouble;

struct Candidate {
  Parameters p;
  float x, z;    // mm
  double score;  // larger is harder
};

// The hardest candidates of each kind, one per bump.
class Hardest {
 public:
  explicit Hardest(std::size_t most) : most_(most) {}

  void offer(const std::string& kind, const Candidate& candidate) {
    std::vector<Candidate>& all = kinds_[kind];
    const auto same = std::find_if(all.begin(), all.end(), [&](const Candidate& other) {
      return other.p.radius == candidate.p.radius && other.p.width == candidate.p.width;
    });
    if (same != all.end() && same->score >= candidate.score) return;
    if (same != all.end()) all.erase(same);
    all.push_back(candidate);
    std::sort(all.begin(), all.end(), [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
    if (all.size() > most_) all.pop_back();
  }
  // The score that a candidate must exceed to be kept.
  double bar(const std::string& kind) const {
    const auto found = kinds_.find(kind);
    return found == kinds_.end() || found->second.size() < most_ ? 0 : found->second.back().score;
  }
  const std::map<std::string, std::vector<Candidate>>& kinds() const { return kinds_; }

 private:
  std::size_t most_;
  std::map<std::string, std::vector<Candidate>> kinds_;
};

// The rounding tie nearest to `value`, and the binary32 unit in the last place there.
struct Tie {
  double at, unit;
};
inline Tie tie_near(double value) {
  const double unit = std::ldexp(1.0, std::ilogb(value) - 23);
  return {(std::floor(value / unit) + 0.5) * unit, unit};
}

inline DoubleDouble operator-(const DoubleDouble& value, double other) {
  return value - DoubleDouble::exactly(other);
}

inline bool holds_its_tie(const DoubleDouble& value) {
  return std::fabs((value - tie_near(value.hi).at).hi) <= value.error;
}

// The truth about a value: the binary32 nearest to it, and its distance from its tie relative to its size, 0 for a tie.
struct Truth {
  float right;
  double from_tie;
};
// From double-double: where that holds the tie, it is taken to be the tie.
inline Truth presumed(const DoubleDouble& value) {
  const Tie tie = tie_near(value.hi);
  if (holds_its_tie(value)) return {static_cast<float>(tie.at), 0};
  const double off = (value - tie.at).hi;
  return {static_cast<float>(tie.at + std::copysign(0.25 * tie.unit, off)), std::fabs(off / tie.at)};
}
// From an enclosure that is narrow enough.
template <class BigFloatBall>
Truth truth(const BigFloatBall& value) {
  const Tie tie = tie_near(approximately(value));
  const BigFloatBall off = value - BigFloatBall::exactly(tie.at);
  return {*fast::round_to_binary32(value), sign(off) == fast::Sign::zero ? 0 : std::fabs(approximately(off) / tie.at)};
}

// The doubt window (fast/numbers/first_stage.h) that this binary64 answer needs, in units of its last place: 0 where it rounds
// rightly.
inline double needed_window(double answer, float right) {
  if (static_cast<float>(answer) == right) return 0;
  const auto dropped = static_cast<int>(std::bit_cast<std::uint64_t>(answer) & fast::kDroppedMask);
  return std::abs(dropped - (fast::kDroppedMask + 1) / 2);
}

// The part of double-double's claimed error that is needed to keep it from rounding wrongly: 0 where it rounds rightly.
inline double needed_error(const DoubleDouble& answer, float right) {
  if (fast::round_to_binary32(midpoint(answer)) == right) return 0;
  return std::fabs((answer - tie_near(answer.hi).at).hi) / answer.error;
}

// The size of the penetration, next to that below which the first stage doubts itself.
inline double share_of_doubt(const fast::Cylinder& law, float, float z, double penetration) {
  const double d = law.d.head, R = law.R;
  return 2 * R * penetration / (0x1p-25 * d * std::fabs(static_cast<double>(z)) + 0x1p-47 * R * R);
}
// Below the plane the two forces of bump-cylinder may also cancel, which is no matter of a threshold.
inline double share_of_doubt(const fast::BumpCylinder& law, float x, float z, double penetration) {
  return z < 0 ? 1e-9 : share_of_doubt(static_cast<const fast::Cylinder&>(law), x, z, penetration);
}
template <class Definition>
double share_of_doubt(const Definition& law, float x, float, double penetration) {
  if constexpr (requires { law.half_top; })
    return penetration / (0x1p-27 * (std::fabs(x) <= law.half_top ? law.gap.top.height : law.gap.side.height));
  else if constexpr (requires { law.gap; })
    return penetration / (0x1p-27 * law.gap.height);
  else
    return 0;
}

}  // namespace forceshade::tests

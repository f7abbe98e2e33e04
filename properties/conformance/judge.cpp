// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/judge.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "files/csv.h"

namespace forceshade::conformance {
namespace {

std::size_t bin_of_ulps(std::uint64_t ulps) {
  return ulps == kNoNumber ? Judgement::kUlpBins - 1 : static_cast<std::size_t>(std::bit_width(ulps));
}

std::size_t bin_of_newtons(double distance) {
  if (!(distance <= std::pow(10.0, Judgement::kMostPower))) return Judgement::kMostPower - Judgement::kLeastPower + 1;
  if (distance <= std::pow(10.0, Judgement::kLeastPower)) return 0;
  return static_cast<std::size_t>(static_cast<int>(std::ceil(std::log10(distance))) - Judgement::kLeastPower);
}

// How large an error is in each unit; percent of an exact zero counts as infinite.
double size_of(const Distance& distance, Unit unit) {
  switch (unit) {
    case Unit::ulp: return static_cast<double>(distance.ulps);
    case Unit::newton: return distance.newtons.high;
    default: return distance.ulps == 0 ? 0 : 100 * distance.newtons.high / distance.exact_newtons.high;
  }
}

// How many characters it takes to write a position: fewer are simpler.
std::size_t length_of(const Eigen::Vector3f& position) {
  std::size_t length = 0;
  for (const float coordinate : position) length += files::shortest(coordinate).size();
  return length;
}

}  // namespace

std::optional<Judged> Judge::add(const Case& next) {
  if (session_ == nullptr || next.is_reset) session_ = subject_->open_reference();
  Judged judged{.its = next, .exact = {}, .distance = {}};
  try {
    judged.exact = session_->step(next.position);
  } catch (const std::domain_error&) {
    ++judgement_.undecided;
    return std::nullopt;
  }
  if (judged.exact.is_unfinished) {
    ++judgement_.unfinished;
    return std::nullopt;
  }
  judged.distance = distance(next.force, judged.exact);
  judged.is_within =
      is_within(tolerance_, next.force, judged.exact, [&](unsigned digits) { return session_->decimal(digits); });
  count(judged);
  return judged;
}

void Judge::keep(Judged judged, std::optional<Judged>& where) const {
  if (const auto digits = session_->decimal(kShownDigits)) judged.digits = *digits;
  where = std::move(judged);
}

void Judge::count(const Judged& judged) {
  const bool is_wrong = judged.distance.ulps != 0;
  for (Count* count : {&judgement_.all, &judgement_.by_aim[judged.its.aim]}) {
    ++count->cases;
    count->wrong += is_wrong;
    count->beyond += !judged.is_within;
  }
  (is_wrong ? judgement_.wrong : judgement_.right).add(judgement_.all.cases, {judged.its.position, judged.distance.ulps});
  ++judgement_.by_ulps[bin_of_ulps(judged.distance.ulps)];
  ++judgement_.by_newtons[bin_of_newtons(is_wrong ? judged.distance.newtons.high : 0)];
  if (is_wrong)
    for (const Unit unit : {Unit::ulp, Unit::newton, Unit::percent}) {
      std::optional<Judged>& worst = judgement_.worst[static_cast<std::size_t>(unit)];
      if (!worst || size_of(judged.distance, unit) > size_of(worst->distance, unit)) keep(judged, worst);
    }
  std::optional<Judged>& simplest = judgement_.simplest;
  if (!judged.is_within && (!simplest || length_of(judged.its.position) < length_of(simplest->its.position)))
    keep(judged, simplest);
}

}  // namespace forceshade::conformance

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

// The size of an error in a unit; percent of an exact zero counts as infinite.
double size_of(const Distance& distance, Unit unit) {
  switch (unit) {
    case Unit::ulp: return static_cast<double>(distance.ulps);
    case Unit::newton: return distance.newtons.high;
    default: return distance.ulps == 0 ? 0 : 100 * distance.newtons.high / distance.exact_newtons.high;
  }
}

// The number of characters that it takes to write a position: fewer are simpler.
std::size_t length_of(const Eigen::Vector3f& position) {
  std::size_t length = 0;
  for (const float coordinate : position) length += shortest(coordinate).size();
  return length;
}

bool is_worse(const Judged& one, const std::optional<Judged>& than, Unit unit) {
  return !than || size_of(one.distance, unit) > size_of(than->distance, unit);
}

bool is_simpler(const Judged& one, const std::optional<Judged>& than) {
  return !than || length_of(one.its.position) < length_of(than->its.position);
}

}  // namespace

void Judgement::append(const Judgement& later) {
  const auto add = [](Count& to, const Count& more) {
    to.cases += more.cases;
    to.wrong += more.wrong;
    to.beyond += more.beyond;
  };
  add(all, later.all);
  for (const auto& [aim, count] : later.by_aim) add(by_aim[aim], count);
  for (std::size_t i = 0; i < by_ulps.size(); ++i) by_ulps[i] += later.by_ulps[i];
  for (std::size_t i = 0; i < by_newtons.size(); ++i) by_newtons[i] += later.by_newtons[i];
  right.append(later.right);
  wrong.append(later.wrong);
  undecided += later.undecided;
  unfinished += later.unfinished;
  for (std::size_t i = 0; i < worst.size(); ++i)
    if (later.worst[i] && is_worse(*later.worst[i], worst[i], static_cast<Unit>(i))) worst[i] = later.worst[i];
  if (later.simplest && is_simpler(*later.simplest, simplest)) simplest = later.simplest;
}

reference::Rounded Judge::exact_of(const Case& next) {
  if (!damping_) return session_->step(next.position);
  reference::Rounded spring;
  spring.status = Status::contact;
  try {
    spring = session_->step(next.position);
  } catch (const std::domain_error&) {
    damping_->tick(next.position, next.periods, spring);  // the hand's speed goes on
    throw;
  }
  return damping_->tick(next.position, next.periods, spring);
}

std::optional<std::array<std::string, 3>> Judge::decimal(unsigned digits) const {
  return damping_ ? std::nullopt : session_->decimal(digits);
}

std::optional<Judged> Judge::add(const Case& next) {
  ++number_;
  if (session_ == nullptr || next.is_reset) {
    session_ = subject_->open_reference();
    if (damping_) damping_->reset();
  }
  exact_ = std::nullopt;
  reference::Rounded exact;
  try {
    exact = exact_of(next);
  } catch (const std::domain_error&) {
    ++judgement_.undecided;
    return std::nullopt;
  }
  if (exact.status == Status::unfinished) {
    ++judgement_.unfinished;
    return std::nullopt;
  }
  exact_ = exact;
  if (tolerance_.unit == Unit::ulp && next.force == exact.force) {  // nearly all answers of a good renderer: no distance
    count(next, {}, true);
    return std::nullopt;
  }
  const Distance its = distance(next.force, exact);
  const bool within = is_within(tolerance_, next.force, exact, [&](unsigned digits) { return decimal(digits); });
  count(next, its, within);
  Judged judged{next, exact, its};
  if (its.ulps != 0 || !within) keep(judged, within);
  return within ? std::nullopt : std::optional(std::move(judged));
}

void Judge::count(const Case& its, const Distance& distance, bool is_within) {
  const bool is_wrong = distance.ulps != 0;
  for (Count* count : {&judgement_.all, &judgement_.by_aim[its.aim]}) {
    ++count->cases;
    count->wrong += is_wrong;
    count->beyond += !is_within;
  }
  (is_wrong ? judgement_.wrong : judgement_.right).add(number_, {its.position, distance.ulps});
  ++judgement_.by_ulps[bin_of_ulps(distance.ulps)];
  ++judgement_.by_newtons[bin_of_newtons(is_wrong ? distance.newtons.high : 0)];
}

void Judge::keep(const Judged& judged, bool is_within) {
  if (judged.distance.ulps != 0)
    for (const Unit unit : {Unit::ulp, Unit::newton, Unit::percent}) {
      std::optional<Judged>& worst = judgement_.worst[static_cast<std::size_t>(unit)];
      if (is_worse(judged, worst, unit)) keep(judged, worst);
    }
  if (!is_within && is_simpler(judged, judgement_.simplest)) keep(judged, judgement_.simplest);
}

void Judge::keep(Judged judged, std::optional<Judged>& where) const {
  if (const auto digits = decimal(kShownDigits)) judged.digits = *digits;
  where = std::move(judged);
}

}  // namespace forceshade::conformance

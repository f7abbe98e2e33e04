// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A judgement in which each number is another one, so that none can stand for another.

#include "properties/conformance/judge.h"

namespace forceshade::conformance {

inline Judgement made_judgement() {
  Judgement its;
  its.all = {100, 60, 50};
  its.by_aim = {{"tie", {10, 4, 3}}, {"surface", {90, 56, 47}}};
  its.by_ulps = {40, 5, 6, 7};  // 0; 1; 2 to 3; 4 to 7
  its.by_ulps.back() = 42;
  its.by_newtons[0] = 40;   // which are correctly rounded
  its.by_newtons[42] = 10;  // 10^-3 at most
  its.by_newtons[its.by_newtons.size() - 2] = 8;
  its.by_newtons.back() = 42;
  its.undecided = 3;
  its.unfinished = 1;
  const Judged worst{
      .its = {{3, 0, -1}, false, {0, 0, 2.5F}, "surface", "mine.csv:4"}, .exact = {}, .distance = {5, {0.5, 0.5}, {2, 2}}};
  its.worst = {worst, worst, worst};
  const auto seen = [](Sample<Place>& sample, std::uint64_t count) {
    for (std::uint64_t i = 0; i < count; ++i) sample.add(i, {{3, 0, -1}, 1});
  };
  seen(its.right, 40);
  seen(its.wrong, Sample<Place>::kMost + 952);  // more than are drawn
  return its;
}

}  // namespace forceshade::conformance

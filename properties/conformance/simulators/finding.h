// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The finding of one invariant: the largest deviation from the truth, for what it is to a hand, and its place.

#include <cstdint>
#include <string>

#include "properties/conformance/invariants/invariant.h"
#include "properties/conformance/simulators/run.h"

namespace forceshade::conformance::simulators {

// value and allowed have one unit; the words are whole: "0.31 N sideways".
struct Felt {
  double value = 0, allowed = 0;
  std::string words;
};

// "0.31 N", in four significant digits.
std::string measured(double value, const char* unit);
// "0.99 N instead of 1 N", in as many digits as show that they differ.
std::string measured_instead_of(double truth, double value, const char* unit);
Felt felt_newtons(double newtons, double allowed, const std::string& how);
Felt felt_millimetres(double metres, double allowed, const std::string& how);

class Finding {
 public:
  explicit Finding(std::string name) : its_{std::move(name)} {}

  void count() { ++its_.cases; }
  // Not a case: why.
  void skip(const std::string& reason) {
    if (skipped_++ == 0) reason_ = reason;
  }
  // In step k of a case; place: which case. A value that is no number exceeds whatever is allowed.
  void look(const Felt& felt, const std::string& place, std::size_t k);
  void note(const std::string& words) { largest_words_ = words; }  // where there is nothing to measure
  void violated(const std::string& words) { its_.violated(words); }

  Invariant invariant() const;

 private:
  Invariant its_;
  double largest_ = -1;  // the deviation as felt, in units of what is allowed
  std::string largest_words_;
  std::uint64_t skipped_ = 0;
  std::string reason_;
};

}  // namespace forceshade::conformance::simulators

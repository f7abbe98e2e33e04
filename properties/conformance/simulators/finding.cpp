// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/simulators/finding.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "text/number_text.h"

namespace forceshade::conformance::simulators {
namespace {

constexpr double kMillimetres = 1000;  // in a metre
constexpr int kDigits = 4;

double in_units_of_allowed(const Felt& felt) {
  if (felt.value == 0) return 0;
  const double ratio = felt.value / felt.allowed;
  return std::isnan(ratio) ? std::numeric_limits<double>::infinity() : ratio;
}

std::string in_digits(int digits, double value, const char* unit) {
  // A NaN has no sign.
  return forceshade::digits(std::isnan(value) ? std::abs(value) : value, digits) + ' ' + unit;
}

}  // namespace

std::string measured(double value, const char* unit) {
  return in_digits(kDigits, value, unit);
}

std::string measured_instead_of(double truth, double value, const char* unit) {
  const double ratio = std::abs(truth / (value - truth));
  const int digits = std::isnormal(ratio) ? std::clamp(static_cast<int>(std::ceil(std::log10(ratio))) + 2, kDigits,
                                                       std::numeric_limits<double>::max_digits10)
                                          : kDigits;
  return in_digits(digits, value, unit) + " instead of " + in_digits(digits, truth, unit);
}

Felt felt_newtons(double newtons, double allowed, const std::string& how) {
  return {newtons, allowed, measured(newtons, "N ") + how + ", allowed " + measured(allowed, "N")};
}

Felt felt_millimetres(double metres, double allowed, const std::string& how) {
  return {metres, allowed,
          measured(kMillimetres * metres, "mm ") + how + ", allowed " + measured(kMillimetres * allowed, "mm")};
}

void Finding::look(const Felt& felt, const std::string& place, std::size_t k) {
  const double ratio = in_units_of_allowed(felt);
  if (!(ratio > largest_)) return;
  largest_ = ratio;
  largest_words_ = felt.words + "; step " + std::to_string(k) + ", " + place;
}

Invariant Finding::invariant() const {
  Invariant found = its_;
  const std::string also = skipped_ == 0 ? "" : "; not applicable to " + std::to_string(skipped_) + " cases, since " + reason_;
  if (largest_ > 1) found.violated(largest_words_ + also);
  if (largest_ >= 0) found.share_of_allowed = largest_;
  if (found.cases == 0)
    found.not_applicable = reason_;
  else
    found.largest = largest_words_ + also;
  return found;
}

}  // namespace forceshade::conformance::simulators

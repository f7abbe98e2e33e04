// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A time as a file writes it, so that a difference of two is rounded once: ns since 1970 have 19 digits, binary64 has 16.

#include <boost/multiprecision/cpp_int.hpp>
#include <string>

namespace forceshade::conformance {

class ExactTime {
 public:
  ExactTime() = default;

  // text: a number as files::Reader reads it, and value: what it read, which is finite. Of a hexfloat, and of a decimal with
  // very many digits, the shortest decimal of the value stands for it.
  ExactTime(const std::string& text, double value);

  // The binary64 number nearest to the difference in s. power: of ten, that one of the file's unit is in s.
  double seconds_since(const ExactTime& other, int power) const;

 private:
  boost::multiprecision::cpp_int digits_;  // times ten to the power of exponent_
  int exponent_ = 0;
};

}  // namespace forceshade::conformance

// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/recordings/recording.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "files/csv.h"
#include "forceshade/error.h"
#include "properties/conformance/recordings/path.h"
#include "text/number_text.h"

namespace forceshade::conformance {
namespace {

using boost::multiprecision::cpp_int;

constexpr std::size_t kMostCharacters = 64;
constexpr int kMostExponent = 400;  // beyond the range of binary64

bool is_short_decimal(const std::string& text) {
  if (text.size() > kMostCharacters || text.find_first_not_of("+-.0123456789eE") != std::string::npos) return false;
  const std::size_t e = text.find_first_of("eE");
  if (e == std::string::npos) return true;
  const auto exponent = number_in<int>(std::string_view(text).substr(e + (text[e + 1] == '+' ? 2 : 1)));
  return exponent && std::abs(*exponent) <= kMostExponent;
}

cpp_int ten_to(int power) {
  return boost::multiprecision::pow(cpp_int(10), static_cast<unsigned>(power));
}

// The nearest binary64 number to the field times its unit; or, where the nearest binary32 number to that would not be the one
// to the exact product, the next towards it. So a force is judged at the position that `force` reads.
double in_unit(const files::Reader& reader, std::size_t i, const files::Decimal& unit) {
  const double number = reader.binary64(i);
  if (!std::isfinite(number)) return number;
  std::string_view word = reader.text(i);
  if (word.starts_with('+')) word.remove_prefix(1);
  const files::Decimal exact = files::Decimal::of(word).value_or(number) * unit;  // a hexadecimal number is in binary64
  const auto nearest = exact.nearest<double>();
  const auto as_binary32 = exact.nearest<float>();
  if (static_cast<float>(nearest) == as_binary32 || !std::isfinite(as_binary32)) return nearest;
  return std::nextafter(nearest, static_cast<double>(as_binary32));
}

// The time in whole seconds and whole ns, as messages of ROS have it.
ExactTime time_of_two(const files::Reader& reader, std::size_t nanoseconds) {
  for (const std::size_t i : {std::size_t{0}, nanoseconds})
    if (const std::string& text = reader.text(i);
        text.empty() || text.size() > 18 || text.find_first_not_of("0123456789") != std::string::npos)
      throw reader.unexpected(i, "a whole number");
  const std::string& rest = reader.text(nanoseconds);
  if (rest.size() > 9) throw reader.unexpected(nanoseconds, "less than a second in ns");
  return {reader.text(0) + '.' + std::string(9 - rest.size(), '0') + rest, 0};
}

}  // namespace

std::string Measurements::place(std::size_t sample) const {
  return file + ':' + std::to_string(samples[sample].line);
}

Measurements read_measurements(std::istream& in, const std::string& file, const Columns& columns) {
  using Layout = files::Reader::Layout;
  std::vector<std::string> names(columns.names.begin(), columns.names.end());
  const std::size_t nanoseconds = names.size(), status = nanoseconds + (columns.nanoseconds.empty() ? 0 : 1);
  if (status > nanoseconds) names.push_back(columns.nanoseconds);
  files::Reader reader(in, file, std::move(names), {"status"}, columns.are_numbered() ? Layout::without_header : Layout::csv);
  Measurements measured{file, {}};
  ExactTime first, before;
  while (reader.next()) {
    if (reader.has(status) && reader.text(status) == "end") continue;
    const auto finite = [&](std::size_t i) {
      const double number = reader.binary64(i);
      if (!std::isfinite(number)) throw reader.unexpected(i, "a finite number");
      return number;
    };
    Measured next;
    const ExactTime time = status > nanoseconds ? time_of_two(reader, nanoseconds) : ExactTime(reader.text(0), finite(0));
    if (measured.samples.empty()) first = before = time;
    next.time = time.seconds_since(first, columns.power_of_seconds);
    next.interval = time.seconds_since(before, columns.power_of_seconds);
    before = time;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const auto place = static_cast<std::size_t>(1 + axis);
      finite(place);
      next.position[axis] = in_unit(reader, place, columns.millimetres);
      next.force[axis] = in_unit(reader, place + 3, columns.newtons);
    }
    next.line = reader.line();
    measured.samples.push_back(next);
  }
  if (measured.samples.size() < 2)
    throw Error(file + ": expected two samples at least, got " + std::to_string(measured.samples.size()));
  return measured;
}

Measurements placed(const Measurements& measured, const Placement& placement) {
  const RecordedPath path(measured.samples);
  Measurements there{measured.file, {}};
  for (const Measured& each : measured.samples) {
    if (!path.reaches(each, placement.lag)) continue;
    there.samples.push_back(each);
    there.samples.back().position = placement.turn * path.position(each, placement.lag) + placement.shift;
    there.samples.back().force = placement.turn * (each.force - placement.offset);
  }
  return there;
}

ExactTime::ExactTime(const std::string& text, double value) {
  const std::string decimal = is_short_decimal(text) ? text : shortest(value);
  const std::size_t e = std::min(decimal.find_first_of("eE"), decimal.size());
  if (e < decimal.size()) exponent_ = std::stoi(decimal.substr(e + 1));
  bool is_fraction = false;
  for (const char c : decimal.substr(0, e)) {
    if (c == '.') is_fraction = true;
    if (c < '0' || c > '9') continue;
    digits_ = 10 * digits_ + (c - '0');
    if (is_fraction) --exponent_;
  }
  if (decimal.starts_with('-')) digits_ = -digits_;
}

double ExactTime::seconds_since(const ExactTime& other, int power) const {
  const int common = std::min(exponent_, other.exponent_);
  const cpp_int difference = digits_ * ten_to(exponent_ - common) - other.digits_ * ten_to(other.exponent_ - common);
  // The conversion of decimal text is what the standard library rounds once.
  const std::string text = difference.str() + 'e' + std::to_string(common + power);
  double seconds = 0;
  if (std::from_chars(text.data(), text.data() + text.size(), seconds).ec == std::errc::result_out_of_range)
    seconds = common + power > 0 ? std::numeric_limits<double>::infinity() : 0;
  return seconds;
}

}  // namespace forceshade::conformance

// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/doors/lines.h"

#include <array>
#include <bit>
#include <charconv>
#include <cstdint>
#include <string>

namespace forceshade::conformance {
namespace {

constexpr std::string_view kPeriods = R"(,"periods":[)";
constexpr std::size_t kHexDigits = 24;  // of three binary32 numbers
constexpr unsigned kNoDigit = 16;

constexpr std::array<std::uint8_t, 256> values_of_digits() {
  std::array<std::uint8_t, 256> values{};
  values.fill(kNoDigit);
  for (unsigned value = 0; value < 16; ++value) {
    values[static_cast<unsigned char>("0123456789abcdef"[value])] = static_cast<std::uint8_t>(value);
    values[static_cast<unsigned char>("0123456789ABCDEF"[value])] = static_cast<std::uint8_t>(value);
  }
  return values;
}

// Two digits of each byte.
constexpr std::array<std::array<char, 2>, 256> digits_of_bytes() {
  std::array<std::array<char, 2>, 256> digits{};
  for (std::size_t byte = 0; byte < digits.size(); ++byte)
    digits[byte] = {"0123456789abcdef"[byte / 16], "0123456789abcdef"[byte % 16]};
  return digits;
}

constexpr auto kValues = values_of_digits();
constexpr auto kDigits = digits_of_bytes();

char* write(char* to, const Eigen::Vector3f& numbers) {
  for (const float number : numbers)
    for (int shift = 24; shift >= 0; shift -= 8)
      for (const char digit : kDigits[std::bit_cast<std::uint32_t>(number) >> shift & 255U]) *to++ = digit;
  return to;
}

// Takes the word from the front of the text, and the spaces before it.
bool take(std::string_view& text, std::string_view word) {
  text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
  if (!text.starts_with(word)) return false;
  text.remove_prefix(word.size());
  return true;
}

// Takes ,"periods":[1,3] from the front of the text, if it begins so.
bool take_periods(std::string_view& text, std::vector<std::uint32_t>& periods) {
  if (!take(text, kPeriods)) return true;
  do {
    std::uint32_t number = 0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
    if (read.ec != std::errc()) return false;
    periods.push_back(number);
    text.remove_prefix(static_cast<std::size_t>(read.ptr - text.data()));
  } while (take(text, ","));
  return take(text, "]");
}

}  // namespace

std::string line_of(std::string_view beginning, std::span<const Eigen::Vector3f> numbers,
                    std::span<const std::uint32_t> periods) {
  std::string line(beginning.size() + 1 + numbers.size() * (kHexDigits + 3) + (numbers.empty() ? 2 : 1), '[');
  char* to = std::copy(beginning.begin(), beginning.end(), line.data()) + 1;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (i > 0) *to++ = ',';
    *to++ = '"';
    to = write(to, numbers[i]);
    *to++ = '"';
  }
  *to++ = ']';
  *to = '}';
  if (!periods.empty()) line.pop_back();
  for (std::size_t i = 0; i < periods.size(); ++i)
    line.append(i == 0 ? kPeriods : ",").append(std::to_string(periods[i])).append(i + 1 == periods.size() ? "]}" : "");
  return line;
}

std::optional<std::vector<Eigen::Vector3f>> numbers_in(std::string_view line, std::string_view beginning,
                                                       std::vector<std::uint32_t>* periods) {
  std::vector<Eigen::Vector3f> all;
  all.reserve(line.size() / (kHexDigits + 3));
  if (!take(line, beginning) || !take(line, "[")) return std::nullopt;
  do {
    if (!take(line, "\"")) return std::nullopt;
    const auto numbers = numbers_of(line.substr(0, kHexDigits));
    if (!numbers) return std::nullopt;
    all.push_back(*numbers);
    line.remove_prefix(kHexDigits);
    if (!line.starts_with('"')) return std::nullopt;
    line.remove_prefix(1);
  } while (take(line, ","));
  return take(line, "]") && (periods == nullptr || take_periods(line, *periods)) && take(line, "}") &&
                 line.find_first_not_of(' ') == line.npos
             ? std::optional(std::move(all))
             : std::nullopt;
}

std::optional<Eigen::Vector3f> numbers_of(std::string_view text) {
  if (text.size() != kHexDigits) return std::nullopt;
  Eigen::Vector3f numbers;
  unsigned seen = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::uint32_t bits = 0;
    for (const char digit : text.substr(8 * axis, 8)) {
      const unsigned value = kValues[static_cast<unsigned char>(digit)];
      seen |= value;
      bits = bits << 4U | (value & 15U);
    }
    numbers[static_cast<Eigen::Index>(axis)] = std::bit_cast<float>(bits);
  }
  return seen >= kNoDigit ? std::nullopt : std::optional(numbers);
}

}  // namespace forceshade::conformance

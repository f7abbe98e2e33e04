// SPDX-License-Identifier: BSD-3-Clause
#include "study/experiments/json_text.h"

#include <cstdint>
#include <stdexcept>

#include "files/json_fault.h"
#include "files/printable.h"

namespace forceshade::experiments {
namespace {

constexpr int kDeepestJson = 16;           // levels of objects and lists
constexpr std::size_t kLongestJson = 200;  // bytes of the file in a message

[[noreturn]] void refuse_member(const std::string& key, const std::string& expected, const Json& got) {
  throw std::invalid_argument(key + ": expected " + expected + ", got " +
                              files::printable(std::string_view(got.dump()).substr(0, kLongestJson)));
}

}  // namespace

Json json_of(std::string_view text) {
  try {
    return Json::parse(text, [](int depth, Json::parse_event_t, const Json&) {
      if (depth > kDeepestJson)
        throw std::invalid_argument("expected at most " + std::to_string(kDeepestJson) +
                                    " levels of objects and lists, got more");
      return true;
    });
  } catch (const Json::parse_error& error) {
    throw std::invalid_argument(files::json_fault(text, error.byte));
  } catch (const Json::exception&) {
    throw std::invalid_argument("expected numbers that binary64 can hold, got a larger one");
  }
}

const Json& member(const Json& object, const std::string& key) {
  if (!object.is_object()) throw std::invalid_argument("expected an object with the key " + key);
  const auto found = object.find(key);
  if (found == object.end()) throw std::invalid_argument("the key " + key + " is missing");
  return *found;
}

int whole_member(const Json& object, const std::string& key, int least, int largest) {
  const Json& value = member(object, key);
  const std::string expected =
      least == largest ? std::to_string(least) : "a whole number, " + std::to_string(least) + " to " + std::to_string(largest);
  if (!value.is_number_integer()) refuse_member(key, expected, value);
  // A number above 2^63 - 1 is unsigned, and would be negative as what get() gives.
  if (value.is_number_unsigned() && value.get<std::uint64_t>() > INT64_MAX) refuse_member(key, expected, value);
  const auto number = value.get<std::int64_t>();
  if (number < least || number > largest) refuse_member(key, expected, value);
  return static_cast<int>(number);
}

std::string text_member(const Json& object, const std::string& key) {
  const Json& value = member(object, key);
  if (!value.is_string()) refuse_member(key, "a text in quotes", value);
  return value.get<std::string>();
}

}  // namespace forceshade::experiments

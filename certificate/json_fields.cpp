// SPDX-License-Identifier: BSD-3-Clause
#include "certificate/json_fields.h"

#include <array>
#include <cerrno>
#include <cmath>
#include <fstream>
#include <system_error>

#include "files/file_kind.h"
#include "files/json_fault.h"
#include "files/printable.h"

namespace forceshade::properties {
namespace {

// A value in a message: never long, and ASCII without control characters.
std::string shown(const nlohmann::json& value) {
  constexpr std::size_t kLongest = 60;
  if (value.is_object()) return "an object";
  if (value.is_array()) return "an array";
  const std::string text = value.dump(-1, ' ', true);
  return text.size() <= kLongest ? text : text.substr(0, kLongest) + "...";
}

}  // namespace

nlohmann::json json_from(std::string_view text) {
  if (text.size() > kLargestJson)
    throw Error(std::to_string(text.size()) + " bytes; expected at most " + std::to_string(kLargestJson));
  std::vector<std::set<std::string>> keys;
  const auto check = [&](int depth, nlohmann::json::parse_event_t event, nlohmann::json& value) {
    if (depth > kDeepestJson) throw Error("more than " + std::to_string(kDeepestJson) + " levels of objects and arrays");
    if (event == nlohmann::json::parse_event_t::object_start) keys.emplace_back();
    if (event == nlohmann::json::parse_event_t::object_end) keys.pop_back();
    if (event == nlohmann::json::parse_event_t::key && !keys.back().insert(value.get<std::string>()).second)
      throw Error("the key " + shown(value) + " stands twice in one object");
    return true;
  };
  // The parser would end at a zero byte, and leave what follows it unread.
  if (const std::size_t zero = text.find('\0'); zero != text.npos) throw Error(files::json_fault(text, zero + 1));
  try {
    return nlohmann::json::parse(text, check);
  } catch (const nlohmann::json::parse_error& error) {
    throw Error(files::json_fault(text, error.byte));
  } catch (const nlohmann::json::exception&) {
    throw Error("expected numbers that binary64 can hold, got a larger one");
  }
}

std::string text_of_json_file(const std::string& file, const std::string& expected) {
  const auto refuse = [](const std::string& why) { throw Error("cannot be read: " + why); };
  if (files::is_named_pipe(file)) refuse("it is a named pipe; expected " + expected);
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  std::string text;
  std::array<char, 1 << 12> block;
  while (text.size() <= kLargestJson && (stream.read(block.data(), block.size()), stream.gcount() > 0))
    text.append(block.data(), static_cast<std::size_t>(stream.gcount()));
  if (!stream.eof() && !stream) refuse(std::generic_category().message(errno));
  if (text.empty()) refuse(errno != 0 ? std::generic_category().message(errno) : "it is empty; expected " + expected);
  if (text.size() > kLargestJson) refuse("it is larger than " + std::to_string(kLargestJson) + " bytes");
  return text;
}

Fields::Fields(const nlohmann::json& object, std::string path) : json_(&object), path_(std::move(path)) {
  if (!object.is_object()) throw Error((path_.empty() ? "it" : path_) + " is " + shown(object) + "; expected an object");
}

void Fields::refuse(const std::string& key, const nlohmann::json& value, const std::string& expected) const {
  throw Error(place(key) + " is " + shown(value) + "; expected " + expected);
}

const nlohmann::json& Fields::any(const char* key) {
  const auto found = json_->find(key);
  if (found == json_->end()) throw Error(place(key) + " is missing");
  read_.insert(key);
  return *found;
}

std::vector<std::string> Fields::keys() const {
  std::vector<std::string> all;
  for (const auto& member : json_->items()) all.push_back(member.key());
  return all;
}

void Fields::expect(const char* key, bool is_right, const std::string& expected) const {
  if (!is_right) refuse(key, json_->at(key), expected);
}

std::uint64_t Fields::count(const char* key) {
  const nlohmann::json& value = any(key);
  expect(key, value.is_number_unsigned(), "a whole number from 0 to 2^64 - 1");
  return value.get<std::uint64_t>();
}

double Fields::number(const char* key) {
  const nlohmann::json& value = any(key);
  expect(key, value.is_number() && std::isfinite(value.get<double>()), "a finite number");
  return value.get<double>();
}

float Fields::binary32(const char* key) {
  const double value = number(key);
  const auto single = static_cast<float>(value);
  expect(key, static_cast<double>(single) == value, "a binary32 number");
  return single;
}

bool Fields::flag(const char* key) {
  const nlohmann::json& value = any(key);
  expect(key, value.is_boolean(), "true or false");
  return value.get<bool>();
}

std::string Fields::plain_text(const std::string& key, const nlohmann::json& value, bool may_have_lines) const {
  if (!value.is_string()) refuse(key, value, "text");
  auto text = value.get<std::string>();
  if (!files::is_printable(text, may_have_lines)) refuse(key, value, "text without control characters");
  return text;
}

std::string Fields::text(const char* key, bool may_have_lines) {
  return plain_text(key, any(key), may_have_lines);
}

std::vector<std::string> Fields::texts(const char* key) {
  const nlohmann::json& list = any(key);
  expect(key, list.is_array(), "an array of text");
  std::vector<std::string> all;
  for (const nlohmann::json& value : list)
    all.push_back(plain_text(key + ('[' + std::to_string(all.size()) + ']'), value, true));
  return all;
}

std::vector<std::uint64_t> Fields::whole_numbers(const char* key) {
  const nlohmann::json& list = any(key);
  const auto is_whole = [](const nlohmann::json& value) { return value.is_number_unsigned(); };
  expect(key, list.is_array() && std::all_of(list.begin(), list.end(), is_whole),
         "an array of whole numbers from 0 to 2^64 - 1");
  return list.get<std::vector<std::uint64_t>>();
}

std::map<std::string, std::uint64_t> Fields::counts(const char* key) {
  Fields names = object(key);
  std::map<std::string, std::uint64_t> all;
  for (const auto& member : names.json_->items()) all[member.key()] = names.count(member.key().c_str());
  return all;
}

Fields Fields::object(const char* key) {
  return {any(key), place(key)};
}

std::vector<Fields> Fields::objects(const char* key) {
  const nlohmann::json& list = any(key);
  expect(key, list.is_array(), "an array of objects");
  std::vector<Fields> all;
  for (const nlohmann::json& value : list) all.emplace_back(value, place(key) + '[' + std::to_string(all.size()) + ']');
  return all;
}

std::array<double, 2> Fields::interval(const char* key) {
  constexpr const char* kExpected = "an array of two finite numbers, the lower one first";
  const nlohmann::json& ends = any(key);
  expect(key, ends.is_array() && ends.size() == 2, kExpected);
  for (std::size_t i = 0; i < 2; ++i)
    if (!ends[i].is_number() || !std::isfinite(ends[i].get<double>()))
      refuse(key + ('[' + std::to_string(i) + ']'), ends[i], "a finite number");
  const std::array<double, 2> values{ends[0].get<double>(), ends[1].get<double>()};
  if (!(values[0] <= values[1])) throw Error(place(key) + " is " + ends.dump() + "; expected " + kExpected);
  return values;
}

void Fields::end() const {
  for (const auto& member : json_->items())
    if (!read_.contains(member.key())) throw Error(place(shown(member.key())) + " is no key of a certificate");
}

}  // namespace forceshade::properties

// SPDX-License-Identifier: BSD-3-Clause
#include "files/json_line.h"

#include <algorithm>
#include <set>
#include <utility>

#include "files/child_process.h"
#include "files/printable.h"
#include "text/joined.h"

namespace forceshade::files {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kLongestText = 1000;  // bytes
constexpr std::size_t kReason = 500;        // characters of one

// A line of 16 MiB could else become gigabytes.
constexpr std::size_t kMostValues = 1'000'000;
constexpr int kDeepest = 100;

// The value of the text, discarded if it is no JSON or too large; and a key that one of its objects has twice, of which a
// reader would have to guess one.
std::pair<Json, std::optional<std::string>> parsed(const std::string& text) {
  // The parser would end at a zero byte, and leave what follows it unread.
  if (text.find('\0') != std::string::npos) return {Json(Json::value_t::discarded), std::nullopt};
  struct TooMuch {};
  std::size_t values = 0;
  std::optional<std::string> twice;
  std::vector<std::set<std::string>> objects;
  const auto note = [&](int depth, Json::parse_event_t event, const Json& value) {
    if (depth > kDeepest || ++values > kMostValues) throw TooMuch();
    if (event == Json::parse_event_t::object_start) objects.emplace_back();
    if (event == Json::parse_event_t::object_end) objects.pop_back();
    if (event == Json::parse_event_t::key && !objects.back().insert(value.get<std::string>()).second)
      twice = value.get<std::string>();
    return true;
  };
  try {
    Json json = Json::parse(text, note, false);
    return {std::move(json), std::move(twice)};
  } catch (const TooMuch&) {
    return {Json(Json::value_t::discarded), std::nullopt};
  }
}

}  // namespace

Json object_in(const std::string& said, const char* whose) {
  auto [object, twice] = parsed(said);
  if (!object.is_object())
    throw ProcessFailed(std::string("the ") + whose + " wrote " + shown(said) + "; expected a JSON object in one line");
  if (twice) throw ProcessFailed(std::string("the ") + whose + " wrote a line that has the key " + shown(*twice) + " twice");
  if (const auto why = object.find("failure"); why != object.end() && why->is_string())
    throw ProcessFailed(std::string("the ") + whose + " failed: " + shown(why->get<std::string>(), kReason));
  return std::move(object);
}

std::string shown_json(const nlohmann::ordered_json& value) {
  if (value.is_string()) return shown(value.get_ref<const std::string&>());
  const std::string quoted = shown(value.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace));
  return quoted.substr(1, quoted.size() - 2);
}

std::string one_of(const std::vector<std::string>& words) {
  return '"' + joined(words, "\", \"", {}, "\" or \"") + '"';
}

const Json& KeyReader::value(const std::string& key, const std::string& expected) const {
  const auto found = object_.find(key);
  if (found == object_.end()) throw ProcessFailed(what_ + " has no key \"" + key + "\"; expected " + expected);
  return *found;
}

std::string KeyReader::text(const std::string& key) const {
  const Json& found = value(key, "a text");
  if (!found.is_string() || found.get_ref<const std::string&>().size() > kLongestText) refuse(key, found, "a text");
  return printable(found.get<std::string>());
}

std::size_t KeyReader::word(const std::string& key, const std::vector<std::string>& words) const {
  const std::string expected = one_of(words);
  const Json& is = value(key, expected);
  const auto found = std::ranges::find_if(words, [&](const std::string& word) { return is == word; });
  if (found == words.end()) refuse(key, is, expected);
  return static_cast<std::size_t>(found - words.begin());
}

double KeyReader::number(const std::string& key, double least, double most, const std::string& expected) const {
  const Json& is = value(key, expected);
  if (!is.is_number() || !(is.get<double>() >= least && is.get<double>() <= most)) refuse(key, is, expected);
  return is.get<double>();
}

std::optional<double> KeyReader::number_or_null(const std::string& key, double least, double most,
                                                const std::string& expected) const {
  if (value(key, expected).is_null()) return std::nullopt;
  return number(key, least, most, expected);
}

std::optional<std::string> KeyReader::refusal() const {
  const auto accepts = object_.find("accepts");
  if (accepts != object_.end() && !accepts->is_boolean()) refuse("accepts", *accepts, "true or false");
  if (accepts == object_.end() || *accepts == true) return std::nullopt;
  return text("reason");
}

void KeyReader::expect_no_key_but(const std::vector<std::string>& keys) const {
  for (const auto& member : object_.items())
    if (std::ranges::find(keys, member.key()) == keys.end())
      throw ProcessFailed(what_ + " has the key " + shown(member.key()) + "; expected " + one_of(keys));
}

void KeyReader::refuse(const std::string& key, const Json& value, const std::string& expected) const {
  throw ProcessFailed(what_ + " has " + key + ' ' + shown_json(value) + "; expected " + expected);
}

}  // namespace forceshade::files

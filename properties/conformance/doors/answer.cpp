// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/doors/answer.h"

#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "properties/conformance/doors/child_process.h"
#include "properties/conformance/hello_reader.h"

namespace forceshade::conformance {
namespace {

using Json = nlohmann::ordered_json;
constexpr std::size_t kReason = 500;  // characters of one

// A line of 16 MiB could else become gigabytes.
constexpr std::size_t kMostValues = 1'000'000;
constexpr int kDeepest = 100;

// What the text means, discarded where it is no JSON or too much of it; and a key that one of its objects has twice, of which a
// reader would have to guess one.
std::pair<Json, std::optional<std::string>> parsed(const std::string& text) {
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
    throw RendererFailed(std::string("the ") + whose + " wrote " + shown(said) + "; expected a JSON object in one line");
  if (twice) throw RendererFailed(std::string("the ") + whose + " wrote a line that has the key " + shown(*twice) + " twice");
  if (const auto why = object.find("failure"); why != object.end() && why->is_string())
    throw RendererFailed(std::string("the ") + whose + " failed: " + shown(why->get<std::string>(), kReason));
  return std::move(object);
}

const Json& list_in(const Json& answer, const char* key, std::size_t size, const char* asked, const char* whose) {
  const auto all = answer.find(key);
  if (all == answer.end() || !all->is_array())
    throw RendererFailed(std::string("the ") + whose + " answered without a list \"" + key + "\": " + shown_json(answer));
  if (all->size() != size)
    throw RendererFailed(std::string("the ") + whose + " answered " + std::to_string(size) + ' ' + asked + " with " +
                         std::to_string(all->size()) + " entries of \"" + key + '"');
  return *all;
}

}  // namespace forceshade::conformance

// SPDX-License-Identifier: BSD-3-Clause
#include "properties/conformance/hello_reader.h"

#include <algorithm>

#include "files/printable.h"
#include "properties/conformance/doors/child_process.h"

namespace forceshade::conformance {

namespace {

constexpr std::size_t kLongestText = 1000;  // bytes

}  // namespace

std::string shown_json(const nlohmann::ordered_json& value) {
  if (value.is_string()) return shown(value.get_ref<const std::string&>());
  const std::string quoted = shown(value.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace));
  return quoted.substr(1, quoted.size() - 2);
}

std::string one_of(const std::vector<std::string>& words) {
  std::string list;
  for (std::size_t i = 0; i < words.size(); ++i)
    list += (i == 0 ? "\"" : i + 1 < words.size() ? ", \"" : " or \"") + words[i] + '"';
  return list;
}

const HelloReader::Json& HelloReader::value(const std::string& key, const std::string& expected) const {
  const auto found = hello_.find(key);
  if (found == hello_.end())
    throw RendererFailed(std::string("the ") + whose_ + "'s hello has no key \"" + key + "\"; expected " + expected);
  return *found;
}

std::string HelloReader::text(const std::string& key) const {
  const Json& found = value(key, "a text");
  if (!found.is_string() || found.get_ref<const std::string&>().size() > kLongestText) refuse(key, found, "a text");
  return files::printable(found.get<std::string>());
}

std::size_t HelloReader::word(const std::string& key, const std::vector<std::string>& words) const {
  const std::string expected = one_of(words);
  const Json& is = value(key, expected);
  const auto found = std::ranges::find_if(words, [&](const std::string& word) { return is == word; });
  if (found == words.end()) refuse(key, is, expected);
  return static_cast<std::size_t>(found - words.begin());
}

double HelloReader::number(const std::string& key, double least, double most, const std::string& expected) const {
  const Json& is = value(key, expected);
  if (!is.is_number() || !(is.get<double>() >= least && is.get<double>() <= most)) refuse(key, is, expected);
  return is.get<double>();
}

std::optional<double> HelloReader::number_or_null(const std::string& key, double least, double most,
                                                  const std::string& expected) const {
  if (value(key, expected).is_null()) return std::nullopt;
  return number(key, least, most, expected);
}

std::optional<std::string> HelloReader::refusal() const {
  const auto accepts = hello_.find("accepts");
  if (accepts != hello_.end() && !accepts->is_boolean()) refuse("accepts", *accepts, "true or false");
  if (accepts == hello_.end() || *accepts == true) return std::nullopt;
  return text("reason");
}

void HelloReader::refuse(const std::string& key, const Json& value, const std::string& expected) const {
  throw RendererFailed(std::string("the ") + whose_ + "'s hello has " + key + ' ' + shown_json(value) + "; expected " +
                       expected);
}

}  // namespace forceshade::conformance

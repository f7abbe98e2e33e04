// SPDX-License-Identifier: BSD-3-Clause
#include "apps/subject_file.h"

#include <string_view>

#include "apps/tell.h"
#include "subjects/file.h"

namespace forceshade::apps {
namespace {

constexpr std::string_view kOption = "--subject";

void append(const std::string& file, bool damps, ExpandedLine& line) {
  bool is_left_out = false;
  for (const auto& [key, value, place] : subjects::options_of_file(file)) {
    const std::string option = "--" + key;
    if (!damps && (key == subjects::kDamping || key == subjects::kDrag || key == subjects::kDampingFilter)) {
      is_left_out = true;
      continue;
    }
    line.places.emplace(option, place);
    line.words.push_back(option + '=' + value);
  }
  if (is_left_out) tell(file + kDampingLeftOut);
}

}  // namespace

std::string ExpandedLine::placed(const std::string& message) const {
  const std::string option = message.substr(0, message.find_first_of(": ,"));
  const auto found = places.find(option);
  return found == places.end() ? message : found->second + message.substr(option.size());
}

ExpandedLine expand_subject_files(const std::vector<std::string>& words, bool damps) {
  ExpandedLine line;
  bool is_expanded = false;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const bool has_value = words[i].starts_with(std::string(kOption) + '=');
    if (words[i] != kOption && !has_value) {
      line.words.push_back(words[i]);
      continue;
    }
    if (is_expanded) throw Error("--subject: expected once, got several times");
    is_expanded = true;
    const std::string file = has_value ? words[i].substr(kOption.size() + 1) : i + 1 < words.size() ? words[++i] : "";
    if (file.empty() || (!has_value && file.starts_with("-"))) throw Error("--subject: expected a file after it, got none");
    append(file, damps, line);
  }
  return line;
}

}  // namespace forceshade::apps

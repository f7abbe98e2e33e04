// SPDX-License-Identifier: BSD-3-Clause
#include "subjects/damping.h"

#include <algorithm>
#include <array>
#include <limits>
#include <variant>

#include "files/quantity.h"
#include "files/suggestion.h"
#include "forceshade/fast.h"
#include "subjects/tables.h"
#include "subjects/words.h"

namespace forceshade::subjects {
namespace {

using damping::Described;

// A key of the table, and its place in the option that it is a part of.
struct Member {
  const char* key;
  std::string_view option;
  void (*read)(Described& its, const std::string& name, const std::string& text);
};

constexpr std::array kMembers{
    Member{"damping", kDamping,
           [](Described& its, const std::string& name, const std::string& text) {
             its.parameters.damping = files::parse_damping(name, text);
           }},
    Member{"most", kDamping,
           [](Described& its, const std::string& name, const std::string& text) {
             its.parameters.most = text == "inf" ? std::numeric_limits<float>::infinity() : files::parse_binary32(name, text);
           }},
    Member{"drag", kDrag,
           [](Described& its, const std::string& name, const std::string& text) {
             its.parameters.drag = files::parse_damping(name, text);
           }},
    Member{"full_at", kDrag,
           [](Described& its, const std::string& name, const std::string& text) {
             its.parameters.full_at = files::parse_force(name, text);
           }},
    Member{"share", kDampingFilter,
           [](Described& its, const std::string& name, const std::string& text) {
             its.parameters.share = files::parse_binary32(name, text);
           }},
    Member{"time", kDampingFilter, [](Described& its, const std::string& name, const std::string& text) {
             its.time = files::parse_time(name, text);
             if (!(its.time > 0)) throw Error(name + ": expected a time above 0, got \"" + text + '"');
           }}};

// Options of two numbers, the second of which only a file has.
constexpr std::array kPairs{std::array{"damping", "most"}, std::array{"drag", "full_at"}};

// Throws Error for what is no such number, or is out of its range.
void read_member(const Member& member, Described& its, const std::string& name, const std::string& text) {
  member.read(its, name, text);
  damping::Parameters parameters = its.parameters;
  parameters.rate = 1;
  const auto built = fast::Damping::build(parameters);
  if (const auto* error = std::get_if<ParameterError>(&built))
    throw Error(error->arithmetic_fault != nullptr ? error->message()
                                                   : name + error->message().substr(std::string_view(error->parameter).size()));
}

const Member& member_of(std::string_view key) {
  return *std::ranges::find(kMembers, key, &Member::key);
}

}  // namespace

damping::Described read_damping(const Options& options) {
  Described its;
  const auto read = [&](std::string_view key, const std::string& text) {
    const Member& member = member_of(key);
    read_member(member, its, options.name(member.option), text);
  };
  for (const auto& [first, second] : kPairs) {
    if (!options.has(first)) continue;
    const std::vector<std::string> parts = files::at_commas(options.value(first));
    if (parts.size() > 2)
      throw Error(options.name(first) + ": expected one number or two, got \"" + options.value(first) + '"');
    read(first, parts[0]);
    if (parts.size() == 2) read(second, parts[1]);
  }
  if (!options.has(kDampingFilter)) return its;
  if (!options.has(kDamping) && !options.has(kDrag))
    throw Error(options.name(kDampingFilter) + ": expected --damping or --drag beside it, got it alone");
  const std::string filter = options.value(kDampingFilter);
  read(filter.ends_with('s') ? "time" : "share", filter);
  return its;
}

std::vector<Option> options_of_damping(const toml::node& node, const files::TomlDocument& document,
                                       const std::filesystem::path& file) {
  const auto name_of = [&](const toml::node& at, std::string_view key) {
    return file.string() + ": line " + std::to_string(at.source().begin.line) + ": " + std::string(key);
  };
  if (!node.is_table())
    throw Error(name_of(node, kDamping) + ": expected the table [damping], got " + files::words_of_value(node));
  std::vector<std::string> keys;
  for (const Member& member : kMembers) keys.emplace_back(member.key);
  for (const auto& [key, its] : *node.as_table())
    if (std::ranges::find(keys, key.str()) == keys.end())
      throw Error(name_of(its, "unknown key ") + std::string(key.str()) + "; expected keys of [damping]" +
                  files::suggestion(key.str(), keys));
  // Empty where the table has no such key.
  const auto given = [&](const char* key) -> Option {
    const toml::node* its = node.as_table()->get(key);
    if (its == nullptr) return {};
    const Member& member = member_of(key);
    Option option{std::string(member.option), document.words_of_scalars(*its), name_of(*its, key)};
    if (option.value.empty())
      throw Error(option.name + ": expected a number or a text in quotes, got " + files::words_of_value(*its));
    Described alone;
    read_member(member, alone, option.name, option.value);
    return option;
  };
  std::vector<Option> options;
  for (const auto& [first, second] : kPairs) {
    Option option = given(first);
    const Option further = given(second);
    if (option.value.empty() && !further.value.empty())
      throw Error(further.name + ": expected " + first + " beside it, got it alone");
    if (!further.value.empty()) option.value += ',' + further.value;
    if (!option.value.empty()) options.push_back(std::move(option));
  }
  if (options.empty()) throw Error(name_of(node, kDamping) + ": expected the key damping or drag in its table, got none");
  Option share = given("share"), time = given("time");
  if (!share.value.empty() && !time.value.empty()) throw Error(time.name + ": expected without share, got both");
  for (Option* filter : {&share, &time})
    if (!filter->value.empty()) options.push_back(std::move(*filter));
  return options;
}

}  // namespace forceshade::subjects

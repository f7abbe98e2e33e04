// SPDX-License-Identifier: BSD-3-Clause
#include "study/window/keys.h"

#include <algorithm>
#include <utility>

#include "files/printable.h"

namespace forceshade::window {
namespace {

bool is_small_letter(char c) {
  return 'a' <= c && c <= 'z';
}

std::string small(std::string_view name) {
  std::string all(name);
  if (all.size() == 1 && 'A' <= all[0] && all[0] <= 'Z') all[0] = static_cast<char>(all[0] + ('a' - 'A'));
  return all;
}

bool is_one_of(const std::vector<std::string>& keys, std::string_view name) {
  return std::ranges::any_of(keys, [&](const std::string& key) { return small(key) == small(name); });
}

// Text that no terminal may show becomes no answer either.
bool is_character(std::string_view name) {
  return files::character_size(name) == name.size() && files::is_printable(name);
}

std::optional<Press> change(const Keys& keys, std::string_view name) {
  if (is_one_of(keys.smaller, name)) return Press{Action::smaller, {}};
  if (is_one_of(keys.bigger, name)) return Press{Action::bigger, {}};
  if (is_one_of(keys.done, name)) return Press{Action::done, {}};
  return std::nullopt;
}

std::optional<Press> digit(const Keys& keys, std::string_view name) {
  for (std::size_t i = 0; i < keys.digits.size(); ++i)
    if (small(keys.digits[i]) == small(name)) return Press{Action::type, std::string(1, static_cast<char>('0' + i))};
  return std::nullopt;
}

}  // namespace

std::optional<Press> press_of(const Keys& keys, ScreenKind kind, const Key& key) {
  const bool is_typing = kind == ScreenKind::satisfaction || kind == ScreenKind::classification || kind == ScreenKind::question;
  if (key.name.empty() || (key.is_repeat && !is_typing)) return std::nullopt;
  if (kind == ScreenKind::matching) return change(keys, key.name);
  if (is_one_of(keys.enter, key.name)) return key.is_repeat ? std::nullopt : std::optional(Press{Action::enter, {}});
  if (!is_typing) return std::nullopt;
  if (is_one_of(keys.erase, key.name)) return Press{Action::erase, {}};
  if (kind != ScreenKind::question) return key.is_repeat ? std::nullopt : digit(keys, key.name);
  return is_character(key.name) ? std::optional(Press{Action::type, key.name}) : std::nullopt;
}

std::vector<Press> presses_of(const Keys& keys, ScreenKind kind, std::span<const Key> typed) {
  std::vector<Press> presses;
  for (const Key& key : typed) {
    auto press = press_of(keys, kind, key);
    if (!press) continue;
    presses.push_back(std::move(*press));
    if (presses.back().action == Action::enter || presses.back().action == Action::done) break;
  }
  return presses;
}

std::string cap(std::string_view name) {
  if (name == " ") return "Space";
  if (name == "return") return "Enter";
  std::string all(name);
  if (!all.empty() && is_small_letter(all[0])) all[0] = static_cast<char>(all[0] - ('a' - 'A'));
  if (all.size() > 1) std::ranges::replace(all, '-', ' ');
  return all;
}

}  // namespace forceshade::window

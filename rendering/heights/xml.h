// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Looks for values in the XML that other programs put beside a picture.

#include <algorithm>
#include <string_view>

namespace forceshade::heights {

// True if the attribute, or the element without attributes, has a value for which is(value) is true, however it is quoted and
// spaced.
template <class Is>
bool has_value(std::string_view xml, std::string_view name, const Is& is) {
  constexpr std::string_view kBlank = " \t\r\n", kQuotes = "\"'";
  for (std::size_t at = xml.find(name); at < xml.size(); at = xml.find(name, at + 1)) {
    if (at > 0 && xml[at - 1] == '/') continue;  // the end of an element
    std::string_view rest = xml.substr(at + name.size());
    const auto skip_blanks = [&rest] { rest.remove_prefix(std::min(rest.find_first_not_of(kBlank), rest.size())); };
    skip_blanks();
    if (!rest.starts_with('=') && !rest.starts_with('>')) continue;
    rest.remove_prefix(1);
    skip_blanks();
    if (!rest.empty() && kQuotes.find(rest.front()) != kQuotes.npos) rest.remove_prefix(1);
    std::string_view value = rest.substr(0, rest.find_first_of("\"'<"));
    value = value.substr(0, value.find_last_not_of(kBlank) + 1);
    if (is(value)) return true;
  }
  return false;
}

// True if Adobe's XMP turns or mirrors the picture.
inline bool is_turned_by_xmp(std::string_view xml) {
  return has_value(xml, "tiff:Orientation", [](std::string_view value) { return value != "1"; });
}

}  // namespace forceshade::heights

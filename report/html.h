// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Text and numbers as they are written into a page, whatever the locale.

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "text/number_text.h"

namespace forceshade::properties {

// Safe in an element and in a quoted attribute.
inline std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&': result += "&amp;"; break;
      case '<': result += "&lt;"; break;
      case '>': result += "&gt;"; break;
      case '"': result += "&quot;"; break;
      case '\'': result += "&#39;"; break;
      default: result += c;
    }
  }
  return result;
}

// On a phone a row becomes a card, and every cell needs its own label.
inline std::string cell(const char* label, const std::string& content, const char* kind = "") {
  return std::string("<td data-label=\"") + label + '"' + (*kind != 0 ? std::string(" class=\"") + kind + '"' : "") + '>' +
         content + "</td>";
}

// "2 000 000", with spaces that do not break a line.
inline std::string grouped(std::uint64_t count) {
  const std::string plain = std::to_string(count);
  std::string result;
  for (std::size_t i = 0; i < plain.size(); ++i) {
    if (i > 0 && (plain.size() - i) % 3 == 0) result += "\u202F";
    result += plain[i];
  }
  return result;
}

// "1 case", "2 000 cases".
inline std::string plural(std::uint64_t count, const std::string& word) {
  return grouped(count) + ' ' + word + (count == 1 ? "" : "s");
}

// A number of what should not be there: coloured unless it is 0.
inline std::string faulty(std::uint64_t count) {
  return count == 0 ? "0" : "<span class=\"no\">" + grouped(count) + "</span>";
}

inline std::string held_or_failed(bool held) {
  return held ? "<span class=\"yes\">held</span>" : "<span class=\"no\">failed</span>";
}

// A section with a table of names and values; both are HTML.
inline std::string facts(const std::string& heading, const std::vector<std::pair<std::string, std::string>>& rows) {
  std::string html = "<section>\n<h2>" + heading + "</h2>\n<table class=\"facts\">\n";
  for (const auto& [name, value] : rows) html += "<tr><th scope=\"row\">" + name + "</th><td>" + value + "</td></tr>\n";
  return html + "</table>\n</section>\n";
}

// The same as digits(), with a power of ten that reads as one: "3.1 × 10<sup>−9</sup>".
inline std::string html_number(double value, int count) {
  std::string text = digits(value, count);
  const std::size_t e = text.find('e');
  if (e == std::string::npos) return text;
  std::string_view power = std::string_view(text).substr(e + 1);
  const bool is_negative = power.starts_with('-');
  while (power.size() > 1 && (power[0] == '-' || power[0] == '+' || power[0] == '0')) power.remove_prefix(1);
  return text.substr(0, e) + "\u202F×\u202F10<sup>" + (is_negative ? "−" : "") + std::string(power) + "</sup>";
}

}  // namespace forceshade::properties

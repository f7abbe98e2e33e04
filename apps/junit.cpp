// SPDX-License-Identifier: BSD-3-Clause
#include "apps/junit.h"

#include <algorithm>
#include <span>

#include "files/printable.h"
#include "text/formatted.h"

namespace forceshade::apps {
namespace {

// One line of a text, as an attribute or an element has it.
std::string xml_line(std::string_view text) {
  std::string all;
  const std::string shown = files::printable(text);
  for (std::size_t i = 0; i < shown.size(); ++i) {
    // The two characters of UTF-8 that XML 1.0 leaves out and printable() does not.
    if (const std::string_view three = std::string_view(shown).substr(i, 3);
        three == "\xEF\xBF\xBE" || three == "\xEF\xBF\xBF") {
      all += three.back() == '\xBE' ? "\\xef\\xbf\\xbe" : "\\xef\\xbf\\xbf";
      i += 2;
      continue;
    }
    switch (shown[i]) {
      case '&': all += "&amp;"; break;
      case '<': all += "&lt;"; break;
      case '>': all += "&gt;"; break;
      case '"': all += "&quot;"; break;
      case '\'': all += "&apos;"; break;
      default: all += shown[i];
    }
  }
  return all;
}

std::string_view first_line(std::string_view text) {
  return text.substr(0, text.find('\n'));
}

// A text as an element has it, with its lines.
std::string xml(std::string_view text) {
  std::string all = xml_line(first_line(text));
  while (first_line(text).size() < text.size()) {
    text.remove_prefix(first_line(text).size() + 1);
    all += '\n' + xml_line(first_line(text));
  }
  return all;
}

std::string attribute(const char* name, std::string_view value) {
  return std::string(" ") + name + "=\"" + xml_line(value) + '"';
}

std::string counts(std::span<const JunitCase> cases) {
  const auto failed = std::ranges::count_if(cases, [](const JunitCase& each) { return each.failure.has_value(); });
  double time = 0;
  for (const JunitCase& each : cases) time += each.seconds;
  return attribute("tests", std::to_string(cases.size())) + attribute("failures", std::to_string(failed)) +
         attribute("errors", "0") + attribute("time", formatted("%.3f", time));
}

std::string testcase(const JunitCase& each, const std::string& name) {
  std::string text = "    <testcase" + attribute("classname", name + '.' + each.subject) + attribute("name", each.name) +
                     attribute("time", formatted("%.3f", each.seconds)) + ">\n";
  if (each.failure)
    text += "      <failure" + attribute("type", "counterexample") + attribute("message", first_line(*each.failure)) + '>' +
            xml(*each.failure) + "</failure>\n";
  if (!each.output.empty()) text += "      <system-out>" + xml(each.output) + "</system-out>\n";
  return text + "    </testcase>\n";
}

}  // namespace

std::string to_junit(const std::string& name, const std::vector<std::pair<std::string, std::string>>& about,
                     const std::vector<JunitCase>& cases) {
  std::string text =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites" + attribute("name", name) + counts(cases) + ">\n";
  for (auto first = cases.begin(); first != cases.end();) {
    const auto last = std::find_if(first, cases.end(), [&](const JunitCase& each) { return each.subject != first->subject; });
    text += "  <testsuite" + attribute("name", first->subject) + counts({first, last}) + attribute("skipped", "0") + ">\n";
    if (!about.empty()) text += "    <properties>\n";
    for (const auto& [key, value] : about)
      text += "      <property" + attribute("name", key) + attribute("value", value) + "/>\n";
    if (!about.empty()) text += "    </properties>\n";
    for (; first != last; ++first) text += testcase(*first, name);
    text += "  </testsuite>\n";
  }
  return text + "</testsuites>\n";
}

}  // namespace forceshade::apps

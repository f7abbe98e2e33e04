// SPDX-License-Identifier: BSD-3-Clause
#include "apps/troubleshooting.h"

#include <algorithm>
#include <ranges>
#include <string_view>

namespace forceshade::apps {
namespace {

// "..." stands for any words of the same line.
struct Message {
  std::string_view section, words;
};

// As the page has them, in its order; a test compares them.
constexpr Message kMessages[]{
    {"first-commands", "expected --law, --height-map, --mesh or --scene, got none"},
    {"first-commands", "expected a stiffness such as ..."},
    {"first-commands", "expected a length such as ..."},
    {"first-commands", "--stiffness is ...; expected ..."},
    {"first-commands", "--width is ...; expected ..."},
    {"first-commands", "no column ...: expected columns ..."},
    {"first-commands", "column ...: expected a number"},
    {"shapes", "faces ... run along their edge, ..., in the same direction"},
    {"shapes", "meet, but have no vertex in common"},
    {"shapes", "face ... would lose its area"},
    {"shapes", "has no texture coordinates at some or all corners"},
    {"shapes", "line ...: shape: expected one of ..."},
    {"shapes", "line ...: key ... is missing"},
    {"shapes", "line ...: unknown key ..."},
    {"shapes", "expected a TOML file, got a PNG picture"},
    {"shapes", "is not 8 or 16 bit greyscale"},
    {"certificates", "refused to drive: no certificate was given"},
    {"certificates", "held, not certified"},
    {"certificates", "the certificate has ... points ...; driving needs at least ..."},
    {"certificates", "the certificate does not cover ..."},
    {"certificates", "the certificate covers ... with other parameters"},
    {"certificates", "the certificate is of a program's own renderer"},
    {"certificates", "the certificate does not say whose renderer was compared"},
    {"certificates", "the certificate says that ... failed"},
    {"certificates", "the certificate is for another build of the renderer"},
    {"certificates", "expected a forceshade certificate"},
    {"devices", "no window can be opened"},
    {"devices", "the PHANToM's driver library ... could not be loaded"},
    {"devices", "Force Dimension's library (DHD) could not be loaded"},
    {"devices", "no Inverse Service answers at ..."},
    {"devices", "no device of Force Dimension is connected"},
    {"devices", "check cable, power and the udev rule"},
    {"devices", "device fault: the program ended ..."},
    {"devices", "device fault: the program did not answer within ..."},
    {"devices", "expected none, because the device has no buttons"},
    {"devices", "cannot be passive, so a hand may be made to swing"},
    {"devices", "the supervisor stopped the run: watchdog: tick ... began ... after it was due"},
    {"devices", "the supervisor stopped the run: ..."},
    {"renderers-and-recordings", "the renderer's hello has no key ..."},
    {"renderers-and-recordings", "the renderer ended ... without an answer"},
    {"renderers-and-recordings", "the renderer did not answer within ..."},
    {"renderers-and-recordings", "database disk image is malformed"},
};

bool holds(std::string_view line, std::string_view message) {
  for (const auto part : message | std::views::split(std::string_view("..."))) {
    const std::string_view words(part.begin(), part.end());
    const std::size_t at = line.find(words);
    if (at == std::string_view::npos) return false;
    line.remove_prefix(at + words.size());
  }
  return true;
}

}  // namespace

std::string with_page(std::string words) {
  for (const auto part : words | std::views::split('\n')) {
    const std::string_view line(part.begin(), part.end());
    const auto* const its = std::ranges::find_if(kMessages, [&](const Message& each) { return holds(line, each.words); });
    if (its == std::end(kMessages)) continue;
    return words.insert(words.size() - (words.ends_with('\n') ? 1 : 0),
                        " (docs/troubleshooting.md#" + std::string(its->section) + ')');
  }
  return words;
}

}  // namespace forceshade::apps

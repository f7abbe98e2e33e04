// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The messages that docs/troubleshooting.md explains, each in a section of that page.

#include <string>

namespace forceshade::apps {

// The words, which may be several lines; where one of them is such a message, with "(docs/troubleshooting.md#SECTION)" at their
// end.
std::string with_page(std::string words);

}  // namespace forceshade::apps

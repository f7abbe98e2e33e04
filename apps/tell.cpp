// SPDX-License-Identifier: BSD-3-Clause
#include "apps/tell.h"

#include <cstdio>

#include "apps/troubleshooting.h"
#include "files/printable.h"

namespace forceshade::apps {

std::string& program_name() {
  static std::string name = "forceshade";
  return name;
}

void tell(const std::string& words) {
  std::fprintf(stderr, "%s: %s\n", program_name().c_str(), files::printable(with_page(words)).c_str());
}

}  // namespace forceshade::apps

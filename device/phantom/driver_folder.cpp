// SPDX-License-Identifier: BSD-3-Clause
#include "device/phantom/driver_folder.h"

#include <algorithm>
#include <cstdlib>
#include <system_error>

namespace forceshade::device {
namespace {

namespace fs = std::filesystem;

// The folder in the vendor's guide, with its name in GTDD_HOME.
constexpr const char* kGuides = "/usr/share/3DSystems";

fs::path folder() {
  const auto value = [](const char* variable) -> std::string {
    const char* set = std::getenv(variable);
    return set ? set : "";
  };
  if (const std::string home = value("GTDD_HOME"); !home.empty()) return fs::path(home) / "config";
  if (const std::string home = value("HOME"); !home.empty()) return fs::path(home) / ".3dsystems" / "config";
  return {};
}

}  // namespace

DriverFolder driver_folder() {
  DriverFolder found{.path = folder(), .problem = "", .names = {}};
  if (found.path.empty()) {
    found.problem = "neither GTDD_HOME nor HOME is set, so the driver has no configuration folder";
    return found;
  }
  std::error_code error;
  for (fs::directory_iterator entry(found.path, error), end; !error && entry != end; entry.increment(error)) {
    std::error_code gone;
    if (!entry->is_regular_file(gone)) continue;
    const fs::path name = entry->path().filename();
    found.names.push_back(name.extension() == ".config" ? name.stem() : name);
  }
  if (error) {
    found.problem = found.path.string() + ": " + error.message();
    const fs::path guides = fs::path(kGuides) / "config";
    std::error_code none;
    if (guides != found.path && fs::is_directory(guides, none))
      found.problem += "; " + guides.string() + " is there: set GTDD_HOME to " + kGuides;
  }
  std::sort(found.names.begin(), found.names.end());
  return found;
}

}  // namespace forceshade::device

// SPDX-License-Identifier: BSD-3-Clause
#include "device/phantom/driver_folder.h"

#include <fcntl.h>
#include <grp.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
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

namespace fs = std::filesystem;

bool is_one_of(const std::string& name, const std::string& kind) {
  return name.size() > kind.size() && name.starts_with(kind) &&
         std::all_of(name.begin() + static_cast<std::ptrdiff_t>(kind.size()), name.end(),
                     [](char c) { return c >= '0' && c <= '9'; });
}

std::string group_of(const fs::path& file) {
  struct stat about {};
  if (::stat(file.c_str(), &about) != 0) return "";
  const group* named = ::getgrgid(about.st_gid);
  return named ? named->gr_name : std::to_string(about.st_gid);
}

std::string first_word(const fs::path& file) {
  std::string word;
  std::ifstream(file) >> word;
  return word;
}

// A Touch calls itself 2988:0302, an older one 0301:2988, both as seen in users' reports.
bool is_the_vendors(const fs::path& in_sys) {
  std::error_code none;
  fs::path at = fs::canonical(in_sys, none);
  for (int up = 0; !none && up < 8 && at.has_relative_path(); ++up, at = at.parent_path())
    if (fs::exists(at / "idVendor", none))
      return first_word(at / "idVendor") == "2988" ||
             (first_word(at / "idVendor") == "0301" && first_word(at / "idProduct") == "2988");
  return false;
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

std::vector<DeviceNode> device_nodes(const fs::path& root) {
  std::vector<DeviceNode> nodes;
  std::error_code error;
  for (fs::directory_iterator entry(root / "dev", error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename();
    const bool serial = is_one_of(name, "ttyACM"), hid = is_one_of(name, "hidraw");
    if (!serial && !hid && !is_one_of(name, "fw")) continue;
    const bool accessible = ::faccessat(AT_FDCWD, entry->path().c_str(), R_OK | W_OK, AT_EACCESS) == 0;
    const bool vendors = (serial && is_the_vendors(root / "sys/class/tty" / name / "device")) ||
                         (hid && is_the_vendors(root / "sys/class/hidraw" / name / "device"));
    nodes.push_back({"/dev/" + name, accessible, group_of(entry->path()), vendors});
  }
  std::sort(nodes.begin(), nodes.end(), [](const DeviceNode& a, const DeviceNode& b) { return a.path < b.path; });
  return nodes;
}

}  // namespace forceshade::device

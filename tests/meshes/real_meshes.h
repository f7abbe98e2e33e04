// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Meshes that others have made: those of Debian's package libcgal-demo, where it is installed. None of them is in this project.

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/temporary_directory.h"

namespace forceshade::tests {

// Unpacks the package's meshes into a folder that lives as long as the object.
class RealMeshes {
 public:
  // Files of at most 32 kB, or all of them where FORCESHADE_REAL_MESHES is "all"; sorted by their names. None where the package
  // is not installed.
  RealMeshes() {
    const std::string archive = "/usr/share/doc/libcgal-dev/data.tar.gz";
    if (!std::filesystem::exists(archive)) return;
    if (std::system(("tar -xzf " + archive + " -C '" + directory_.path() + "' data/meshes").c_str()) != 0) return;
    const char* wanted = std::getenv("FORCESHADE_REAL_MESHES");
    const bool all = wanted != nullptr && wanted == std::string("all");
    for (const auto& entry : std::filesystem::directory_iterator(directory_.file("data/meshes"))) {
      const std::string ending = entry.path().extension();
      if (ending != ".off" && ending != ".obj" && ending != ".ply" && ending != ".stl") continue;
      if (all || entry.file_size() <= 32768) files_.push_back(entry.path());
    }
    std::sort(files_.begin(), files_.end());
  }

  const std::vector<std::string>& files() const { return files_; }

 private:
  TemporaryDirectory directory_;
  std::vector<std::string> files_;
};

}  // namespace forceshade::tests

// SPDX-License-Identifier: BSD-3-Clause
#include "rendering/meshes/load.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <string>

#include "files/file_kind.h"
#include "forceshade/meshes.h"
#include "rendering/meshes/readers.h"

namespace forceshade::mesh {
namespace {

struct Format {
  std::string_view ending;
  LoadedMesh (*read)(const std::filesystem::path& file, const FileUnits& units);
};
constexpr std::array kFormats{Format{".obj", &read_obj}, Format{".off", &read_off}, Format{".ply", &read_ply},
                              Format{".stl", &read_stl}};

void expect_no_pointer(const std::filesystem::path& file) {
  std::string beginning(files::kLfsBeginning.size(), '\0');
  std::ifstream(file, std::ios::binary).read(beginning.data(), static_cast<std::streamsize>(beginning.size()));
  if (beginning == files::kLfsBeginning) throw Error(file, "is " + std::string(files::kLfsPointer));
}

}  // namespace

LoadedMesh load_in_units(const std::filesystem::path& file, const FileUnits& units) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const Format& format : kFormats)
    if (format.ending == ending) {
      if (std::filesystem::is_regular_file(file)) expect_no_pointer(file);
      return format.read(file, units);
    }
  throw Error(file, "has a name of no known format; expected a name that ends in .obj, .off, .ply or .stl");
}

LoadedMesh load_with_corners(const std::filesystem::path& file, Unit unit) {
  return load_in_units(file, {.length = unit});
}

TriangleMesh load(const std::filesystem::path& file, Unit unit) {
  return load_with_corners(file, unit).mesh;
}

}  // namespace forceshade::mesh

// SPDX-License-Identifier: BSD-3-Clause
#include "rendering/meshes/load.h"

#include <fstream>
#include <string>

#include "files/file_kind.h"
#include "forceshade/meshes.h"
#include "rendering/meshes/readers.h"
#include "text/letters.h"

namespace forceshade::mesh {
namespace {

struct Format {
  std::string_view ending;
  LoadedMesh (*read)(const std::filesystem::path& file, const FileUnits& units);
};
constexpr std::array kFormats{Format{".obj", &read_obj}, Format{".off", &read_off}, Format{".ply", &read_ply},
                              Format{".stl", &read_stl}};

std::string beginning_of(const std::filesystem::path& file) {
  std::string beginning(1024, '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(beginning.data(), static_cast<std::streamsize>(beginning.size()));
  beginning.resize(static_cast<std::size_t>(in.gcount()));
  return beginning;
}

// The kind of the file, where that is plainly no mesh; else nothing.
std::string other_kind_of(const std::string& beginning) {
  std::string kind = files::binary_kind(beginning);
  if (kind.empty() && files::text_kind(beginning) == files::kXmlFile) kind = files::kXmlFile;
  return kind == files::kBinaryFile ? "" : kind;
}

}  // namespace

LoadedMesh load_in_units(const std::filesystem::path& file, const FileUnits& units) {
  const std::string ending = small_letters(file.extension().string());
  for (const Format& format : kFormats)
    if (format.ending == ending) {
      const std::string beginning = std::filesystem::is_regular_file(file) ? beginning_of(file) : "";
      if (beginning.starts_with(files::kLfsBeginning)) throw Error(file, "is " + std::string(files::kLfsPointer));
      // The text in front of a binary STL file may begin like anything.
      try {
        return format.read(file, units);
      } catch (const Error&) {
        if (const std::string kind = other_kind_of(beginning); !kind.empty()) throw Error(file, "expected a mesh, got " + kind);
        throw;
      }
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

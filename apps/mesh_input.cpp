// SPDX-License-Identifier: BSD-3-Clause
#include "apps/mesh_input.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <ios>
#include <iterator>
#include <string_view>
#include <system_error>

#include "apps/progress_line.h"
#include "apps/standard_input.h"
#include "files/file_kind.h"
#include "files/temporary_folder.h"
#include "forceshade/error.h"
#include "rendering/meshes/lines.h"
#include "text/letters.h"

namespace forceshade::apps {
namespace {

namespace fs = std::filesystem;

std::string bytes_of_standard_input() {
  try {
    return {std::istreambuf_iterator<char>(standard_input()), {}};
  } catch (const std::ios_base::failure& error) {
    throw Error(name_of_input("-"), "cannot read: " + error.code().message());
  }
}

// A folder that is gone at the end, with one file in it.
class TemporaryFile {
 public:
  TemporaryFile() = default;
  ~TemporaryFile() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  fs::path named(const std::string& ending) const { return folder_ / ("mesh" + ending); }

 private:
  fs::path folder_ = files::new_temporary_folder();
};

// A binary STL file is as long as its number of triangles says.
bool is_binary_stl(std::string_view bytes) {
  constexpr std::size_t kHeader = 80, kTriangle = 50;
  if (bytes.size() < kHeader + 4) return false;
  std::array<unsigned char, 4> number;
  std::memcpy(number.data(), bytes.data() + kHeader, 4);
  std::uint64_t triangles = 0;
  for (std::size_t i = 4; i-- > 0;) triangles = triangles << 8 | number[i];
  return bytes.size() == kHeader + 4 + triangles * kTriangle;
}

// By the first word behind what a file of each format may begin with.
std::string ending_of(std::string_view bytes) {
  using files::kByteOrderMark, mesh::kBlank;
  if (is_binary_stl(bytes)) return ".stl";
  if (bytes.starts_with(kByteOrderMark)) bytes.remove_prefix(kByteOrderMark.size());
  const auto skip_to = [&bytes](std::size_t at) { bytes.remove_prefix(std::min(at, bytes.size())); };
  for (skip_to(bytes.find_first_not_of(kBlank)); bytes.starts_with('#'); skip_to(bytes.find_first_not_of(kBlank)))
    skip_to(bytes.find_first_of("\r\n"));
  std::string word(bytes.substr(0, bytes.find_first_of(std::string(kBlank) + '#')));
  if (word == "ply") return ".ply";
  word.erase(word.find_last_not_of("0123456789") + 1);  // OFF4 2 0
  if (word.ends_with("OFF")) return ".off";
  return small_letters(word) == "solid" ? ".stl" : ".obj";
}

}  // namespace

mesh::LoadedMesh load_mesh(const std::string& file, mesh::Unit unit) {
  if (!is_standard_input(file)) return mesh::load_with_corners(file, unit);
  const std::string bytes = bytes_of_standard_input();
  const TemporaryFile kept;
  const fs::path named = kept.named(ending_of(bytes));
  if (std::ofstream copy(named, std::ios::binary); !(copy << bytes).flush())
    throw Error("standard input: cannot be kept in " + named.parent_path().string() + ": " +
                std::generic_category().message(errno));
  try {
    return mesh::load_with_corners(named, unit);
  } catch (const Error& error) {
    if (!std::string_view(error.what()).starts_with(named.string() + ": ")) throw;
    throw Error(name_of_input(file), std::string(error.reason()));
  }
}

namespace {

template <class Work>
auto with_progress_of(const std::string& what, const std::string& file, const Work& work) {
  const std::string name = what + (is_standard_input(file) ? name_of_input(file) : fs::path(file).filename().string());
  try {
    return with_progress(name, work);
  } catch (const Interrupted&) {
    throw Interrupted("the " + name + " was not finished");
  }
}

}  // namespace

std::variant<mesh::CheckedMesh, mesh::Findings> checked_with_progress(const std::string& file, mesh::TriangleMesh triangles) {
  return with_progress_of("check of ", file,
                          [&](const Monitor& monitor) { return mesh::check(std::move(triangles), monitor); });
}

mesh::Irregularities irregularities_with_progress(const std::string& file, const mesh::TriangleMesh& triangles) {
  return with_progress_of("look at ", file,
                          [&](const Monitor& monitor) { return mesh::irregularities_of(triangles, monitor); });
}

}  // namespace forceshade::apps

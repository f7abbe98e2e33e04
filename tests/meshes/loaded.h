// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A text as a mesh file, and numbers as the bytes of one.

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <string>

#include "forceshade/meshes.h"
#include "tests/support/temporary_directory.h"

namespace forceshade::mesh {

// A mesh, or the words of the refusal behind the file's name.
struct Loaded {
  LoadedMesh mesh;
  std::string refusal;
};

// The mesh of a file of this name, whose ending is that of its format.
inline Loaded of_text(const std::string& name, const std::string& text, Unit unit = Unit::mm) {
  const tests::TemporaryDirectory directory;
  const std::string file = directory.write(name, text);
  try {
    return {load_with_corners(file, unit), ""};
  } catch (const Error& error) {
    const std::string words = error.what();
    EXPECT_TRUE(words.starts_with(file + ": ")) << words;
    return {{}, words.substr(std::min(words.size(), file.size() + 2))};
  }
}

// The bytes of a number, the smallest first or last.
template <class T>
std::string bytes_of(T number, std::endian order) {
  std::string bytes(sizeof number, '\0');
  std::memcpy(bytes.data(), &number, sizeof number);
  if (order != std::endian::native) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

}  // namespace forceshade::mesh

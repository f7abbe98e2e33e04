// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The parts that the fuzz targets share: the input as a file, and the ends that are allowed.

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "tests/support/temporary_directory.h"

namespace forceshade::fuzz {

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

// Ends the program, which a fuzzer and CTest both take for a failure.
inline void require(bool holds, const std::string& words) {
  if (holds) return;
  std::fprintf(stderr, "does not hold: %s\n", words.c_str());
  std::abort();
}

// The input as a file of this name, in a directory that lives as long as the program (below TMPDIR).
inline std::string file_of(std::string_view bytes, const char* name) {
  static const tests::TemporaryDirectory directory;
  return directory.write(name, bytes);
}

// Calls read(). An input is read, or refused by an Error whose words begin with `place`; any other exception ends the program.
template <class Error, class Read>
void read_or_refuse(const std::string& place, const Read& read) {
  try {
    read();
  } catch (const Error& error) {
    const std::string words = error.what();
    require(words.starts_with(place) && words.size() > place.size() + 2, "an error names its place: " + words);
  }
}

}  // namespace forceshade::fuzz

// SPDX-License-Identifier: BSD-3-Clause
// The functions of the C interface about the library itself.

#include <algorithm>
#include <array>
#include <string_view>

#include "bindings/c/errors.h"
#include "forceshade.h"
#include "forceshade/fast.h"

using namespace forceshade;

uint32_t forceshade_version(void) {
  constexpr std::uint32_t kMajor = FORCESHADE_VERSION_MAJOR, kMinor = FORCESHADE_VERSION_MINOR,
                          kPatch = FORCESHADE_VERSION_PATCH;
  return kMajor << 16U | kMinor << 8U | kPatch;
}

int32_t forceshade_has(const char* feature) {
  if (feature == nullptr) return 0;
  const std::string_view name = feature;
  for (const std::string_view always : {"laws", "height-maps", "meshes", "corner-normals", "states", "scenes", "damping"})
    if (name == always) return 1;
  constexpr std::string_view kOptional = FORCESHADE_FEATURES;  // with blanks between them: cmake/features.cmake
  for (std::size_t begin = 0; begin < kOptional.size();) {
    const std::size_t end = std::min(kOptional.find(' ', begin), kOptional.size());
    if (name == kOptional.substr(begin, end - begin)) return 1;
    begin = end + 1;
  }
  const auto set = fast::instruction_set_named(name);
  return set && *set != fast::InstructionSet::scalar && fast::is_available(*set) ? 1 : 0;
}

const char* forceshade_message(void) {
  return c::last_message();
}

const char* forceshade_name_of_result(forceshade_result result) {
  constexpr std::array kNames{"OK",   "NULL_POINTER",   "BAD_HANDLE", "BAD_SIZE", "BAD_VALUE",   "BAD_INPUT", "WRONG_KIND",
                              "BUSY", "BAD_ARITHMETIC", "NO_MEMORY",  "FAILED",   "NOT_COVERED", "LEFT_OUT"};
  const auto index = static_cast<std::size_t>(static_cast<std::uint32_t>(result));
  return index < kNames.size() ? kNames[index] : "";
}

const char* forceshade_library_digest(void) {
  return fast::library_digest();
}

const char* forceshade_arithmetic_fault(void) {
  return fast::arithmetic_fault();
}

// SPDX-License-Identifier: BSD-3-Clause
#include "device/phantom/hdapi_library.h"

#include <dlfcn.h>

#include "device/loaded_library.h"

namespace forceshade::device::hdapi {
namespace {

constexpr LibraryWords kWords{
    "the PHANToM's driver library (HDAPI, part of the vendor's OpenHaptics)", "the HDAPI",
    "Install OpenHaptics and the device's driver, or name the library's file in FORCESHADE_HD_LIBRARY."};

}  // namespace

Functions load(const std::vector<std::string>& names) {
  Functions functions{};
  load_first(names, kWords, [&](void* library) {
    std::string missing;
#define FORCESHADE_LOOK_UP_HD(function) FORCESHADE_LOOK_UP(functions, library, function, missing)
    FORCESHADE_HDAPI_FUNCTIONS(FORCESHADE_LOOK_UP_HD)
#undef FORCESHADE_LOOK_UP_HD
    return missing;
  });
  return functions;
}

std::vector<std::string> names_to_try() {
  return library_names("FORCESHADE_HD_LIBRARY", {"libHD.so.3.4", "libHD.so.3.0", "libHD.so"});
}

const Functions& vendor() {
  static const Functions functions = load(names_to_try());
  return functions;
}

HDErrorInfo drained(const Functions& hd) noexcept {
  // A driver that never stops complaining must not stop the loop; its stack is far smaller than this.
  constexpr int kMost = 256;
  HDErrorInfo oldest{};
  for (int i = 0; i < kMost; ++i) {
    const HDErrorInfo error = hd.hdGetError();
    if (error.code == kSuccess) break;
    oldest = error;
  }
  return oldest;
}

}  // namespace forceshade::device::hdapi

// SPDX-License-Identifier: BSD-3-Clause
#include "device/dhd/dhd_library.h"

#include <dlfcn.h>

#include <filesystem>

#include "device/loaded_library.h"

namespace forceshade::device::dhd {
namespace {

constexpr LibraryWords kWords{"Force Dimension's library (DHD)", "DHD", kToInstall};

}  // namespace

Functions load(const std::vector<std::string>& names) {
  Functions functions{};
  load_first(names, kWords, [&](void* library) {
    std::string missing;
#define FORCESHADE_LOOK_UP_DHD(function) FORCESHADE_LOOK_UP(functions, library, function, missing)
    FORCESHADE_DHD_FUNCTIONS(FORCESHADE_LOOK_UP_DHD)
#undef FORCESHADE_LOOK_UP_DHD
    return missing;
  });
  return functions;
}

std::vector<std::string> names_to_try() {
  return library_names("FORCESHADE_DHD_LIBRARY", {"libdhd.so.3", "libdhd.so", "libdrd.so.3", "libdrd.so"});
}

std::string file_of(const Functions& functions) {
  Dl_info about{};
  if (dladdr(reinterpret_cast<void*>(functions.dhdGetDeviceCount.pointer()), &about) == 0 || !about.dli_fname) return "";
  std::error_code none;
  const std::filesystem::path file = std::filesystem::canonical(about.dli_fname, none);
  return none ? "" : file.filename().string();
}

}  // namespace forceshade::device::dhd

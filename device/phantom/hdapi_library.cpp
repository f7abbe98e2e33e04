// SPDX-License-Identifier: BSD-3-Clause
#include "device/phantom/hdapi_library.h"

#include <dlfcn.h>

#include <cstdlib>

#include "forceshade/device.h"

namespace forceshade::device::hdapi {
namespace {

constexpr const char* kEnvironment = "FORCESHADE_HD_LIBRARY";

const std::vector<std::string> kNames{"libHD.so.3.4", "libHD.so.3.0", "libHD.so"};

std::string value_of(const char* variable) {
  const char* value = std::getenv(variable);
  return value ? value : "";
}

}  // namespace

Functions load(const std::vector<std::string>& names) {
  std::string tried;
  for (const std::string& name : names) {
    void* const library = dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
    if (!library) {
      // The reason is the library's own, or that of one that it needs.
      const std::string why = dlerror();
      tried.append("\n  ").append(why.starts_with(name) ? why : name + ": " + why);
      continue;
    }
    Functions functions{};
    std::string missing;
#define FORCESHADE_LOOK_UP(function)                                                              \
  functions.function = reinterpret_cast<decltype(functions.function)>(dlsym(library, #function)); \
  if (!functions.function) missing.append(missing.empty() ? "" : ", ").append(#function);
    FORCESHADE_HDAPI_FUNCTIONS(FORCESHADE_LOOK_UP)
#undef FORCESHADE_LOOK_UP
    if (missing.empty()) return functions;
    tried += "\n  " + name + ": is not the HDAPI, it lacks " + missing;
  }
  const std::string path = value_of("LD_LIBRARY_PATH");
  throw DeviceError("the PHANToM's driver library (HDAPI, part of the vendor's OpenHaptics) could not be loaded; tried:" +
                    tried + "\nwhere LD_LIBRARY_PATH is " + (path.empty() ? "not set" : "\"" + path + "\"") +
                    ".\nInstall OpenHaptics and the device's driver, or name the library's file in " + kEnvironment + ".");
}

std::vector<std::string> names_to_try() {
  const std::string file = value_of(kEnvironment);
  return file.empty() ? kNames : std::vector{file};
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

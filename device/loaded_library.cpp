// SPDX-License-Identifier: BSD-3-Clause
#include "device/loaded_library.h"

#include <dlfcn.h>

#include <cstdlib>

#include "forceshade/device.h"

namespace forceshade::device {
namespace {

std::string value_of(const char* variable) {
  const char* value = std::getenv(variable);
  return value ? value : "";
}

}  // namespace

void load_first(const std::vector<std::string>& names, const LibraryWords& words,
                const std::function<std::string(void* library)>& take) {
  std::string tried;
  for (const std::string& name : names) {
    const KeptControlWords kept;  // loading it may change this thread's arithmetic, too
    void* const library = dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
    if (!library) {
      // The reason is the library's own, or that of one that it needs.
      const std::string why = dlerror();
      tried.append("\n  ").append(why.starts_with(name) ? why : name + ": " + why);
      continue;
    }
    const std::string missing = take(library);
    if (missing.empty()) return;
    tried += "\n  " + name + ": is not " + words.is_not + ", it lacks " + missing;
  }
  const std::string path = value_of("LD_LIBRARY_PATH");
  throw DeviceError(std::string(words.what) + " could not be loaded; tried:" + tried + "\nwhere LD_LIBRARY_PATH is " +
                    (path.empty() ? "not set" : "\"" + path + "\"") + ".\n" + words.advice);
}

std::vector<std::string> library_names(const char* variable, const std::vector<std::string>& usual) {
  const std::string file = value_of(variable);
  return file.empty() ? usual : std::vector{file};
}

}  // namespace forceshade::device

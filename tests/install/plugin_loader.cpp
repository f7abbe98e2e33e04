// SPDX-License-Identifier: BSD-3-Clause
// Loads the plugin FILE and calls it.

#include <dlfcn.h>

#include <cstdio>

int main(int count, char** words) {
  void* plugin = count == 2 ? dlopen(words[1], RTLD_NOW | RTLD_LOCAL) : nullptr;
  if (plugin == nullptr) return std::fprintf(stderr, "%s\n", count == 2 ? dlerror() : "expected FILE"), 1;
  const auto force = reinterpret_cast<float (*)()>(dlsym(plugin, "plugin_force"));
  if (force == nullptr) return std::fprintf(stderr, "%s\n", dlerror()), 1;
  std::printf("plugin: %g N\n", static_cast<double>(force()));
  return force() == 0.5F ? 0 : 1;
}

// SPDX-License-Identifier: BSD-3-Clause
#include "device/phantom/hdapi_library.h"

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "forceshade/device.h"
#include "tests/device/stand_in_hd/stand_in_hd.h"
#include "tests/support/temporary_directory.h"
#include "tests/support/words.h"

namespace forceshade::device::hdapi {
namespace {

TEST(hdapi_library, missing_says_every_name_that_was_tried_and_where) {
  tests::expect_words(tests::thrown_by<DeviceError>([] {
                        load({"libNoSuchHD.so.9", "/nowhere/libHD.so"});
                      }),
                      {"\n  libNoSuchHD.so.9: ", "\n  /nowhere/libHD.so: ", "cannot open shared object file", "LD_LIBRARY_PATH",
                       "FORCESHADE_HD_LIBRARY"});
}

TEST(hdapi_library, is_the_first_that_fits) {
  const Functions hd = load({"libNoSuchHD.so.9", "libm.so.6", STAND_IN_HD});
  void* const library = dlopen(STAND_IN_HD, RTLD_NOW | RTLD_NOLOAD);
  ASSERT_TRUE(library);
  EXPECT_EQ(reinterpret_cast<void*>(hd.hdInitDevice.pointer()), dlsym(library, "hdInitDevice"));
}

// A file of its own, which only load() has opened.
TEST(hdapi_library, is_never_unloaded) {
  const tests::TemporaryDirectory directory;
  const std::string copy = directory.file("copy.so");
  std::filesystem::copy_file(STAND_IN_HD, copy);
  load({copy});
  void* handle = dlopen(copy.c_str(), RTLD_NOW | RTLD_NOLOAD);
  ASSERT_TRUE(handle);
  for (int i = 0; i < 10; ++i) dlclose(handle);
  EXPECT_TRUE(dlopen(copy.c_str(), RTLD_NOW | RTLD_NOLOAD));
}

TEST(hdapi_library, drains_the_stack_and_tells_the_oldest_error) {
  static std::vector<HDErrorInfo> newest_last;
  newest_last = {{kInvalidEnum, 42, 7}, {kInvalidOperation, 43, 7}};
  Functions hd{};
  hd.hdGetError = [] {
    if (newest_last.empty()) return HDErrorInfo{};
    const HDErrorInfo newest = newest_last.back();
    newest_last.pop_back();
    return newest;
  };
  EXPECT_EQ(drained(hd).internal, 42);
  EXPECT_TRUE(newest_last.empty());
  hd.hdGetError = [] { return HDErrorInfo{kDeviceFault, 0, 0}; };  // without end
  EXPECT_EQ(drained(hd).code, kDeviceFault);
}

}  // namespace
}  // namespace forceshade::device::hdapi

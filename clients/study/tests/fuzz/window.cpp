// SPDX-License-Identifier: BSD-3-Clause
#include <set>

#include "files/input_file.h"
#include "study/window/settings.h"
#include "tests/fuzz/input_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace forceshade;
  const std::string file = fuzz::file_of(fuzz::text_of(data, size), "window.toml");
  fuzz::read_or_refuse<Error>("", [&] {
    const window::WindowSettings settings = window::read_settings(file);
    fuzz::require(settings.text_scale >= 0.5 && settings.text_scale <= 3, "the size of text is within its range");
    std::multiset<std::string> keys(settings.keys.digits.begin(), settings.keys.digits.end());
    keys.insert(settings.keys.enter.begin(), settings.keys.enter.end());
    keys.insert(settings.keys.erase.begin(), settings.keys.erase.end());
    for (const std::string& key : keys) fuzz::require(!key.empty() && keys.count(key) == 1, "each key stands once");
  });
  return 0;
}

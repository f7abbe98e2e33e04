// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The parts that the tests of the real window share: a hand on its keyboard and mouse, and pictures of what it showed.

#include <gtest/gtest.h>
#include <png.h>

#include <cstdlib>
#include <filesystem>
#include <future>
#include <string>

#include "window/canvas.h"

namespace forceshade::window {

// Kept in the build folder, for people to look at.
inline void save(const Image& image, const std::string& name) {
  const std::filesystem::path folder = SCREENSHOTS;
  std::filesystem::create_directories(folder);
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(image.width);
  png.height = static_cast<png_uint_32>(image.height);
  png.format = PNG_FORMAT_RGB;
  ASSERT_NE(png_image_write_to_file(&png, (folder / (name + ".png")).c_str(), 0, image.bytes.data(), 0, nullptr), 0)
      << png.message;
}

// Types and moves through the display, as a keyboard and a mouse would, while the window goes on with its frames: a character
// that is not on the display's keyboard is put on one of its keys for a moment. The arguments are xdotool's.
inline std::future<int> by_hand(const std::string& what) {
  return std::async(std::launch::async, [command = "xdotool " + what] { return std::system(command.c_str()); });
}

}  // namespace forceshade::window

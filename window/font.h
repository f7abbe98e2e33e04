// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The font of the window: its file, and the glyphs that texts have needed so far, rendered in the sizes that they need.

#include <imgui.h>

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "window/picture.h"
#include "window/text.h"

namespace forceshade::window {

struct FontFile {
  std::string bytes;  // empty: the fallback that is part of Dear ImGui
  int face = 0;       // in a collection
  std::string note;   // words about a family that is not installed
};

// `font`: a family, or the path of a file. Throws Error for a file that cannot be read or is no font that can be drawn.
FontFile find_font(const std::string& font);

// Within the current ImGui context. Glyphs are rendered at their exact size: scaled ones would be blurred.
class Font : public Measure {
 public:
  explicit Font(FontFile file);

  double width(std::string_view words, double size) const override;

  // Renders what the picture needs and is not there yet. True if the texture has to be loaded again.
  bool prepare(const Picture& picture);

  // The font of prepared text.
  ImFont* at(double size) const;

 private:
  void render();

  FontFile file_;
  std::set<ImWchar> characters_;
  std::set<int> sizes_;
};

}  // namespace forceshade::window

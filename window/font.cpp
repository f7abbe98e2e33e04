// SPDX-License-Identifier: BSD-3-Clause
#include "window/font.h"

#include <fontconfig/fontconfig.h>
#include <stb/stb_truetype.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <memory>
#include <utility>

#include "forceshade/error.h"

namespace forceshade::window {
namespace {

// The size in which words are measured; widths in other sizes follow in proportion.
constexpr int kMeasured = 32;

// Larger text is drawn in this size, so that the texture of an alphabet stays small.
constexpr int kLargest = 160;

bool is_font(const std::string& bytes, int face) {
  const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
  if (bytes.size() < 64) return false;
  const int offset = stbtt_GetFontOffsetForIndex(data, face);
  stbtt_fontinfo info;
  return offset >= 0 && static_cast<std::size_t>(offset) + 64 < bytes.size() && stbtt_InitFont(&info, data, offset) != 0;
}

std::string bytes_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw Error(path + ": the font cannot be opened");
  return {std::istreambuf_iterator<char>(in), {}};
}

struct Found {
  std::string path, family;
  int face = 0;
};

Found matched(const std::string& family) {
  const std::unique_ptr<FcConfig, decltype(&FcConfigDestroy)> config(FcInitLoadConfigAndFonts(), &FcConfigDestroy);
  const std::unique_ptr<FcPattern, decltype(&FcPatternDestroy)> wanted(FcPatternCreate(), &FcPatternDestroy);
  if (!config || !wanted) return {};
  FcPatternAddString(wanted.get(), FC_FAMILY, reinterpret_cast<const FcChar8*>(family.c_str()));
  FcPatternAddString(wanted.get(), FC_STYLE, reinterpret_cast<const FcChar8*>("Book"));
  FcPatternAddString(wanted.get(), FC_FONTFORMAT, reinterpret_cast<const FcChar8*>("TrueType"));
  FcPatternAddBool(wanted.get(), FC_SCALABLE, FcTrue);
  FcConfigSubstitute(config.get(), wanted.get(), FcMatchPattern);
  FcDefaultSubstitute(wanted.get());
  FcResult result = FcResultNoMatch;
  const std::unique_ptr<FcPattern, decltype(&FcPatternDestroy)> found(FcFontMatch(config.get(), wanted.get(), &result),
                                                                      &FcPatternDestroy);
  FcChar8 *path = nullptr, *name = nullptr;
  Found font;
  if (!found || FcPatternGetString(found.get(), FC_FILE, 0, &path) != FcResultMatch) return {};
  font.path = reinterpret_cast<const char*>(path);
  if (FcPatternGetString(found.get(), FC_FAMILY, 0, &name) == FcResultMatch) font.family = reinterpret_cast<const char*>(name);
  FcPatternGetInteger(found.get(), FC_INDEX, 0, &font.face);
  font.face &= 0xFFFF;  // the upper half is an instance of a variable font
  return font;
}

// The size in whole pixels that stands for this one.
int rendered(double size) {
  return std::clamp(static_cast<int>(std::lround(size)), 1, kLargest);
}

ImWchar drawable(char32_t point) {
  return static_cast<ImWchar>(point <= IM_UNICODE_CODEPOINT_MAX ? point : IM_UNICODE_CODEPOINT_INVALID);
}

}  // namespace

FontFile find_font(const std::string& font) {
  if (font.find('/') != std::string::npos) {
    FontFile file{bytes_of(font), 0, {}};
    if (!is_font(file.bytes, 0)) throw Error(font + ": expected a font in the format TrueType");
    return file;
  }
  const Found found = matched(font);
  FontFile file;
  if (!found.path.empty()) file = {bytes_of(found.path), found.face, {}};
  if (!is_font(file.bytes, file.face))
    return {{}, 0, "no TrueType font is installed: the letters are those of Dear ImGui (Debian: fonts-dejavu-core)"};
  if (found.family != font) file.note = "the font " + font + " is not installed: " + found.family + " is used";
  return file;
}

Font::Font(FontFile file) : file_(std::move(file)), sizes_{kMeasured} {
  for (ImWchar c = 0x20; c < 0x180; ++c)  // Latin letters, so that most languages never need a second rendering
    if (c < 0x7F || c > 0x9F) characters_.insert(c);
  for (const int c : {0x2013, 0x2014, 0x2018, 0x2019, 0x201C, 0x201D, 0x201E, 0x2026, 0x2212, 0xFFFD})
    characters_.insert(static_cast<ImWchar>(c));
  render();
}

double Font::width(std::string_view words, double size) const {
  const float measured = at(kMeasured)->CalcTextSizeA(kMeasured, 1e30F, 0, words.data(), words.data() + words.size()).x;
  return static_cast<double>(measured) * rendered(size) / kMeasured;
}

bool Font::prepare(const Picture& picture) {
  const std::size_t characters = characters_.size(), sizes = sizes_.size();
  std::set<int> needed{kMeasured};
  for (const Item& item : picture.items)
    if (const Text* text = std::get_if<Text>(&item)) {
      needed.insert(rendered(text->size));
      for (const char32_t point : code_points(text->words)) characters_.insert(drawable(point));
    }
  sizes_.insert(needed.begin(), needed.end());
  if (characters == characters_.size() && sizes == sizes_.size()) return false;
  if (sizes_.size() > 24) sizes_ = needed;  // a window that is being resized leaves many behind
  render();
  return true;
}

ImFont* Font::at(double size) const {
  const ImVector<ImFont*>& fonts = ImGui::GetIO().Fonts->Fonts;
  const auto place = std::distance(sizes_.begin(), sizes_.find(rendered(size)));
  return fonts[static_cast<int>(std::min<std::ptrdiff_t>(place, fonts.Size - 1))];
}

void Font::render() {
  ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
  atlas.Clear();
  atlas.Flags |= ImFontAtlasFlags_NoMouseCursors;
  ImFontGlyphRangesBuilder builder;
  for (const ImWchar c : characters_) builder.AddChar(c);
  ImVector<ImWchar> ranges;
  builder.BuildRanges(&ranges);
  ImFontConfig config;
  config.FontDataOwnedByAtlas = false;
  config.FontNo = file_.face;
  config.OversampleH = 2;
  config.OversampleV = 1;
  for (const int size : sizes_)
    if (file_.bytes.empty()) {
      config.SizePixels = static_cast<float>(size);
      atlas.AddFontDefault(&config);
    } else {
      atlas.AddFontFromMemoryTTF(file_.bytes.data(), static_cast<int>(file_.bytes.size()), static_cast<float>(size), &config,
                                 ranges.Data);
    }
  atlas.Build();
}

}  // namespace forceshade::window

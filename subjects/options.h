// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The options that name what is rendered, in words: those of the command line, which are the keys of a subject file
// (docs/subjects.md).

#include <algorithm>
#include <array>
#include <functional>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "forceshade/error.h"

namespace forceshade::subjects {

struct Option {
  std::string key, value;  // "radius", "600mil"
  std::string name = {};   // its name in messages: "bump.toml: line 3: radius"; "--radius" where it is empty
};

// The kinds of a subject: just one of these keys is given.
inline constexpr std::array<std::string_view, 4> kKinds{"law", "height-map", "mesh", "scene"};

// The keys of damping; a file has the table [damping] instead.
inline constexpr std::string_view kDamping = "damping", kDrag = "drag", kDampingFilter = "damping-filter";

struct Key {
  std::string_view name;
  std::array<std::string_view, 2> of = {};  // the kinds that it can stand beside; none: all of them

  bool is_of(std::string_view kind) const { return !kind.empty() && (of[0] == kind || of[1] == kind); }
};
// In the order in which an option of each is looked at.
inline constexpr std::array<Key, 18> kKeys{{{"law"},
                                            {"radius", {"law"}},
                                            {"width", {"law"}},
                                            {"stiffness"},
                                            {"height-map"},
                                            {"mesh"},
                                            {"scene"},
                                            {"unit", {"mesh"}},
                                            {"sides", {"mesh", "scene"}},
                                            {"shading", {"mesh", "scene"}},
                                            {"contact", {"mesh", "scene"}},
                                            {"friction", {"mesh"}},
                                            {"materials", {"mesh"}},
                                            {"texture-scale", {"mesh"}},
                                            {"crease", {"mesh", "scene"}},
                                            {kDamping},
                                            {kDrag},
                                            {kDampingFilter}}};

// The defaults: the thesis's bump of 600 and 1000 mil.
inline constexpr const char *kUsualRadius = "15.24mm", *kUsualWidth = "25.4mm", *kUsualStiffness = "0.5N/mm";

class Options {
 public:
  Options() = default;
  Options(std::initializer_list<Option> options) : options_(options) {}

  void add(Option option) { options_.push_back(std::move(option)); }

  // None where it was not given.
  const Option* find(std::string_view key) const;
  bool has(std::string_view key) const { return find(key) != nullptr; }
  bool has_kind() const {
    return std::ranges::any_of(kKinds, [&](std::string_view kind) { return has(kind); });
  }
  // Empty where it was not given.
  std::string value(std::string_view key) const;
  std::string name(std::string_view key) const;

  auto begin() const { return options_.begin(); }
  auto end() const { return options_.end(); }

 private:
  std::vector<Option> options_;
};

enum class Laws { one, several };

// "one of wall, cylinder, ..."
std::string expected_law(Laws laws);
// "vertex", "edge", "none", "texture:FILE"
std::vector<std::string> shading_words();

// The value with place(file) for the file that it names; the value where it names none.
std::string with_file_placed(std::string_view key, const std::string& value,
                             const std::function<std::string(const std::string&)>& place);

// The error of an option with this value, "expected ..., got ...": of the options that have one of several words. Empty where
// it can, and for an option that has a number or a file.
std::string refusal_of(std::string_view key, const std::string& value, Laws laws = Laws::several);

// "--law, --height-map, --mesh and --scene", or with "or".
std::string words_of_kinds(std::string_view conjunction, std::string_view before = "--");

// Throws Error: an unknown key, a value that is refused, an option that is given twice or lacks another, or none of kKinds,
// or several.
void expect_consistent(const Options& options, Laws laws);

}  // namespace forceshade::subjects

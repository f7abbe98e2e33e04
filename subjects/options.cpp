// SPDX-License-Identifier: BSD-3-Clause
#include "subjects/options.h"

#include <algorithm>

#include "files/quantity.h"
#include "files/suggestion.h"
#include "forceshade/law.h"
#include "forceshade/mesh.h"
#include "forceshade/meshes.h"
#include "subjects/words.h"
#include "text/joined.h"

namespace forceshade::subjects {
namespace {

std::string option(std::string_view key) {
  return "--" + std::string(key);
}

// The words for the first name that is no law, or not another one than those before it.
std::string refusal_of_law(const std::string& names, Laws laws) {
  if (laws == Laws::several && names == "all") return "";
  std::vector<std::string> known;
  for (const LawName& law : kLaws) known.emplace_back(law.name);
  const std::vector<std::string> all = laws == Laws::several ? files::at_commas(names) : std::vector{names};
  for (auto name = all.begin(); name != all.end(); ++name) {
    if (!law_named(*name)) return "expected " + expected_law(laws) + "; got \"" + *name + '"' + files::suggestion(*name, known);
    if (std::find(all.begin(), name, *name) != name) return "expected each law once, got " + *name + " twice";
  }
  return "";
}

std::string refusal_of_word(const std::string& got, const std::vector<std::string>& words) {
  if (std::ranges::find(words, got) != words.end()) return "";
  return "expected one of " + joined(words, ", ") + "; got \"" + got + '"' + files::suggestion(got, words);
}

template <std::size_t N>
std::vector<std::string> texts(const std::array<std::string_view, N>& words) {
  return {words.begin(), words.end()};
}

// A law is not named where all of them are meant; a file always is.
void expect_companions(const Options& options, const Key& key) {
  const std::string name = options.name(key.name);
  const bool is_kind = std::ranges::find(kKinds, key.name) != kKinds.end();
  if (!is_kind && key.of[0].empty()) return;
  std::vector<std::string_view> others;  // kinds that are given and that it cannot stand beside
  std::string its;
  for (const std::string_view kind : kKinds) {
    if (key.is_of(kind)) its += (its.empty() ? "" : " or ") + option(kind);
    if (kind != key.name && !key.is_of(kind) && options.has(kind)) others.push_back(kind);
  }
  const bool is_beside_its =
      std::ranges::any_of(kKinds, [&](std::string_view kind) { return key.is_of(kind) && options.has(kind); });
  if (!is_kind && !key.is_of("law") && !is_beside_its)
    throw Error(name + ": expected " + its + " beside it, got " + (others.empty() ? "it alone" : option(others.front())));
  if (!others.empty()) throw Error(name + ": expected without " + option(others.front()) + ", got both");
}

}  // namespace

const Option* Options::find(std::string_view key) const {
  const auto found = std::ranges::find(options_, key, &Option::key);
  return found == options_.end() ? nullptr : &*found;
}

std::string Options::value(std::string_view key) const {
  const Option* found = find(key);
  return found == nullptr ? "" : found->value;
}

std::string Options::name(std::string_view key) const {
  const Option* found = find(key);
  return found == nullptr || found->name.empty() ? option(key) : found->name;
}

std::string expected_law(Laws laws) {
  return (laws == Laws::several ? "all, or one or several, with commas between them, of " : "one of ") +
         joined(kLaws, ", ", &LawName::name);
}

std::vector<std::string> shading_words() {
  std::vector<std::string> words;
  for (const std::string_view name : mesh::kShadingNames)
    if (name != name_of(mesh::Shading::none) && name != name_of(mesh::Shading::texture_scheme)) words.emplace_back(name);
  words.emplace_back(name_of(mesh::Shading::none));
  words.push_back(std::string(kTexturePrefix) + "FILE");
  return words;
}

std::string with_file_placed(std::string_view key, const std::string& value,
                             const std::function<std::string(const std::string&)>& place) {
  if (key == "mesh" || key == "height-map" || key == "scene" || key == "materials") return place(value);
  if (key != "shading" || !is_texture(value)) return value;
  return std::string(kTexturePrefix) + place(value.substr(kTexturePrefix.size()));
}

std::string refusal_of(std::string_view key, const std::string& value, Laws laws) {
  if (value.empty()) return "expected a value, got an empty one";
  if (key == "law") return refusal_of_law(value, laws);
  if (key == "unit") return refusal_of_word(value, texts(mesh::kUnitNames));
  if (key == "sides") return refusal_of_word(value, texts(mesh::kSidesNames));
  if (key == "contact") return refusal_of_word(value, texts(mesh::kContactNames));
  if (key == "shading") return is_texture(value) ? "" : refusal_of_word(value, shading_words());
  return "";
}

std::string words_of_kinds(std::string_view conjunction, std::string_view before) {
  const auto word_of = [&](std::string_view kind) { return std::string(before) + std::string(kind); };
  return joined(kKinds, ", ", word_of, ' ' + std::string(conjunction) + ' ');
}

void expect_consistent(const Options& options, Laws laws) {
  for (const auto& [key, value, name] : options) {
    if (std::ranges::find(kKeys, key, &Key::name) == kKeys.end())
      throw Error((name.empty() ? option(key) : name) + ": expected an option of a subject, got an unknown one" +
                  files::suggestion(key, names_of_keys()));
    const auto is_it = [&, &key = key](const Option& other) { return other.key == key; };
    if (std::count_if(options.begin(), options.end(), is_it) > 1)
      throw Error(options.name(key) + ": expected once, got several times");
    if (const std::string refusal = refusal_of(key, value, laws); !refusal.empty())
      throw Error(options.name(key) + ": " + refusal);
  }
  for (const Key& key : kKeys)
    if (options.has(key.name)) expect_companions(options, key);
  if (options.has("friction") && options.has("materials"))
    throw Error(options.name("friction") + ": expected without --materials, got both");
  if (!options.has_kind()) throw Error("expected one of the options " + words_of_kinds("and") + ", got none");
}

}  // namespace forceshade::subjects

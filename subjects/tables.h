// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Tools of the readers of TOML files here: places in messages, keys that are known, options and materials. Included
// by source files alone.

#include <filesystem>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "files/toml_file.h"
#include "forceshade/mesh.h"
#include "subjects/options.h"

namespace forceshade::subjects {

// The document in a file or text. file: its name in messages. Throws Error with the file and the line.
files::TomlDocument document_in(std::variant<files::TomlDocument, files::TomlFault> parsed, const std::string& file);

// The path of a file that is named in this file: beside it, unless the name is an absolute path.
std::string beside(const std::filesystem::path& file, const std::string& name);

// The option that a key of a file stands for, with the name "bump.toml: line 3: radius"; files that it names lie beside the
// file. keys: those that there may be, of a subject or of a scene. Throws Error for another key or a value of a wrong type.
Option option_of(const std::string& key, const toml::node& node, const files::TomlDocument& document,
                 const std::filesystem::path& file, const std::vector<std::string>& keys, const std::string& whose);

// True of a key of earlier versions that says nothing any more: self-intersecting, which is true or false. Throws Error for
// another value.
bool is_former(std::string_view key, const toml::node& node, const std::filesystem::path& file);

// The options that the table [damping] of a file stands for. Throws Error as option_of() does, and where a number is out of its
// range.
std::vector<Option> options_of_damping(const toml::node& node, const files::TomlDocument& document,
                                       const std::filesystem::path& file);

// A TOML file of materials or of a scene.
class Tables {
 public:
  // Throws Error where the file cannot be read or is no TOML of at most so many bytes.
  Tables(std::string file, std::size_t most_bytes)
      : file_(std::move(file)), document_(document_in(files::parse_toml_file(file_, most_bytes), file_)) {}

  const std::string& file() const { return file_; }
  const files::TomlDocument& document() const { return document_; }
  const toml::table& root() const { return document_.root(); }

  // "wheel.toml: line 3: friction"
  std::string name_of(const toml::node& at, std::string_view key) const;
  [[noreturn]] void fail(const toml::node& at, std::string_view key, const std::string& expected, const toml::node& got) const;

  // These throw Error for anything else than what their names say.
  const toml::table& table_of(std::string_view key, const toml::node& node) const;
  void expect_keys(const toml::table& table, const std::vector<std::string>& keys) const;
  // The tables of [[key]]; none where the file has no such key.
  std::vector<const toml::table*> tables_of(const std::string& key) const;
  // A text in quotes that is not empty. whose: what needs the key, such as "[[material]]"; expected: "a name".
  std::string text_of(const toml::table& table, std::string_view key, std::string_view whose,
                      const std::string& expected) const;
  // The material that the keys friction, stiffness, damping and drag give.
  mesh::Material material_of(const toml::table& table) const;

 private:
  std::string file_;
  files::TomlDocument document_;
};

}  // namespace forceshade::subjects

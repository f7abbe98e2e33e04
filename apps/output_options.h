// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Options that name what a command writes: --out, --json, --junit. One rule holds for all of them: a file that is
// there already is replaced only where --overwrite is given, and this is decided before any work is done. Standard output,
// which is called "-", other open descriptors such as /dev/fd/3 or >(COMMAND), and what is no regular file (a pipe, /dev/null)
// are written to.

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "files/output_folder.h"

namespace forceshade::apps {

// NAME FILE. endings: ".json" and so on, those that name the formats which are written. A name that ends as another format does
// is refused, because the file could not be read as what it is called.
CLI::Option* add_output(CLI::App& command, const std::string& name, std::string& path, const std::string& help,
                        const std::vector<std::string>& endings);

// --json [FILE]: standard output without FILE. `what` is what is written.
CLI::Option* add_json(CLI::App& command, std::string& path, const std::string& what);

// Writes to the file of --json, if it was given; indent -1: on one line. Characters beyond ASCII are escaped, and other bytes
// than UTF-8 replaced, so that the text is JSON that any terminal shows.
void write_json(const std::string& file, const nlohmann::ordered_json& json, int indent = 2);

// --junit FILE.
CLI::Option* add_junit(CLI::App& command, std::string& path);

// Throws Error, naming the option, where the file is there and may not be replaced. The option was added by a function of
// this file, or the command has an OutFolder.
void expect_new(const CLI::App& command, const std::string& option, const std::string& path);

// Throws Error, naming the option, where no file can be made at this path, because its folder is not there or cannot be
// written to. So a long run does not have to end before this is reported. An empty path is an option that was not given.
void expect_folder_of(const std::string& option, const std::string& path);

// The values of --json and --junit of a command: two files, each with a folder that can be written to, before a long run.
// Throws Error.
void expect_room_for_results(const std::string& json, const std::string& junit);

// True if --overwrite was given.
bool overwrites(const CLI::App& command);

// --out DIR. One process has the folder at a time, until the command ends: another one that wants it is refused before any
// work.
class OutFolder {
 public:
  OutFolder(CLI::App& command, const std::string& help);

  // The command needs it. Not where a subcommand has an --out of its own: then make() says that it is missing.
  void require() { option_->required(); }

  // The folder is there afterwards. Throws Error, also where another process has it.
  void make() const;

  // Throws Error where the folder cannot be made or written to, another process has it, or it has one of these files, unless
  // it may be replaced. Only the folders that it is in are there afterwards, so that folder() can make it whole.
  void expect_room_for(const std::vector<std::string>& files) const;

  const std::string& path() const { return path_; }

  // After make() or expect_room_for().
  files::OutputFolder& folder() const { return *folder_; }

 private:
  void make_unclaimed() const;
  void claim() const;

  std::string path_;
  mutable std::unique_ptr<files::OutputFolder> folder_;
  const CLI::App& command_;
  CLI::Option* option_;
};

}  // namespace forceshade::apps

// SPDX-License-Identifier: BSD-3-Clause
#include "apps/output_options.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "apps/command.h"
#include "apps/options.h"
#include "files/output_file.h"
#include "text/joined.h"

namespace forceshade::apps {
namespace {

constexpr const char* kOverwrite = "--overwrite";

// The endings of the formats that this program reads or writes.
constexpr std::array kEndings{".csv", ".npy",  ".fsr", ".json", ".xml", ".html", ".png",
                              ".svg", ".toml", ".off", ".obj",  ".ply", ".stl"};

void add_overwrite(CLI::App& command) {
  if (command.get_option_no_throw(kOverwrite) == nullptr)
    command.add_flag(kOverwrite)
        ->group(kOutputGroup)
        ->description("replace files that are there already; without it they are refused");
}

// The reason why the file may not be written; empty if it may.
std::string refusal(const CLI::App& command, const std::string& path) {
  std::error_code ignored;
  if (files::is_written_directly(path)) return "";
  if (std::filesystem::is_directory(path, ignored)) return "expected a file, got \"" + path + "\", which is a folder";
  if (overwrites(command) || !std::filesystem::exists(path, ignored)) return "";
  return "expected a new file, or --overwrite beside it; \"" + path + "\" is there already";
}

std::string refusal_of_ending(const std::string& path, const std::vector<std::string>& endings) {
  const std::string ending = files::format_ending(path);
  if (std::ranges::find(kEndings, ending) == kEndings.end() || std::ranges::find(endings, ending) != endings.end()) return "";
  return "expected a name that ends in " + joined(endings, " or ") +
         ", which is the format of the file that is written, got \"" + path + '"';
}

// One name for standard output, so that a command does not write words among what it writes there.
std::string shorten_standard_output(std::string& path) {
  if (files::is_standard_output(path)) path = "-";
  return "";
}

}  // namespace

void expect_room_for_results(const std::string& json, const std::string& junit) {
  if (!json.empty() && json == junit) throw Error("--json and --junit: expected two files, got \"" + json + "\" for both");
  expect_folder_of("--json", json);
  expect_folder_of("--junit", junit);
}

bool overwrites(const CLI::App& command) {
  return command.count(kOverwrite) > 0;
}

void expect_new(const CLI::App& command, const std::string& option, const std::string& path) {
  if (const std::string words = refusal(command, path); !words.empty()) throw Error(option + ": " + words);
}

void expect_folder_of(const std::string& option, const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  if (path.empty() || files::is_written_directly(path)) return;
  const fs::path file = files::followed(path), folder = file.has_parent_path() ? file.parent_path() : ".";
  if (!fs::is_directory(folder, ignored) || ::access(folder.c_str(), W_OK | X_OK) != 0)
    throw Error(option + ": expected a file in a folder that can be written to, got \"" + path + '"');
}

CLI::Option* add_output(CLI::App& command, const std::string& name, std::string& path, const std::string& help,
                        const std::vector<std::string>& endings) {
  add_overwrite(command);
  return command.add_option(name, path, help)
      ->type_name("FILE")
      ->group(kOutputGroup)
      ->transform(CLI::Validator(shorten_standard_output, ""))
      ->check(CLI::Validator([endings](const std::string& file) { return refusal_of_ending(file, endings); }, ""))
      ->check(CLI::Validator([&command](const std::string& file) { return refusal(command, file); }, ""));
}

CLI::Option* add_json(CLI::App& command, std::string& path, const std::string& what) {
  return add_output(command, "--json", path, what + " as JSON, on standard output unless a file is named", {".json"})
      ->type_name("[FILE]")
      ->expected(0, 1)
      ->default_str("-");
}

void write_json(const std::string& file, const nlohmann::ordered_json& json, int indent) {
  if (!file.empty()) write_file(file, json.dump(indent, ' ', true, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

CLI::Option* add_junit(CLI::App& command, std::string& path) {
  return add_output(command, "--junit", path, "the results as JUnit XML, for continuous integration", {".xml"});
}

OutFolder::OutFolder(CLI::App& command, const std::string& help)
    : command_(command), option_(command.add_option("--out", path_, help)->type_name("DIR")->group(kOutputGroup)) {
  add_overwrite(command);
}

void OutFolder::make_unclaimed() const {
  namespace fs = std::filesystem;
  if (path_.empty()) throw CLI::RequiredError("--out");
  std::error_code ignored;
  const fs::file_status there = fs::status(path_, ignored);
  if (files::is_written_directly(path_) || (fs::exists(there) && !fs::is_directory(there)))
    throw Error("--out: expected a directory, for the command writes several files, got \"" + path_ + '"');
  make_directory("--out", path_);
}

void OutFolder::claim() const {
  try {
    folder_ = std::make_unique<files::OutputFolder>(path_);  // the one before, if any, is given up last
  } catch (const files::OutputError& error) {
    throw Error(std::string("--out: ") + error.what());
  }
}

void OutFolder::make() const {
  if (!folder_) expect_room_for({});  // also where another process will put the folder in place, and has it beside that place
  make_unclaimed();
  // A claim from before the folder was there is beside it, where others no longer look.
  if (!folder_ || folder_->so_far().parent_path() != folder_->path()) claim();
}

void OutFolder::expect_room_for(const std::vector<std::string>& files) const {
  namespace fs = std::filesystem;
  std::error_code ignored;
  const bool was_there = fs::exists(path_, ignored);
  make_unclaimed();
  if (!was_there) fs::remove(path_, ignored);
  claim();
  for (const std::string& name : files) {
    const fs::path file = fs::path(path_) / name;
    if (const fs::file_status at = fs::symlink_status(file, ignored); fs::exists(at) && !fs::is_regular_file(at))
      throw Error("--out: expected a new file or a regular one, got \"" + file.string() + '"');
    expect_new(command_, "--out", file);
  }
}

}  // namespace forceshade::apps

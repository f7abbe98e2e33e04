// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/apps/output_options.h"

#include <unistd.h>

#include <filesystem>

#include "forceshade/apps/command.h"

namespace forceshade::apps {
namespace {

constexpr const char* kOverwrite = "--overwrite";

void add_overwrite(CLI::App& command) {
  if (command.get_option_no_throw(kOverwrite) == nullptr)
    command.add_flag(kOverwrite)->description("replace files that are there already; without it they are refused");
}

// Nothing where the file may be written.
std::string refusal(const CLI::App& command, const std::string& path) {
  std::error_code ignored;
  if (path == "-" || overwrites(command) || !std::filesystem::is_regular_file(path, ignored)) return "";
  return "expected a new file, or --overwrite beside it; \"" + path + "\" is there already";
}

}  // namespace

bool overwrites(const CLI::App& command) {
  return command.count(kOverwrite) > 0;
}

void expect_new(const CLI::App& command, const std::string& option, const std::string& path) {
  if (const std::string words = refusal(command, path); !words.empty()) throw BadInput(option + ": " + words);
}

void expect_folder_of(const std::string& option, const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  if (path.empty() || path == "-" || (fs::exists(status) && !fs::is_regular_file(status))) return;
  const fs::path folder = fs::path(path).has_parent_path() ? fs::path(path).parent_path() : ".";
  if (!fs::is_directory(folder, ignored) || ::access(folder.c_str(), W_OK | X_OK) != 0)
    throw BadInput(option + ": expected a file in a folder that can be written to, got \"" + path + '"');
}

CLI::Option* add_output(CLI::App& command, const std::string& name, std::string& path, const std::string& help) {
  add_overwrite(command);
  return command.add_option(name, path, help)
      ->type_name("FILE")
      ->check(CLI::Validator([&command](const std::string& file) { return refusal(command, file); }, ""));
}

CLI::Option* add_json(CLI::App& command, std::string& path, const std::string& what) {
  return add_output(command, "--json", path, what + " as JSON, on standard output unless a file is named")
      ->type_name("[FILE]")
      ->option_text("[FILE]")  // the help would show the default as a value
      ->expected(0, 1)
      ->default_str("-");
}

OutFolder::OutFolder(CLI::App& command, const std::string& help)
    : command_(command), option_(command.add_option("--out", path_, help)->type_name("DIR")) {
  add_overwrite(command);
}

void OutFolder::make(const std::vector<std::string>& files) const {
  if (path_.empty()) throw CLI::RequiredError("--out");
  if (path_ == "-") throw BadInput("--out: expected a directory, for the command writes several files, got \"-\"");
  for (const std::string& file : files) expect_new(command_, "--out", std::filesystem::path(path_) / file);
  make_directory("--out", path_);
}

}  // namespace forceshade::apps

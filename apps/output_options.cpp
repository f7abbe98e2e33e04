// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/apps/output_options.h"

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
  for (const std::string& file : files) expect_new(command_, "--out", std::filesystem::path(path_) / file);
  make_directory("--out", path_);
}

}  // namespace forceshade::apps

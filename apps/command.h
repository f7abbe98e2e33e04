// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What the subcommands share: exit codes, the options that name a law and its parameters, whole output files.

#include <CLI/CLI.hpp>
#include <array>
#include <string>
#include <variant>
#include <vector>

#include "apps/bad_input.h"
#include "rendering/law.h"

namespace forceshade::apps {

enum ExitCode { kHeld = 0, kFailed = 1, kBadInput = 2, kDeviceFault = 3, kInterrupted = 130 };

// What --radius and --width are unless said: 600 and 1000 mil.
inline constexpr const char *kThesisRadius = "15.24mm", *kThesisWidth = "25.4mm";

// --law, which is needed where one law is expected and "all" unless said where all are; and --radius, --width and --stiffness,
// which are those of the thesis unless said: R = 15.24 mm, w = 25.4 mm, K = 0.5 N/mm.
class LawOptions {
 public:
  enum class Laws { one, several };

  LawOptions(CLI::App& command, Laws laws);

  // From then on --law is needed only without this option, and --law, --radius and --width are refused beside it; so for each
  // option that is allowed.
  void allow_instead(CLI::Option* other);

  std::vector<LawId> laws() const;
  LawId law() const { return laws().front(); }

  // Throws BadInput when a parameter cannot be read, or is outside the domain of one of the laws.
  Parameters parameters() const;

  float stiffness() const;  // N/mm

 private:
  CLI::Option* law_option_ = nullptr;
  std::array<CLI::Option*, 2> bump_options_{};  // --radius, --width
  std::vector<CLI::Option*> needed_unless_;
  std::string law_;
  std::string radius_ = kThesisRadius, width_ = kThesisWidth, stiffness_ = "0.5N/mm";
};

// --radius and --width of a bump, those of the thesis unless said.
class BumpOptions {
 public:
  explicit BumpOptions(CLI::App& command);

  // From then on they are refused beside this option.
  void allow_instead(CLI::Option* other);

  // With a stiffness of 1 N/mm, which the geometry does not need. Throws BadInput.
  Parameters bump() const;

 private:
  std::array<CLI::Option*, 2> options_;
  std::string radius_ = kThesisRadius, width_ = kThesisWidth;
};

// Of what both sides' build() give; throws BadInput, which begins with `what`.
template <class L>
L built(std::variant<L, ParameterError> law, const std::string& what = "--") {
  if (const auto* error = std::get_if<ParameterError>(&law)) throw BadInput(what + error->message());
  return std::get<L>(std::move(law));
}

// Writes the file whole or not at all; "-" is standard output. Throws files::OutputError.
void write_file(const std::string& path, const std::string& text);

// Throws BadInput, naming the option, unless the directory is there or can be made, and can be written to.
void make_directory(const std::string& option, const std::string& path);

// Of what make_directory() made, removes the directories in which nothing was written: a command that fails leaves none behind.
void remove_unused_directories();

// One function per subcommand; each runs through `result` when the user calls it.
void add_laws(CLI::App& app, int& result);
void add_geometry(CLI::App& app, int& result);
void add_polygons(CLI::App& app, int& result);
void add_force(CLI::App& app, int& result);
void add_energy(CLI::App& app, int& result);
void add_plot(CLI::App& app, int& result);
void add_figures(CLI::App& app, int& result);
void add_properties(CLI::App& app, int& result);
void add_certify(CLI::App& app, int& result);
void add_drive(CLI::App& app, int& result);
void add_recording(CLI::App& app, int& result);
void add_device(CLI::App& app, int& result);
void add_mesh(CLI::App& app, int& result);
void add_experiment(CLI::App& app, int& result);
void add_analyze(CLI::App& app, int& result);

}  // namespace forceshade::apps

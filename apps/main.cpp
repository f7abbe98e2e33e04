// SPDX-License-Identifier: BSD-3-Clause
// The forceshade command. Exit codes: 0 held, 1 a check failed, 2 bad usage or input, 3 device fault, 130 interrupted.

#include <algorithm>
#include <cstdio>
#include <exception>
#include <iostream>
#include <sstream>
#include <string>

#include "forceshade/apps/command.h"
#include "forceshade/apps/documentation.h"
#include "forceshade/apps/options.h"
#include "forceshade/apps/standard_streams.h"
#include "forceshade/certificate/build.h"
#include "forceshade/csv/output_file.h"
#include "forceshade/csv/printable.h"
#include "forceshade/device/open_device.h"

namespace forceshade::apps {
namespace {

void print_lines(const std::string& text) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) std::cerr << csv::printable(line) << '\n';
}

int run(int argc, char** argv) {
  CLI::App app("Haptic force laws, correctly rounded in real time: evaluate, check, certify and drive.", "forceshade");
  app.set_version_flag("--version", [] {
    const properties::Build build = properties::current_build();
    return "forceshade " + build.version + "\nrevision         " + build.revision + "\ncompiler         " + build.compiler +
           "\ninstruction set  " + build.instruction_set + "\nlibrary digest   " + build.library_digest;
  });
  app.require_subcommand(1);
  app.footer(std::string(kQuantities) + '\n' + kFiles + '\n' + kExitCodes +
             "\n'forceshade COMMAND --help' explains a command, and 'forceshade man COMMAND | man -l -' shows its page.");
  app.failure_message(failure_message);
  int result = kHeld;
  add_laws(app, result);
  add_geometry(app, result);
  add_polygons(app, result);
  add_force(app, result);
  add_energy(app, result);
  add_plot(app, result);
  add_figures(app, result);
  add_properties(app, result);
  add_certify(app, result);
  add_drive(app, result);
  add_recording(app, result);
  add_device(app, result);
  add_mesh(app, result);
  add_experiment(app, result);
  add_analyze(app, result);
  add_man(app);
  add_completion(app);
  refuse_empty_values(app);
  if (argc > 1 && argv[1][0] != '-') {
    const std::vector<CLI::App*> commands = app.get_subcommands([](const CLI::App*) { return true; });
    const auto is_named = [&](const CLI::App* command) { return command->get_name() == argv[1]; };
    if (std::none_of(commands.begin(), commands.end(), is_named)) {
      std::cerr << "forceshade: unknown command \"" << argv[1] << "\"; expected one of:";
      std::vector<std::string> names;
      for (const CLI::App* command : commands) names.push_back(command->get_name());
      for (const std::string& name : names) std::cerr << ' ' << name;
      if (const std::string near = nearest(argv[1], names); !near.empty()) std::cerr << "; the nearest is " << near;
      std::cerr << '\n';
      return kBadInput;
    }
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::ostringstream help;  // not std::cout: it would be flushed where nobody sees whether that fails
    const int code = app.exit(error, help, std::cerr);
    std::fputs(help.str().c_str(), stdout);
    return code == 0 ? kHeld : kBadInput;
  } catch (const device::DeviceError& error) {
    // Several lines: what was tried and what to check.
    std::cerr << "forceshade: device fault: ";
    print_lines(error.what());
    return kDeviceFault;
  } catch (const BadInputOfLines& error) {
    std::cerr << "forceshade: ";
    print_lines(error.what());
    return kBadInput;
  } catch (const Interrupted& error) {
    std::cerr << "forceshade: interrupted: " << csv::printable(error.what()) << '\n';
    return kInterrupted;
  } catch (const std::exception& error) {
    std::cerr << "forceshade: " << csv::printable(error.what()) << '\n';
    return kBadInput;
  }
  return result;
}

}  // namespace
}  // namespace forceshade::apps

int main(int argc, char** argv) {
  using namespace forceshade;
  apps::open_standard_streams();
  const int result = apps::run(argc, argv);
  apps::remove_unused_directories();
  try {
    apps::flush_standard_output();
  } catch (const csv::OutputError& error) {
    std::cerr << "forceshade: " << csv::printable(error.what()) << '\n';
    return result == apps::kHeld ? apps::kBadInput : result;
  }
  return result;
}

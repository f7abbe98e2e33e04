// SPDX-License-Identifier: BSD-3-Clause
// The forceshade command. Exit codes: 0 held, 1 a check failed, 2 bad usage or input, 3 device fault.

#include <algorithm>
#include <exception>
#include <iostream>
#include <sstream>
#include <string>

#include "forceshade/apps/command.h"
#include "forceshade/csv/printable.h"
#include "forceshade/device/open_device.h"
#include "forceshade/properties/build.h"

int main(int argc, char** argv) {
  using namespace forceshade;
  CLI::App app("Haptic force laws, correctly rounded in real time: evaluate, check, certify and drive.", "forceshade");
  app.set_version_flag("--version", [] {
    const properties::Build build = properties::current_build();
    return "forceshade " + build.version + " (" + build.revision + ", " + build.compiler + ", " + build.instruction_set + ")";
  });
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 held, 1 a check failed, 2 bad usage or input, 3 device fault or safety trip.\n"
      "'forceshade COMMAND --help' explains a command.");
  int result = apps::kHeld;
  apps::add_laws(app, result);
  apps::add_geometry(app, result);
  apps::add_polygons(app, result);
  apps::add_force(app, result);
  apps::add_energy(app, result);
  apps::add_plot(app, result);
  apps::add_figures(app, result);
  apps::add_properties(app, result);
  apps::add_certify(app, result);
  apps::add_drive(app, result);
  apps::add_record(app, result);
  if (argc > 1 && argv[1][0] != '-') {
    const std::vector<CLI::App*> commands = app.get_subcommands([](const CLI::App*) { return true; });
    const auto is_named = [&](const CLI::App* command) { return command->get_name() == argv[1]; };
    if (std::none_of(commands.begin(), commands.end(), is_named)) {
      std::cerr << "forceshade: unknown command \"" << argv[1] << "\"; expected one of:";
      for (const CLI::App* command : commands) std::cerr << ' ' << command->get_name();
      std::cerr << '\n';
      return apps::kBadInput;
    }
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? apps::kHeld : apps::kBadInput;
  } catch (const device::DeviceError& error) {
    // Several lines: what was tried and what to check.
    std::cerr << "forceshade: device fault: ";
    std::istringstream words(error.what());
    for (std::string line; std::getline(words, line);) std::cerr << csv::printable(line) << '\n';
    return apps::kDeviceFault;
  } catch (const std::exception& error) {
    std::cerr << "forceshade: " << csv::printable(error.what()) << '\n';
    return apps::kBadInput;
  }
  return result;
}

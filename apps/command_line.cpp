// SPDX-License-Identifier: BSD-3-Clause
#include "apps/command_line.h"

#include <array>

#include "apps/command.h"
#include "apps/examples.h"
#include "apps/program.h"
#include "apps/render_object.h"
#include "apps/standard_streams.h"
#include "properties/conformance/doors/object_door.h"

namespace forceshade::apps {
namespace {

constexpr std::array kCommands{
    Command{"laws", add_laws},           Command{"geometry", add_geometry}, Command{"polygons", add_polygons},
    Command{"force", add_force},         Command{"energy", add_energy},     Command{"plot", add_plot},
    Command{"figures", add_figures},     Command{"properties", add_properties},
    Command{"certify", add_certify},     Command{"positions", add_positions},
    Command{"compare", add_compare},     Command{"conform", add_conform},
    Command{"vectors", add_vectors},     Command{"drive", add_drive},
    Command{"recording", add_recording}, Command{"device", add_device},
    Command{"mesh", add_mesh}};
constexpr std::array kFormerCommands{
    FormerCommand{"experiment", "'forceshade-study experiment', a program that is built in clients/study"},
    FormerCommand{"analyze", "'forceshade-study analyze', a program that is built in clients/study"}};

}  // namespace

int run_command_line(const std::vector<std::string>& arguments) {
  if (arguments.size() == 2 && arguments[0] == conformance::kRenderObject) {
    open_standard_streams();
    return render_object(arguments[1]);
  }
  return run_program({.name = "forceshade",
                      .description = "Haptic force laws, correctly rounded in real time: evaluate, check, certify and drive.",
                      .commands = kCommands,
                      .examples = forceshade_examples(),
                      .former = kFormerCommands},
                     arguments);
}

}  // namespace forceshade::apps

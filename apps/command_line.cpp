// SPDX-License-Identifier: BSD-3-Clause
#include "apps/command_line.h"

#include <array>

#include "apps/command.h"
#include "apps/examples.h"
#include "apps/program.h"

namespace forceshade::apps {
namespace {

constexpr std::array kCommands{
    Command{"laws", add_laws},
    Command{"force", add_force},
    Command{"energy", add_energy},
    Command{"plot", add_plot},
    Command{"properties", add_properties},
    Command{"certify", add_certify},
    Command{"conform", add_conform},
    Command{"drive", add_drive},
    Command{"recording", add_recording},
    Command{"device", add_device},
    Command{"mesh", add_mesh},
};
constexpr std::array kFormer{
    FormerWords{"geometry", "forceshade laws --radius LENGTH --width LENGTH"},
    FormerWords{"polygons", "forceshade laws --theta-critical ANGLE"},
    FormerWords{"figures", "forceshade plot --what thesis"},
    FormerWords{"positions", "forceshade conform positions"},
    FormerWords{"compare", "forceshade conform judge FILE"},
    FormerWords{"vectors", "forceshade conform vectors"},
    FormerWords{"conform --recording", "forceshade conform recording FILE"},
    FormerWords{"conform --simulator", "forceshade conform simulator --command COMMAND"},
    FormerWords{"conform --max-answer-time", "forceshade conform --timing SECONDS"},
    FormerWords{"certify --exhaustive", "forceshade certify plan --exhaustive"},
    FormerWords{"certify --sweeps", "forceshade certify plan --exhaustive LIST"},
    FormerWords{"certify --shards", "forceshade certify plan --units N"},
    FormerWords{"device list", "forceshade device"},
    FormerWords{"mesh info", "forceshade mesh check FILE"},
    FormerWords{"experiment", "forceshade-study experiment", ", a program that is built in clients/study"},
    FormerWords{"analyze", "forceshade-study analyze", ", a program that is built in clients/study"},
};

}  // namespace

int run_command_line(const std::vector<std::string>& arguments) {
  return run_program({.name = "forceshade",
                      .description = "Haptic force laws, correctly rounded in real time: evaluate, check, certify and drive.",
                      .commands = kCommands,
                      .examples = forceshade_examples(),
                      .former = kFormer},
                     arguments);
}

}  // namespace forceshade::apps

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
    FormerWords{"figures", "forceshade plot thesis"},
    FormerWords{"positions", "forceshade conform positions"},
    FormerWords{"compare", "forceshade conform judge FILE"},
    FormerWords{"vectors", "forceshade conform positions --out FILE.json"},
    FormerWords{"conform vectors", "forceshade conform positions --out FILE.json"},
    FormerWords{"conform --recording", "forceshade conform recording FILE"},
    FormerWords{"conform --simulator", "forceshade conform simulator --command COMMAND"},
    FormerWords{"conform --max-answer-time", "forceshade conform --timing SECONDS"},
    FormerWords{"certify --exhaustive", "forceshade certify plan --exhaustive"},
    FormerWords{"certify --sweeps", "forceshade certify plan --exhaustive LIST"},
    FormerWords{"certify --shards", "forceshade certify plan --units N"},
    FormerWords{"certify status", "forceshade certify merge PLAN"},
    FormerWords{"recording info", "forceshade recording check FILE"},
    FormerWords{"recording verify", "forceshade recording check FILE"},
    FormerWords{"recording recompute", "forceshade recording check FILE --law ID", ", or another subject"},
    FormerWords{"--along --at --from --to", "--section x=FROM..TO,y=AT"},
    FormerWords{"--azimuth --elevation", "--view AZIMUTH,ELEVATION"},
    FormerWords{"--what", "forceshade plot PICTURE"},
    FormerWords{"plot --input", "forceshade plot FILE.csv"},
    FormerWords{"force --input", "forceshade force FILE"},
    FormerWords{"--path", "--digits N|binary32"},
    FormerWords{"--across-radius", "--radius AROUND,ACROSS"},
    FormerWords{"--object", "--command FILE.so"},
    FormerWords{"conform recording --units", "--columns t=NAME,...,ms,m,mN"},
    FormerWords{"--noise --energy", "--allow 0.02N,1mJ"},
    FormerWords{"--origin", "--place X,Y,Z"},
    FormerWords{"--turn", "--place TURNS"},
    FormerWords{"--record", "--out FILE"},
    FormerWords{"--uncertified", "--certificate none"},
    FormerWords{"--free-run", "--pace none"},
    FormerWords{"--cpu", "taskset -c 0-N forceshade drive", ", whose loop takes the last of these processors"},
    FormerWords{"device list", "forceshade device"},
    FormerWords{"mesh info", "forceshade mesh check FILE"},
    FormerWords{"--self-intersecting", "", ": faces may cross in every mesh and scene"},
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

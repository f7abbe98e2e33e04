// SPDX-License-Identifier: BSD-3-Clause
#include "apps/command_line.h"

#include <array>

#include "apps/command.h"
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
    FormerWords{"laws --height-map", "forceshade laws --radius LENGTH --width LENGTH --theta-critical ANGLE",
                ", of the bump that comes nearest to the profile"},
    FormerWords{"figures", "forceshade plot thesis"},
    FormerWords{"positions", "forceshade conform positions"},
    FormerWords{"compare", "forceshade conform judge FILE"},
    FormerWords{"vectors", "forceshade conform positions --out FILE.json"},
    FormerWords{"conform vectors", "forceshade conform positions --out FILE.json"},
    FormerWords{"conform compare", "diff BEFORE.json AFTER.json", ", of what 'forceshade conform --json' wrote"},
    FormerWords{"conform --recording", "forceshade conform recording FILE"},
    FormerWords{"conform --simulator", "forceshade conform simulator --command COMMAND"},
    FormerWords{"conform --max-answer-time", "forceshade conform --timing SECONDS"},
    FormerWords{"certify --exhaustive", "forceshade certify plan --exhaustive"},
    FormerWords{"certify --sweeps", "forceshade certify plan --exhaustive LIST"},
    FormerWords{"certify --shards", "forceshade certify plan --units N"},
    FormerWords{"certify status", "forceshade certify merge PLAN"},
    FormerWords{"completion zsh", "forceshade completion bash", ", which zsh reads after compinit and bashcompinit"},
    FormerWords{"completion fish", "forceshade completion bash", ", for bash and zsh"},
    FormerWords{"energy --step", "forceshade force FILE", ", along a path: each row has the force of a tick"},
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

// An example or two of each command, for its help and its manual page. The files that they name are those of the folder
// examples/, or were written by an example before.
constexpr std::array kExamples{
    Example{"laws", "forceshade laws", "the laws, with the domain of each parameter"},
    Example{"laws", "forceshade laws --radius 600mil --width 1in --digits 20",
            "d, h, w', h' and theta of the smallest bump of the thesis, to 20 digits"},
    Example{"laws", "forceshade laws --radius 600mil --width 1in --theta-critical 11.4deg",
            "the number of shaded polygons that make this bump feel round"},
    Example{"force", "echo 'x_mm,y_mm,z_mm\n1,0,-0.5' | forceshade force --law bump-2p-shaded",
            "the force at one position, as a row of CSV"},
    Example{"force", "forceshade force positions.csv --height-map examples/groove.toml --out forces.npy",
            "those at the positions of a file, as an array for numpy.load"},
    Example{"energy", "forceshade energy --law bump-2p-shaded --depth 2mm",
            "the most energy that a loop can draw from the law"},
    Example{"plot", "forceshade plot --law bump-3p-shaded --out plots", "its four pictures, each as SVG and as PNG"},
    Example{"plot", "forceshade plot thesis --out figures", "figures of the thesis, with their numbers"},
    Example{"properties", "forceshade properties --law bump-2p", "the four properties of one law"},
    Example{"certify", "forceshade certify --out cert", "a certificate of all laws, with its page"},
    Example{"certify", "forceshade certify --law bump-2p,bump-3p --points 20000 --out short", "a short check of two laws"},
    Example{"certify plan", "forceshade certify plan --exhaustive --law all --out plan",
            "the full sweep, divided into units of work"},
    Example{"certify work", "forceshade certify work plan", "do units of it, on any machine that shares the folder"},
    Example{"certify merge", "forceshade certify merge plan --out whole", "the certificate of a plan"},
    Example{"certify merge", "forceshade certify merge plan", "the number of units of a plan that are done"},
    Example{"conform", "forceshade conform --law wall --command 'python3 examples/renderers/wall.py'",
            "a wall in Python beside the exact one"},
    Example{"conform", "forceshade conform --subject bump.toml --command ./mine --tolerance '4 ulp' --out mine.html",
            "a page with pictures of where its errors are"},
    Example{"conform positions", "forceshade conform positions --law bump-2p --points 20000 --out positions.csv",
            "positions at which to ask another renderer of this bump for its forces"},
    Example{"conform judge", "forceshade conform judge forces.csv --law bump-2p --tolerance '4 ulp'",
            "the forces that it gave there, beside the exact ones"},
    Example{"conform positions", "forceshade conform positions --law bump-2p --points 500 --out bump-2p.json",
            "positions with the exact forces, for the tests of another program"},
    Example{"conform recording",
            "forceshade conform recording examples/recordings/another_system.csv \\\n"
            "      --columns t=time_s,x=px,y=py,z=pz,fx=fx,fy=fy,fz=fz,m,mN",
            "the run of another system, without a subject"},
    Example{"conform simulator", "forceshade conform simulator --command 'python3 ball.py'",
            "a physics engine that is driven by forces"},
    Example{"drive",
            "forceshade drive --law bump-2p --certificate cert/certificate.json \\\n"
            "      --device simulated --seconds 5",
            "five seconds on a simulated PHANToM"},
    Example{"recording check", "forceshade recording check run.fsr",
            "its subject, its device and its certificate, and a check that it is whole"},
    Example{"recording check", "forceshade recording check run.fsr --law bump-2p", "every force of it, computed again"},
    Example{"recording export", "forceshade recording export run.fsr --out run.csv", "its ticks for other programs"},
    Example{"device", "forceshade device", "the devices that can be driven from here"},
    Example{"device check", "forceshade device check phantom", "calibration and rate of the default PHANToM, without force"},
    Example{"device try", "forceshade device try phantom", "its first force, at most 0.5 N, guided"},
    Example{"mesh check", "forceshade mesh check sphere.off --unit mm",
            "a check that a mesh can be rendered, and its size, edges and parts; if not, why"},
    Example{"mesh check", "forceshade mesh check examples/scenes/table.toml", "the same of a scene of several meshes"},
    Example{"mesh repair", "forceshade mesh repair scan.stl --unit mm --out mended.off", "a mesh that can be rendered"},
    Example{"mesh make", "forceshade mesh make icosphere --radius 50mm --out sphere.off", "a sphere of triangles"},
    Example{"man", "forceshade man force | man -l -", "the page of one command"},
    Example{"completion", "forceshade completion bash > ~/.local/share/bash-completion/completions/forceshade",
            "completion for one user of bash"}};

}  // namespace

int run_command_line(const std::vector<std::string>& arguments) {
  return run_program({.name = "forceshade",
                      .description = "Haptic force laws, correctly rounded in real time: evaluate, check, certify and drive.",
                      .commands = kCommands,
                      .examples = kExamples,
                      .former = kFormer},
                     arguments);
}

}  // namespace forceshade::apps

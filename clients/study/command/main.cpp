// SPDX-License-Identifier: BSD-3-Clause
// forceshade-study: the thesis's experiments with participants, and the analysis of their results.

#include <algorithm>
#include <array>

#include "apps/program.h"
#include "rendering/control_words.h"
#include "study/command/commands.h"

namespace forceshade::apps {
namespace {

constexpr std::array kCommands{Command{"experiment", add_experiment}, Command{"analyze", add_analyze}};

// The files that they name are those of the folder clients/study/examples, or were written by an example before.
constexpr std::array kExamples{
    Example{"experiment check", "forceshade-study experiment check clients/study/examples/matching.toml",
            "the faults of a protocol"},
    Example{"experiment prepare", "forceshade-study experiment prepare clients/study/examples/matching.toml --out certificates",
            "certificates of all bumps of a protocol"},
    Example{"experiment run",
            "forceshade-study experiment run clients/study/examples/matching.toml --participant P-01 \\\n"
            "      --session sessions/P-01 --device phantom --certificates certificates",
            "a session"},
    Example{"experiment resume",
            "forceshade-study experiment resume sessions/P-01 --device phantom --certificates certificates",
            "the rest of a session that was interrupted"},
    Example{"experiment virtual",
            "forceshade-study experiment virtual clients/study/examples/matching.toml --participants 5 \\\n"
            "      --out study --certificates certificates",
            "sessions of five participants that are programs"},
    Example{"experiment export", "forceshade-study experiment export sessions/* --csv results --bids data",
            "data for other programs"},
    Example{"analyze", "forceshade-study analyze sessions/* --out report", "tables and figures of the thesis from sessions"},
    Example{"experiment verify", "forceshade-study experiment verify sessions/P-01",
            "a check that every recording of it is whole"},
    Example{"experiment recompute", "forceshade-study experiment recompute sessions/P-01", "every force of it, computed again"},
    Example{"man", "forceshade-study man analyze | man -l -", "the page of one command"},
    Example{"completion", "forceshade-study completion bash > ~/.local/share/bash-completion/completions/forceshade-study",
            "completion for one user of bash"}};

}  // namespace
}  // namespace forceshade::apps

int main(int argc, char** argv) {
  using namespace forceshade;
  const ExactArithmetic with_all_bits;  // as in apps/main.cpp
  return apps::run_program(
      {.name = "forceshade-study",
       .description = "Experiments with participants who feel certified forces, and the analysis of their answers.",
       .commands = apps::kCommands,
       .examples = apps::kExamples},
      {argv + std::min(argc, 1), argv + argc});
}

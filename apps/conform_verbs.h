// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The verbs of conform.

#include <CLI/CLI.hpp>
#include <functional>

namespace forceshade::apps {

// One pipe: positions, to which a program adds its forces, which judge holds against the exact ones.
void add_conform_positions(CLI::App& conform, int& result);
void add_conform_judge(CLI::App& conform, int& result);

void add_conform_recording(CLI::App& conform, int& result);
void add_conform_simulator(CLI::App& conform, int& result);
void add_conform_compare(CLI::App& conform, int& result);

// --answer-timeout of a program that answers. keep gets the seconds; default: 10.
void add_answer_timeout(CLI::App& command, std::function<void(double)> keep);

}  // namespace forceshade::apps

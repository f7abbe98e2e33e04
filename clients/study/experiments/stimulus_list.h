// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// stimuli.jsonl of a run's ticks: one line of JSON for each stimulus that the servo loop was offered, written before the offer.

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "study/experiments/protocol.h"

namespace forceshade::experiments {

// The bump that was felt on one side.
struct ListedBump {
  std::string stimulus;            // as the protocol names it
  Mil radius = 0;                  // 0 for a stimulus of one shape
  std::array<float, 3> origin{};   // mm, of its middle in the device's frame
  std::string subject;             // JSON: what identifies the renderer
  std::string certificate;         // its name
  std::string certificate_digest;  // "none" where it was rendered without one

  friend bool operator==(const ListedBump&, const ListedBump&) = default;
};

struct ListedStimulus {
  std::uint32_t number = 0;  // `shown` in the ticks, from 1
  float seam = 0;            // mm: the left bump is felt where x is smaller
  std::optional<ListedBump> left, right;

  friend bool operator==(const ListedStimulus&, const ListedStimulus&) = default;
};

// The line of a stimulus, with its line feed.
std::string line_of(const ListedStimulus& stimulus);

// Line by line. A last line without a line feed was cut short by a crash, and its stimulus was never offered: it is left out.
// Throws Error with file and line for every other line that is not what line_of() writes, and for a number out of order.
std::vector<ListedStimulus> read_stimuli(const std::filesystem::path& file);

}  // namespace forceshade::experiments

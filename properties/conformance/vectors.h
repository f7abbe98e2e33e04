// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Test vectors: positions with the exact forces, for projects that test themselves with nothing of this one
// (docs/conformance.md).

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "forceshade/checks.h"
#include "forceshade/damping.h"
#include "forceshade/description.h"
#include "forceshade/properties.h"

namespace forceshade::conformance {

// The number of positions of a path of a mesh in vectors.
inline constexpr std::uint64_t kVectorPath = 64;

// JSON, ended by a line: the subject with all of its numbers, and so many positions of its stream, in paths, each with the
// force as binary32 and in 40 digits, and a flag for what it is aimed at. Where the definition does not decide, or its
// god-object does not come to rest, the path ends. damping: behind the subject, in its ranges; then each position has its
// periods, and no digits, since its force is defined by a rounded one. Throws std::invalid_argument for what the exact side
// refuses, and Interrupted.
std::string vectors_of(const Description& description, std::uint64_t count, std::uint64_t seed, const Monitor& monitor = {},
                       const std::optional<damping::Parameters>& damping = {});

// Its numbers, as the keys of a renderer's hello; null is no limit.
nlohmann::ordered_json json_of(const damping::Parameters& parameters);

// The meaning of a flag, and threads on GitHub in which defects at such cases were reported: "dimforge/rapier#95".
struct Flag {
  std::string_view meaning;
  std::vector<std::string_view> threads = {};
};
Flag flag_of(properties::Aim aim);

}  // namespace forceshade::conformance

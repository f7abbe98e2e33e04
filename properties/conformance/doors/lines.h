// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The lines of docs/conformance-protocol.md that carry numbers.

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace forceshade::conformance {

// The beginnings of lines; a scene or a list of numbers follows, and the end of the object.
inline constexpr std::string_view kScene = R"({"forceshade":"conform 1","scene":)", kNewPath = R"({"reset":true,"positions":)",
                                  kPositions = R"({"positions":)", kAnswers = R"({"answers":)";

// The whole line without its end: the beginning, a list of texts of 24 hexadecimal digits, the list of periods if there are
// any, and the end of the object.
std::string line_of(std::string_view beginning, std::span<const Eigen::Vector3f> numbers,
                    std::span<const std::uint32_t> periods = {});

// The numbers in such a line, which may have spaces around each text; nothing for any other line. periods: where it is given,
// the line may have those, too.
std::optional<std::vector<Eigen::Vector3f>> numbers_in(std::string_view line, std::string_view beginning,
                                                       std::vector<std::uint32_t>* periods = nullptr);

// Three numbers of 24 hexadecimal digits; nothing for any other text.
std::optional<Eigen::Vector3f> numbers_of(std::string_view text);

}  // namespace forceshade::conformance

// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// How much must have been checked before a device is driven; certify checks as much by default.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "certificate/certificate.h"

namespace forceshade::properties {

inline constexpr std::uint64_t kCases = 2000;  // per property

// Points of a subject of this kind. The reference is slower for height maps than for laws.
constexpr std::uint64_t points_of_kind(std::string_view kind) {
  return kind == kLawKind ? 1000000 : 200000;
}

// Points of a certificate's spread over other parameters: a quarter as many as with the given ones, one at least.
constexpr std::uint64_t spread_points(std::uint64_t points) {
  return (points + 3) / 4;
}

// What a certificate, or its entry for one subject, is good for.
enum class Standing {
  sufficient,    // every check held, and drive accepts it for this build
  insufficient,  // every check held, but there is too little evidence to drive
  failed,
};
inline constexpr std::array<std::string_view, 3> kStandingNames{"sufficient", "insufficient", "failed"};

constexpr std::string_view name_of(Standing standing) {
  return kStandingNames[static_cast<std::size_t>(standing)];
}

struct Assessment {
  Standing standing = Standing::failed;
  std::string lacks = {};   // where insufficient: what is missing, in words; else empty
  std::string remedy = {};  // and what gathers it: a command, several with && between them, or words with one
};

Assessment assessed(const SubjectResult& subject);

// The worst of its subjects' and its sweeps'; of several subjects that lack evidence it names each. Sweeps alone, or some of
// their units alone, are insufficient.
Assessment assessed(const Certificate& certificate);

// What is too little for driving, in words: "the certificate has 1 point for wall; driving needs at least 1000000". Each aim
// must be reached, with the given parameters and in the spread, and each stage that a law can reach in one of them. Which
// stages another subject can reach depends on what it is made of: binary64 is all that is expected of it.
std::optional<std::string> lacking(const SubjectResult& subject);

}  // namespace forceshade::properties

// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The words that every part shares: which laws there are, what they are built from, what an answer can be. Types and names
// only; no formula, no constant, no tolerance lives here, because neither side of a comparison may take one from the other
// (CONTRIBUTING.md, "Rules").
//
//   const std::optional<LawId> law = law_named("bump-2p");  // none where there is no such law
//   const Parameters thesis{.radius = 15.24F, .width = 25.4F, .stiffness = 0.5F};  // mm, mm, N/mm
//   const std::string_view name = name_of(*law);
//
// fast::Law of fast.h renders a law, reference::Law of reference.h defines its force: both look whether the parameters are in
// their domain. The laws: docs/laws.md. The names are part of file formats and stay. All of these are values. Nothing throws
// but std::bad_alloc, from ParameterError::message().
//
// Not promised: that no law is added to LawId, behind the others.
//
// Source: Morgenbesser and Srinivasan, RLE Technical Report 606 (MIT, 1996), chapter 4.

#if __cplusplus < 202002L
#error "forceshade is in C++20: expected -std=c++20 or later"
#endif

#include <array>
#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace forceshade {

enum class LawId {
  wall,
  cylinder,
  bump_cylinder,
  bump_1p,
  bump_2p,
  bump_3p,
  bump_1p_shaded,
  bump_2p_shaded,
  bump_3p_shaded,
};

// `name` is what the command line, the certificate and every message print; `file` is the law's basename in each folder.
struct LawName {
  LawId id;
  std::string_view name;
  std::string_view file;
};

inline constexpr std::array<LawName, 9> kLaws{{
    {LawId::wall, "wall", "wall"},
    {LawId::cylinder, "cylinder", "cylinder"},
    {LawId::bump_cylinder, "bump-cylinder", "bump_cylinder"},
    {LawId::bump_1p, "bump-1p", "bump_1p"},
    {LawId::bump_2p, "bump-2p", "bump_2p"},
    {LawId::bump_3p, "bump-3p", "bump_3p"},
    {LawId::bump_1p_shaded, "bump-1p-shaded", "bump_1p_shaded"},
    {LawId::bump_2p_shaded, "bump-2p-shaded", "bump_2p_shaded"},
    {LawId::bump_3p_shaded, "bump-3p-shaded", "bump_3p_shaded"},
}};

constexpr std::string_view name_of(LawId id) {
  return kLaws[static_cast<std::size_t>(id)].name;
}

constexpr std::optional<LawId> law_named(std::string_view name) {
  for (const LawName& law : kLaws)
    if (law.name == name) return law.id;
  return std::nullopt;
}

// The parameters of a law; each binary32 number is the rational it represents. The wall has no use for radius and width.
struct Parameters {
  float radius = 0;     // R, mm
  float width = 0;      // w, mm: chord of the bump on the plane
  float stiffness = 0;  // K, N/mm

  friend bool operator==(const Parameters&, const Parameters&) = default;
};

// The reason why nothing was built: a parameter whose value is not in [low, high], or the arithmetic of this build or thread.
struct ParameterError {
  const char* parameter;  // "radius", "width" or "stiffness"; "law"; "arithmetic", whose fault has no value
  const char* unit;       // "mm", "N/mm" or ""
  float value;
  float low;
  float high;
  const char* arithmetic_fault = nullptr;  // of fast::arithmetic_fault(); null where a parameter is at fault
  const char* besides = nullptr;           // a value that is allowed outside the range, "0" or "inf"; null where there is none

  // A text for users: the parameter, its value and the range, or the fault. Allocates; not for the real-time path.
  std::string message() const {
    if (arithmetic_fault != nullptr)
      return std::string("found ") + arithmetic_fault + "; expected the arithmetic of IEEE 754, rounded to nearest";
    // The shortest that reads back as the same number, without an exponent where a person would write none.
    const auto shortest = [](float number) {
      const bool is_plain = number == 0 || (number >= 1e-5F && number < 1e9F) || (number <= -1e-5F && number > -1e9F);
      char text[32];
      char* const end =
          std::to_chars(text, text + sizeof text, number, is_plain ? std::chars_format::fixed : std::chars_format::scientific)
              .ptr;
      return std::string(text, end);
    };
    const std::string in_unit = *unit == '\0' ? "" : std::string(" ") + unit;
    return std::string(parameter) + " is " + shortest(value) + in_unit + "; expected " +
           (besides == nullptr ? "" : std::string(besides) + ", or ") + shortest(low) + " to " + shortest(high) + in_unit;
  }
};

constexpr bool has_bump_geometry(LawId id) {
  return id != LawId::wall;
}

// free: a valid position that feels no force. invalid: a coordinate that is NaN or outside the domain; force zero. unfinished:
// a contact whose god-object used up the moves or looks of one tick; the force is that of the point which it has come to, and
// the next tick goes on from there. The numbers are those of the C interface.
enum class Status : std::uint8_t { free, contact, invalid, unfinished };

// A contact for one that is unfinished, and else the status itself.
constexpr Status finished(Status status) noexcept {
  return status == Status::unfinished ? Status::contact : status;
}

}  // namespace forceshade

// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Certificates: what certify found, as it is written to certificate.json (certificate/schema.md) and read again by
// drive; and whether it is enough to drive a device. The library is forceshade::certificate, of the component run; it links
// nothing of the exact side, and makes no certificate: certify.h does.
//
//   const std::string file = "certificate.json";
//   const auto certificate = properties::from_json(properties::read_certificate(file), file);
//   const Identity bump = identity_of(LawId::bump_2p, {15.24F, 25.4F, 0.5F});  // mm, mm, N/mm
//   const auto why_not = properties::refusal(certificate, properties::current_build(), bump);
//   std::puts(why_not ? why_not->c_str() : "may be driven");
//
// Errors: a file that is no certificate is a thrown Error, which names the file, the key, its value and what was
// expected.
//
// Threads: all of these are values, and the functions keep no state.
//
// Not promised: protection against forgery (docs/certificate.md). Schemas from kOldestCertificateSchema on are read.

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "forceshade/checks.h"
#include "forceshade/error.h"
#include "forceshade/identity.h"
#include "forceshade/law.h"

namespace forceshade::properties {

// Exhaustive sweeps: every binary32 of one coordinate, at one value of the other.
//
// direction: every x of the bump on z = -1 mm, where the force of a flat shaded law is K times its direction.
// height: every x of the bump, where the highest position in contact and the lowest free one must be distinguished; for a law
//   whose surface is flat, every z on x = 0.
// line: every x on a chosen z. column: every z on a chosen x.
enum class SweepKind { direction, height, line, column };
inline constexpr std::array<std::string_view, 4> kSweepKinds{"direction", "height", "line", "column"};

struct Sweep {
  LawId law = LawId::wall;
  Parameters parameters;
  SweepKind kind = SweepKind::direction;
  float at = 0;  // mm: the coordinate that is fixed; 0 for the heights of a curved surface

  friend bool operator==(const Sweep&, const Sweep&) = default;
};

struct SweepResult {
  Sweep sweep;
  std::uint64_t inputs = 0, mismatches = 0;
};

// A sweep is done in units: 2^22 bit patterns, each with both signs.
inline constexpr std::uint32_t kUnitBits = 22;
inline constexpr std::uint64_t kUnitsPerSweep = std::uint64_t{1} << (31 - kUnitBits);

// Some or all units of a list of sweeps, in order: sweep by sweep, small magnitudes first.
struct Sweeps {
  std::uint64_t first = 0, end = 0;          // units to do
  std::uint64_t next = 0;                    // units from first to next are done
  double seconds = 0;                        // spent on them
  std::array<std::uint64_t, 3> stages{};     // inputs that the fast path decided in binary64, double-double, wide
  std::vector<SweepResult> results;          // of all sweeps, also of those that have no unit here
  std::vector<std::string> counterexamples;  // the first few

  std::uint64_t units() const { return kUnitsPerSweep * results.size(); }
  bool is_finished() const { return next == end; }
  bool is_whole() const { return is_finished() && first == 0 && end == units(); }
  std::uint64_t inputs() const { return sum(&SweepResult::inputs); }
  std::uint64_t mismatches() const { return sum(&SweepResult::mismatches); }

 private:
  std::uint64_t sum(std::uint64_t SweepResult::*count) const {
    std::uint64_t total = 0;
    for (const SweepResult& result : results) total += result.*count;
    return total;
  }
};

inline constexpr int kCertificateSchema = 8;
inline constexpr int kOldestCertificateSchema = 6;  // that is still read

// The build that was checked, and no other.
struct Build {
  std::string version;   // of the library
  std::string revision;  // git commit, "+" if the tree was changed; "unknown" outside git
  std::string compiler;
  std::string flags;
  std::string instruction_set;  // the widest that this machine has: what single and batch calls use
  std::string library_digest;   // SHA-256 of the compiled real-time library

  friend bool operator==(const Build&, const Build&) = default;
};

// The sources and tools that this program was built from.
Build current_build();

// The point whose exact force came closest to a rounding tie without being one.
struct ClosestCall {
  float x = 0, y = 0, z = 0;  // mm
  double ulps_from_tie = 1;   // units in the last place of the binary32 result
};

inline constexpr std::size_t kCounterexamples = 10;  // that are kept of one comparison, at most

// Positions at which every call of the fast path was compared with the reference.
struct Comparison {
  using Counts = std::map<std::string, std::uint64_t>;

  std::uint64_t points = 0;
  std::uint64_t mismatches = 0;              // points at which a call differs, or which the reference could not decide
  Counts points_by_instruction_set;          // whose code was compared there: all points or, where it is missing, none
  Counts points_by_aim;                      // by the way in which positions were chosen
  Counts points_by_stage;                    // by the stage of the fast path that decided
  Counts points_by_method;                   // by the method that made the reference certain
  Counts points_by_status;                   // free, contact, invalid
  std::vector<std::string> counterexamples;  // the first mismatches

  // True if this set's code was compared at every point.
  bool covers(const std::string& instruction_set) const;
};

// The same subject with other parameters, drawn from the domain: the given ones may make every product exact, and
// then test no rounding.
struct Spread : Comparison {
  std::uint64_t parameter_sets = 0;
};

// The results for one subject.
struct Findings : Comparison {
  std::vector<std::string> jumps = {};  // the places where the force jumps, in words
  bool conservative = false;
  ClosestCall closest_call = {};
  std::vector<PropertyResult> properties = {};
  std::vector<LoopEnergy> energy = {};
  Spread spread = {};

  bool held() const;
  bool has_held(std::string_view property) const;
};

// The owner of the renderer that was compared: the library, whose renderer is the one that is driven, or a program that made
// its own. It is unknown of a certificate of an earlier schema.
enum class RenderedBy { unknown, program, library };
inline constexpr std::array<std::string_view, 3> kRenderedByNames{"unknown", "program", "library"};

// A subject and its findings.
struct SubjectResult : Findings {
  Identity identity;
  std::vector<std::string> parts = {};    // of a height map, in words
  bool unit_directions = false;           // true if its directions are unit vectors, as far as "unit normals" held
  std::vector<std::uint64_t> seeds = {};  // of its points and cases, ascending: several where certificates were merged
  // The certified subject in the words of the command, as a subject file that means the same again (docs/subjects.md); empty
  // for a subject of a program's own. For the reader only; not part of the certified identity.
  std::string subject_file = {};
  // The options of forceshade certify that name it, as a shell reads them; empty for a law, and where it was read from a file,
  // which does not keep where a mesh or height map lies.
  std::string options = {};
  RenderedBy rendered_by = RenderedBy::unknown;

  const std::string& name() const { return identity.name; }
};

struct Certificate {
  Build build;
  double seconds = 0;
  std::vector<SubjectResult> subjects;  // checked by points and properties
  Sweeps sweeps;                        // checked exhaustively; without results where nothing was
  std::string date = {};                // the time of its end, UTC: 2026-01-31T23:59:59Z
  std::string processor = {};           // that it was made on, as the processor calls itself

  bool held() const;
  std::vector<std::uint64_t> seeds() const;  // of all subjects, ascending
};

// "1, 2 and 7".
std::string in_words(const std::vector<std::uint64_t>& seeds);

// Throws Error, naming the key, where a number is not finite: JSON has none such.
std::string to_json(const Certificate& certificate);

// The results without date, processor and duration: identical for identical input, with however many processes.
// missing: the work that is not done, in words; empty where all of it is. Throws as to_json() does.
std::string evidence_of(const Certificate& certificate, const std::string& missing = "");

// Strict: what is missing, unknown, twice there, of another type, out of its range, or contradicts the rest is refused with a
// Error. This protects against mistakes, not against forgery (docs/certificate.md).
Certificate from_json(const std::string& text, const std::string& file);

// The text of a certificate's file. Throws Error, with the system's reason, where it cannot be read, is empty, or is
// larger than a certificate can be.
std::string read_certificate(const std::string& file);

// The reason why `build` may not drive this subject; empty if it may. Needed of `certificate`: docs/certificate.md, "What
// drive refuses".
std::optional<std::string> refusal(const Certificate& certificate, const Build& build, const Identity& subject);

// The least that must have been checked before a device is driven; certify checks as much by default.

inline constexpr std::uint64_t kCases = 2000;  // per property

// Points of a subject of this kind. The reference is slower for height maps than for laws.
constexpr std::uint64_t points_of_kind(std::string_view kind) {
  return kind == kLawKind ? 1000000 : 200000;
}

// Points of a certificate's spread over other parameters: a quarter as many as with the given ones, one at least.
constexpr std::uint64_t spread_points(std::uint64_t points) {
  return (points + 3) / 4;
}

// The standing of a certificate, or of its entry for one subject.
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
  std::string lacks = {};   // the missing evidence, in words, if insufficient; else empty
  std::string remedy = {};  // and what gathers it: a command, several with && between them, or words with one
};

Assessment assessed(const SubjectResult& subject);

// The worst of its subjects' and its sweeps'; of several subjects that lack evidence it names each. An entry that lacks
// evidence does not count beside a sufficient one of the same subject. Sweeps alone, or some of their units alone, are
// insufficient.
Assessment assessed(const Certificate& certificate);

// The reasons why it does not permit driving: "the certificate has 1 point for wall; driving needs at least 1000000". What was
// compared must be the library's renderer, if the kind is one that the library renders. Each aim must be reached, with the
// given parameters and in the spread, and each stage that a law can reach in one of them. The stages that another subject can
// reach depend on what it is made of: only binary64 is expected of it.
std::optional<std::string> lacking(const SubjectResult& subject);

}  // namespace forceshade::properties

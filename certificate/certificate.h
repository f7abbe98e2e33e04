// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What certify found, as it is written to certificate.json (certificate/schema.md) and read again by drive.

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "certificate/sweep.h"
#include "rendering/breakdown.h"
#include "rendering/identity/identity.h"
#include "rendering/law.h"
#include "rendering/results.h"

namespace forceshade::properties {

inline constexpr int kCertificateSchema = 7;
inline constexpr int kOldestCertificateSchema = 6;  // that is still read

// What was checked is this build and no other.
struct Build {
  std::string version;   // of the library
  std::string revision;  // git commit, "+" if the tree was changed; "unknown" outside git
  std::string compiler;
  std::string flags;
  std::string instruction_set;  // the widest that this machine has: what single and batch calls use
  std::string library_digest;   // SHA-256 of the compiled real-time library

  friend bool operator==(const Build&, const Build&) = default;
};

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
  Counts points_by_aim;                      // how positions were chosen
  Counts points_by_stage;                    // which stage of the fast path decided
  Counts points_by_method;                   // what the reference needed to be certain
  Counts points_by_status;                   // free, contact, invalid
  std::vector<std::string> counterexamples;  // the first mismatches

  // Whether this set's code was compared at every point.
  bool covers(const std::string& instruction_set) const;
};

// The same subject with other parameters, drawn from the domain: the given ones may make every product exact, and
// then test no rounding.
struct Spread : Comparison {
  std::uint64_t parameter_sets = 0;
};

// What was found out about a subject.
struct Findings : Comparison {
  std::vector<std::string> jumps = {};  // where the force jumps, in words
  bool conservative = false;
  ClosestCall closest_call = {};
  std::vector<PropertyResult> properties = {};
  std::vector<LoopEnergy> energy = {};
  Spread spread = {};

  bool held() const;
  bool has_held(std::string_view property) const;
};

// A subject and its findings.
struct SubjectResult : Findings {
  Identity identity;
  std::vector<std::string> parts = {};    // of a height map, in words
  bool unit_directions = false;           // whether its directions are unit vectors, as far as "unit normals" held
  std::vector<std::uint64_t> seeds = {};  // of its points and cases, ascending: several where certificates were merged
  // What was certified in the words of the command, as a subject file that means the same again (docs/subjects.md); empty where
  // a program certified a subject of its own. No claim hangs on it.
  std::string subject_file = {};
  // The options of forceshade certify that name it, as a shell reads them; empty for a law, and where it was read from a file,
  // which does not keep where a mesh or height map lies.
  std::string options = {};

  const std::string& name() const { return identity.name; }
};

struct Certificate {
  Build build;
  double seconds = 0;
  std::vector<SubjectResult> subjects;  // checked by points and properties
  Sweeps sweeps;                        // checked exhaustively; without results where nothing was
  std::string date = {};                // when it was finished, UTC: 2026-01-31T23:59:59Z
  std::string processor = {};           // that it was made on, as the processor calls itself

  bool held() const;
  std::vector<std::uint64_t> seeds() const;  // of all subjects, ascending
};

// "1, 2 and 7".
std::string in_words(const std::vector<std::uint64_t>& seeds);

// Names the file, the key, its value and what was expected.
struct CertificateError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Throws CertificateError, naming the key, where a number is not finite: JSON has none such.
std::string to_json(const Certificate& certificate);

// Strict: what is missing, unknown, twice there, of another type, out of its range, or contradicts the rest is refused with a
// CertificateError. This protects against mistakes, not against forgery (docs/certificate.md).
Certificate from_json(const std::string& text, const std::string& file);

// The text of a certificate's file. Throws CertificateError, with the system's reason, where it cannot be read, is empty, or is
// larger than a certificate can be.
std::string read_certificate(const std::string& file);

// Why `certificate` does not let `build` drive this subject; empty if it does. What it must have: docs/certificate.md, "What
// drive refuses".
std::optional<std::string> refusal(const Certificate& certificate, const Build& build, const Identity& subject);

}  // namespace forceshade::properties

// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/certify.h"

#include <algorithm>
#include <chrono>
#include <stdexcept>

#include "certificate/build.h"
#include "certificate/compare.h"
#include "certificate/in_parallel.h"
#include "files/printable.h"
#include "forceshade/certificate.h"
#include "forceshade/fast.h"
#include "forceshade/properties.h"
#include "reference/height_energy.h"
#include "rendering/breakdown.h"

namespace forceshade::properties {
namespace {

constexpr std::uint64_t kChunk = 4096;  // points from one stream, one path

using Done = std::function<void(double)>;

// What one certificate's checks have in common.
struct Run {
  const CertifyOptions& options;
  const std::atomic<bool>& stop;

  // An odd multiple from the golden ratio separates the streams: no two chunks or seeds in reach share one.
  std::uint64_t stream(std::uint64_t chunk) const { return (options.seed + 1) * 0x9E3779B97F4A7C15U + chunk; }
  // The stream of the spread is as far from those as can be.
  std::uint64_t spread_stream(std::uint64_t chunk) const { return stream(chunk) ^ 0x8000000000000000U; }

  Tally in_parallel(std::uint64_t chunks, const Done& done, const std::function<void(std::uint64_t, Tally&)>& work) const {
    return properties::in_parallel(chunks, options.threads, done, stop, work);
  }

  // `subject` outlives what is returned.
  OnCase on_case(const std::string& subject) const {
    if (!options.on_case) return {};
    return [this, &subject](const std::string& property, double done) { options.on_case(subject, property, done); };
  }

  Findings at_points(const Subject& subject, const Done& done) const {
    const std::uint64_t chunks = (options.points + kChunk - 1) / kChunk;
    const Tally tally = in_parallel(chunks, done, [&](std::uint64_t chunk, Tally& mine) {
      compare_chunk(subject, stream(chunk), std::min(kChunk, options.points - chunk * kChunk), chunk, "", mine);
    });
    Findings found{tally.comparison()};
    found.closest_call = tally.closest_call;
    return found;
  }

  // With drawn parameters.
  Spread spread(const Subject& subject, const Done& done) const {
    const std::uint64_t points = spread_points(options.points), size = subject.points_of_a_set(points);
    const std::uint64_t sets = (points + size - 1) / size;
    const Tally tally = in_parallel(sets, done, [&](std::uint64_t set, Tally& mine) {
      const std::uint64_t seed = spread_stream(set);
      const DrawnSubject drawn = subject.with_drawn_parameters(seed);
      compare_chunk(*drawn.subject, seed, std::min(size, points - set * size), set, drawn.parameters, mine);
    });
    return {tally.comparison(), sets};
  }
};

// The points with the given parameters are 0.8 of the progress, those of the spread 0.2: the shares of their numbers.
Done first_part(const Done& done) {
  return [&done](double part) { done(0.8 * part); };
}
Done second_part(const Done& done) {
  return [&done](double part) { done(0.8 + 0.2 * part); };
}

// Puts the energies into the findings. Where they are not enclosed, or the renderer throws, no number is: passivity has failed,
// and its counterexample says why.
void add_energies(const Subject& subject, const Monitor& monitor, Findings& findings) {
  const auto fail = [&](const std::string& why) {
    for (PropertyResult& property : findings.properties) {
      if (property.name != "passivity") continue;
      property.held = false;
      property.counterexample += (property.counterexample.empty() ? "" : "; ") + why;
    }
  };
  try {
    findings.energy = subject.energies(monitor);
  } catch (const reference::NotEnclosed& error) {
    fail(std::string("the energy that a loop can give is ") + error.what());
  } catch (const RendererThrew& error) {
    fail(error.what());
  } catch (const Interrupted&) {  // `stop` is set, and nothing is certified
  }
}

SubjectResult checked(const Subject& subject, const Run& run, const Done& done) {
  const CertifyOptions& options = run.options;
  SubjectResult result{run.at_points(subject, first_part(done)), subject.identity(), subject.parts()};
  result.seeds = {options.seed};
  result.identity.name = files::printable(result.identity.name);
  result.spread = run.spread(subject, second_part(done));
  if (run.stop) return result;
  for (PropertyResult& property :
       run_properties(subject, options.cases, options.seed, nullptr, run.on_case(subject.identity().name), &run.stop))
    if (std::find(kPropertyNames.begin(), kPropertyNames.end(), property.name) != kPropertyNames.end())
      result.properties.push_back(std::move(property));
  const Expected expected = subject.expected();
  result.jumps = expected.jumps;
  result.conservative = expected.is_conservative;
  result.unit_directions = expected.has_unit_directions && result.has_held("unit normals");
  if (run.stop) return result;
  // done() counts the points up to 1; certify() makes nine tenths of that, and the loops are the tenth that is left.
  add_energies(subject, Monitor([&](double share) { done(1 + share / 9); }, run.stop), result);
  return result;
}

}  // namespace

std::optional<Certificate> certify(const CertifyOptions& options, const Progress& progress, const std::atomic<bool>& stop) {
  if (const char* fault = fast::arithmetic_fault()) throw std::runtime_error(std::string("nothing can be certified: ") + fault);
  const auto start = std::chrono::steady_clock::now();
  Certificate certificate{current_build(), 0, {}, {}};
  certificate.processor = processor_name();
  const auto all = static_cast<double>(options.subjects.size());
  double before = 0;
  for (const auto& subject : options.subjects) {
    if (stop) break;
    const Run run{options, stop};
    const std::string& name = subject->identity().name;
    // The points are most of the work; the properties and loops that follow are counted as a tenth of it.
    certificate.subjects.push_back(checked(*subject, run, [&](double done) { progress(name, (before + 0.9 * done) / all); }));
    progress(name, ++before / all);
  }
  if (stop) return std::nullopt;
  certificate.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  certificate.date = utc_now();
  return certificate;
}

}  // namespace forceshade::properties

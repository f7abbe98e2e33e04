// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/certify.h"

#include <array>
#include <chrono>
#include <stdexcept>

#include "certificate/build.h"
#include "certificate/in_parallel.h"
#include "certificate/work.h"
#include "forceshade/certificate.h"
#include "forceshade/fast.h"
#include "rendering/control_words.h"
#include "system/system.h"

namespace forceshade::properties {
namespace {

using Done = std::function<void(double)>;

// The points with the given parameters are 0.8 of the progress, those of the spread 0.2: the shares of their numbers.
Done first_part(const Done& done) {
  return [&done](double part) { done(0.8 * part); };
}
Done second_part(const Done& done) {
  return [&done](double part) { done(0.8 + 0.2 * part); };
}

// The units of one subject: one kind after the other, and those of a kind shared out among the threads. Nothing where `stop` is
// set before the end.
std::optional<SubjectResult> checked(const CertifyOptions& options, std::size_t of, const Done& done,
                                     const std::atomic<bool>& stop) {
  const Sweeps none;
  const DividedWork work(options, none);
  const Subject& subject = *options.subjects[of];
  std::array<Found, 4> found;
  const auto counted = [&](ItemKind kind, const Done& progress) {
    const Item item = work.item(kind, of);
    found[static_cast<std::size_t>(kind)].tally = in_parallel(
        item.parts, options.threads, progress, stop, [&](std::uint64_t part, Tally& mine) { work.count(item, part, mine); });
  };
  counted(ItemKind::points, first_part(done));
  counted(ItemKind::spread, second_part(done));
  if (stop) return std::nullopt;
  OnCase on_case;
  if (options.on_case)
    on_case = [&](const std::string& property, double share) { options.on_case(subject.identity().name, property, share); };
  found[2].properties = work.properties(of, on_case, stop);
  if (stop) return std::nullopt;
  // done() counts the points up to 1; certify() makes nine tenths of that, and the loops are the tenth that is left.
  found[3].energies = work.energies(of, Monitor([&](double share) { done(1 + share / 9); }, stop));
  return result_of(subject, options.seed, found, work.item(ItemKind::spread, of).parts);
}

}  // namespace

std::optional<Certificate> certify(const CertifyOptions& options, const Progress& progress, const std::atomic<bool>& stop) {
  const ExactArithmetic with_all_bits;
  if (const char* fault = fast::arithmetic_fault()) throw std::runtime_error(std::string("nothing can be certified: ") + fault);
  const auto start = std::chrono::steady_clock::now();
  Certificate certificate{current_build(), 0, {}, {}};
  certificate.processor = processor_name();
  const auto all = static_cast<double>(options.subjects.size());
  double before = 0;
  for (std::size_t of = 0; of < options.subjects.size() && !stop; ++of) {
    const std::string& name = options.subjects[of]->identity().name;
    // The points are most of the work; the properties and loops that follow are counted as a tenth of it.
    auto result = checked(
        options, of, [&](double done) { progress(name, (before + 0.9 * done) / all); }, stop);
    if (result) certificate.subjects.push_back(std::move(*result));
    progress(name, ++before / all);
  }
  if (stop) return std::nullopt;
  certificate.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  certificate.date = system::date();
  return certificate;
}

}  // namespace forceshade::properties

// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Every call of a subject's renderer against its reference.

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "certificate/tally.h"
#include "forceshade/properties.h"
#include "properties/binary32.h"
#include "properties/field_properties.h"
#include "properties/second_answer.h"

namespace forceshade::properties {

// The next `count` positions of a source, one path through the subject, each with what the reference says of it. A position is
// wrong for the first of its calls that is.
class Chunk {
 public:
  Chunk(const Subject& subject, Positions& source, std::uint64_t count, Tally& tally) : renderer_(subject.renderer()) {
    const auto session = renderer_.open();
    const auto reference = subject.open_reference();
    positions_.reserve(count);
    exact_.reserve(count);
    for (std::uint64_t i = 0; i < count; ++i) {
      const Aimed aimed = source.next();
      positions_.push_back(aimed.position);
      const fast::Evaluation answer = session->step(aimed.position);
      ++tally.aims[static_cast<std::size_t>(aimed.aim)];
      ++tally.stages[static_cast<std::size_t>(answer.stage)];
      exact_.push_back(rounded(*reference, answer, i));
      const reference::Rounded& exact = exact_.back();
      ++tally.methods[static_cast<std::size_t>(exact.method)];
      ++tally.statuses[static_cast<std::size_t>(finished(exact.status))];
      const Eigen::Vector3f& at = aimed.position;
      if (finished(exact.status) == Status::contact && exact.ulps_from_tie > 0)
        tally.call({at.x(), at.y(), at.z(), static_cast<double>(exact.ulps_from_tie)});
      if (const auto what = exception_of(*session)) fault(i, RendererThrew(at, *what).what());
      if (auto words = difference(at, {answer.force, answer.status}, exact)) fault(i, explained(subject, answer, *words));
    }
    tally.points += count;
  }

  // Compares the code of each instruction set that this machine has: all positions at once, and one by one where that is other
  // code. A renderer without a batch call has no code of its own in any set: its single call stands for all of them.
  void compare_sets(Tally& tally) {
    for (const fast::InstructionSet set : fast::kInstructionSets) {
      if (!fast::is_available(set)) continue;
      if (renderer_.batch) compare(set, positions_.size(), "the batch call (");
      if (renderer_.single_depends_on_set) compare(set, 1, "the single call (");
      tally.sets[static_cast<std::size_t>(set)] += positions_.size();
    }
  }

  // number: of the chunk; who: put before the words.
  void count_mismatches(std::uint64_t number, const std::string& who, Tally& tally) {
    for (const auto& [i, words] : wrong_) tally.mismatch(number, who + words);
  }

 private:
  // The words for a wrong answer at the last position so far: those of its cause, for the first in this chunk.
  std::string explained(const Subject& subject, const fast::Evaluation& answer, const std::string& words) {
    if (std::exchange(is_explained_, true)) return words;
    try {
      return inconsistency(subject, positions_, {answer.force, answer.status}, exact_.back()).value_or(words);
    } catch (const RendererThrew& error) {
      return words + "; " + error.what();
    }
  }

  // A position that the reference does not decide is a fault, and the answer stands for the unknown force.
  reference::Rounded rounded(ReferenceSession& reference, const fast::Evaluation& answer, std::uint64_t i) {
    try {
      return reference.step(positions_[i]);
    } catch (const std::domain_error& error) {
      fault(i, not_decided(positions_[i], error));
      reference::Rounded unknown{answer.force, answer.status};
      unknown.method = reference::Method::exact;
      return unknown;
    }
  }

  // size: of each batch.
  void compare(fast::InstructionSet set, std::size_t size, const char* call) {
    const std::string who = call + std::string(name_of(set)) + ")";
    std::vector<Eigen::Vector3f> forces(size);
    for (std::size_t begin = 0; begin < positions_.size(); begin += size) {
      // A force that a call leaves unwritten must not pass for that of the call before.
      std::fill(forces.begin(), forces.end(), Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN()));
      fast::BatchResult result;
      try {
        result = renderer_.batch(std::span(positions_).subspan(begin, size), forces, set);
      } catch (...) {
        fault(begin, who + " of " + std::to_string(size) + " positions from " + show(positions_[begin]) +
                         " mm on throws: " + current_exception_words());
        continue;
      }
      std::size_t invalid = 0;
      for (std::size_t i = 0; i < size; ++i) {
        const reference::Rounded& exact = exact_[begin + i];
        invalid += exact.status == Status::invalid;
        if (auto words = difference(positions_[begin + i], {forces[i], exact.status}, exact))
          fault(begin + i, who + ": " + *words);
      }
      if (result.invalid != invalid)
        fault(begin, who + " counts " + std::to_string(result.invalid) + " invalid positions of " + std::to_string(size) +
                         "; expected " + std::to_string(invalid));
    }
  }

  void fault(std::size_t i, std::string words) { wrong_.try_emplace(i, std::move(words)); }

  const Renderer& renderer_;
  std::vector<Eigen::Vector3f> positions_;
  std::vector<reference::Rounded> exact_;
  std::map<std::size_t, std::string> wrong_;  // of a position: the first of its faults
  bool is_explained_ = false;
};

// Compares `count` positions of the subject's stream of this seed, in chunk `number`.
inline void compare_chunk(const Subject& subject, std::uint64_t seed, std::uint64_t count, std::uint64_t number,
                          const std::string& who, Tally& tally) {
  const auto source = subject.positions(seed);
  Chunk chunk(subject, *source, count, tally);
  chunk.compare_sets(tally);
  chunk.count_mismatches(number, who, tally);
}

}  // namespace forceshade::properties

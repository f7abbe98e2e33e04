// SPDX-License-Identifier: BSD-3-Clause
#include "properties/second_answer.h"

#include <stdexcept>

#include "properties/binary32.h"
#include "rendering/breakdown.h"

namespace forceshade::properties {
namespace {

// A renderer that is wrong by chance in nine of ten answers is seen to be so with a probability of 1 - 0.9^8, more than a half,
// in one case, and cases are many.
constexpr int kRepetitions = 8;

using Path = std::span<const Eigen::Vector3f>;

Rendered last_answer(const Subject& subject, Path path) {
  const auto session = subject.renderer().open();
  Rendered answer;
  for (const Eigen::Vector3f& position : path) answer = answer_of(*session, position);
  return answer;
}

bool is_same(const Eigen::Vector3f& force, Status status, const Eigen::Vector3f& other, Status its) {
  return same_bits(force.x(), other.x()) && same_bits(force.y(), other.y()) && same_bits(force.z(), other.z()) &&
         finished(status) == finished(its);
}

bool is_same(const Rendered& a, const Rendered& b) {
  return is_same(a.force, a.status, b.force, b.status);
}

std::string words_of(const Rendered& answer) {
  return show(answer.force) + " N (" + std::string(kStatusNames[static_cast<std::size_t>(finished(answer.status))]) + ")";
}

// "the first position of a session" or "after ...".
std::string place_in(Path path) {
  if (path.size() == 1) return "as the first position of a session";
  const std::string before = show(path[path.size() - 2]) + " mm";
  return path.size() == 2 ? "after " + before : "after " + std::to_string(path.size() - 1) + " positions, the last " + before;
}

}  // namespace

Violation second_answer(const Subject& subject, Path path, const Rendered& answer) {
  for (int i = 0; i < kRepetitions; ++i) {
    // More and more steps in between, since a renderer that counts its calls may answer the same after as many as the path has.
    for (int k = 0; k < i; ++k) last_answer(subject, path.first(1));
    const Rendered again = last_answer(subject, path);
    if (is_same(again, answer)) continue;
    return "at " + show(path.back()) + " mm the renderer gives two answers for one input, " + place_in(path) + ": first " +
           words_of(answer) + ", then " + words_of(again) + "; it is random, or its sessions share state";
  }
  return std::nullopt;
}

Violation undeclared_memory(const Subject& subject, Path path, const Rendered& answer, const reference::Rounded& exact) {
  const Path alone = path.last(1);
  const Rendered first = last_answer(subject, alone);
  if (is_same(first, answer)) return std::nullopt;
  try {
    const reference::Rounded its_first = subject.open_reference()->step(alone[0]);
    if (!is_same(exact.force, exact.status, its_first.force, its_first.status)) return std::nullopt;
  } catch (const std::domain_error&) {  // what the definition does there is not known
    return std::nullopt;
  }
  const Path last_two = path.last(2);
  const bool remembers_one = is_same(last_answer(subject, last_two), answer);
  return "at " + show(path.back()) + " mm the renderer gives two answers: " + words_of(answer) + " " +
         place_in(remembers_one ? last_two : path) + ", and " + words_of(first) + " " + place_in(alone) +
         "; the exact force there is the same, so the renderer keeps state that its definition does not have";
}

Violation inconsistency(const Subject& subject, Path path, const Rendered& answer, const reference::Rounded& exact) {
  if (auto words = second_answer(subject, path, answer)) return words;
  return undeclared_memory(subject, path, answer, exact);
}

}  // namespace forceshade::properties

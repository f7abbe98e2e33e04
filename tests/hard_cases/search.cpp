// SPDX-License-Identifier: BSD-3-Clause
// Searches for the hardest inputs of a law and prints them as its case file:
//
//   ninja -C build/release hard_cases_search && build/release/tests/hard_cases_search bump-2p > tests/laws/bump_2p.cases
//
// Two methods: sweep.h (any position, all stiffnesses at once) and beside_tie.h (very near F_z). The worth of each kept
// candidate to the stages goes to standard error; the force and the distance in the file are the reference's.

#include <cstdio>
#include <cstdlib>

#include "beside_tie.h"
#include "fast/laws/all.h"
#include "properties/positions.h"
#include "sweep.h"
#include "tests/laws/cases.h"

namespace forceshade::tests {
namespace {

// p² + r² = q²: at such angles the geometry of a bump is rational and forces can be ties.
struct Triple {
  int p, r, q;
};
constexpr std::array<Triple, 8> kTriples{
    {{3, 4, 5}, {4, 3, 5}, {5, 12, 13}, {12, 5, 13}, {8, 15, 17}, {7, 24, 25}, {20, 21, 29}, {15, 8, 17}}};

// The thesis's five bumps (600 to 1400 mil, 1 in), bumps of every size, and rational ones.
class Bumps {
 public:
  explicit Bumps(std::mt19937_64& random) : random_(random) {}

  Parameters next(LawId law) {
    const std::uint64_t choice = random_() % 8;
    if (choice < 3) return {std::array{15.24F, 20.32F, 25.4F, 30.48F, 35.56F}[random_() % 5], 25.4F, 1};
    if (choice < 5) {
      std::uniform_real_distribution<double> uniform(0, 1);
      const double R = 0.1001 * std::pow(10, 4.99 * uniform(random_));
      const double share = random_() % 2 == 0 ? uniform(random_) : std::pow(2, -16 * uniform(random_));
      return {static_cast<float>(R), static_cast<float>(std::max(1.001e-3, 1.9999 * R * share)), 1};
    }
    const bool is_3p = law == LawId::bump_3p || law == LawId::bump_3p_shaded;
    const bool is_2p = law == LawId::bump_2p || law == LawId::bump_2p_shaded;
    triple = kTriples[random_() % kTriples.size()];
    if (is_3p && 2 * triple.p > triple.q) triple = {5, 12, 13};
    if (is_2p && triple.p > triple.r) std::swap(triple.p, triple.r);
    const auto [p, r, q] = triple;
    const double R = is_3p ? q * q * q : is_2p ? q * q : q;
    const double half = is_3p ? 3 * p * q * q - 4 * p * p * p : is_2p ? 2 * p * r : p;
    const int scale = 3 - std::ilogb(R) + static_cast<int>(random_() % 6);
    depth = std::ldexp(is_3p ? 0 : is_2p ? r * r - p * p : r, scale);
    return {std::ldexp(static_cast<float>(R), scale), std::ldexp(static_cast<float>(2 * half), scale), 1};
  }

  // A position where the last bump, if it was rational, can have rational forces.
  Eigen::Vector3f rational_position(LawId law, const Parameters& bump) {
    const Triple other = random_() % 2 == 0 ? triple : kTriples[random_() % kTriples.size()];
    const double step = std::ldexp(1.0, -static_cast<int>(random_() % 12));
    const double count = 1 + static_cast<double>(random_() % 64);
    if (law == LawId::cylinder || law == LawId::bump_cylinder)
      return {static_cast<float>(other.p * count * step), 0, static_cast<float>(other.r * count * step - depth)};
    const double x = static_cast<double>(bump.radius) * other.p / other.q;
    return {static_cast<float>(random_() % 4 == 0 ? count * step : x), 0, static_cast<float>(-count * step)};
  }

 private:
  std::mt19937_64& random_;
  Triple triple{3, 4, 5};
  double depth = 1;
};

template <class Definition>
void search(Hardest& hardest, LawId id, std::uint64_t tries) {
  std::mt19937_64 random(1995);
  Bumps bumps(random);
  constexpr std::uint64_t kPositionsPerBump = 5000;
  for (std::uint64_t done = 0; done < tries; done += kPositionsPerBump) {
    const Parameters p = bumps.next(id);
    Sweep<Definition> sweep(hardest, p, Definition::template geometry<DoubleDouble>(p));
    properties::PositionSource source(std::get<reference::Law>(reference::Law::build(id, p)), random());
    float worst_x = 0;
    double worst = 0;
    for (std::uint64_t i = 0; i < kPositionsPerBump; ++i) {
      const bool may_tie = i % 64 == 0;
      Eigen::Vector3f at = may_tie ? bumps.rational_position(id, p) : source.next().position;
      if (i % 2 == 1) at.x() = worst_x;  // an error that depends on x alone is large there for every z
      const double error = sweep.at(at.x(), at.z(), may_tie);
      if (error > worst) {
        worst = error;
        worst_x = at.x();
      }
    }
  }
  search_beside_ties<Definition>(hardest, tries, random);
}

template <class... Definition>
void search(Hardest& hardest, LawId id, std::uint64_t tries, fast::LawList<Definition...>) {
  std::size_t i = 0;  // the list is in the order of the ids
  ((kLaws[i++].id == id ? search<Definition>(hardest, id, tries) : void()), ...);
}

void print(LawId id, const Hardest& hardest) {
  std::printf("R,w,K,x,z,Fx,Fz,from tie,why\n");
  for (const auto& [kind, candidates] : hardest.kinds())
    for (const Candidate& candidate : candidates) {
      const auto law = std::get<reference::Law>(reference::Law::build(id, candidate.p));
      const Eigen::Vector3f position(candidate.x, 0, candidate.z);
      const Eigen::Vector3f force = law.round_to_binary32(position).force;
      std::string line;
      for (const float number :
           {candidate.p.radius, candidate.p.width, candidate.p.stiffness, candidate.x, candidate.z, force.x(), force.z()}) {
        char text[40];
        std::snprintf(text, sizeof text, "%a,", static_cast<double>(number));
        line += text;
      }
      std::printf("%s%s,%s\n", line.c_str(), distance_from_tie(law, position).c_str(), kind.c_str());
      std::fprintf(stderr, "%s: %g\n", kind.c_str(), candidate.score);
    }
}

}  // namespace
}  // namespace forceshade::tests

int main(int argc, char** argv) {
  using namespace forceshade;
  const auto id = argc > 1 ? law_named(argv[1]) : std::nullopt;
  if (!id) {
    std::fprintf(stderr, "usage: hard_cases_search LAW [POSITIONS]\n");
    return 2;
  }
  const bool is_a_product = id == LawId::wall || id == LawId::bump_1p;  // two kinds of cases only
  tests::Hardest hardest(is_a_product ? 6 : 2);
  tests::search(hardest, *id, argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 10'000'000, fast::Laws{});
  tests::print(*id, hardest);
}

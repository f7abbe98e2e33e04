// SPDX-License-Identifier: BSD-3-Clause
// virtual_fit SOURCE_DIR [SEARCHES [PARTICIPANTS]]: fits the observer of study/experiments/virtual_participant.h to half of the
// thesis's numbers, and prints how well it predicts the other half. Without SEARCHES, or with 0, it only prints the table for
// the observer in the library. There are 5 participants by default, as in the thesis; more show what is chance.
//
// Fitted: the conditions without vision (Tables 6.1, 6.3, 6.5, 6.7: means over the five subjects of slope, mean SD, mean SI and
// mean number of steps) and every second row of Table 6.9. Predicted: those with vision (6.2, 6.4, 6.6, 6.8) and the other
// rows.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "study/experiments/random.h"
#include "study/experiments/session_results.h"
#include "study/experiments/virtual_participant.h"

namespace forceshade::experiments {
namespace {

struct Cell {
  double slope, deviation, satisfaction, steps;
};

// Means of the five subjects' rows: without vision, with vision.
struct Condition {
  const char* stimulus;
  std::array<Cell, 2> thesis;
};
const std::array<Condition, 4> kMatching{{
    {"bump-cylinder", {{{0.966, 11.24, 8.12, 31.8}, {0.942, 11.82, 8.30, 28.6}}}},
    {"bump-1p-shaded", {{{0.430, 8.40, 5.24, 37.0}, {0.568, 14.20, 7.44, 30.0}}}},
    {"bump-2p-shaded", {{{0.676, 9.66, 7.38, 33.8}, {0.714, 12.44, 8.10, 31.0}}}},
    {"bump-3p-shaded", {{{0.728, 12.06, 7.36, 34.2}, {0.746, 10.06, 8.06, 28.4}}}},
}};

// Table 6.9, percent of answers 1 to 4.
struct Row {
  const char* stimulus;
  Mil radius;
  std::array<double, 4> thesis;
};
const std::array<Row, 21> kClassification{{
    {"bump-1p", 600, {99, 1, 0, 0}},           {"bump-1p", 1000, {96, 1, 1, 3}},
    {"bump-1p", 1400, {100, 0, 0, 0}},         {"bump-2p", 600, {0, 79, 3, 19}},
    {"bump-2p", 1000, {1, 53, 3, 43}},         {"bump-2p", 1400, {8, 47, 1, 44}},
    {"bump-3p", 600, {0, 3, 92, 6}},           {"bump-3p", 1000, {0, 3, 86, 10}},
    {"bump-3p", 1400, {0, 7, 87, 6}},          {"bump-cylinder", 600, {0, 7, 19, 75}},
    {"bump-cylinder", 1000, {0, 9, 3, 88}},    {"bump-cylinder", 1400, {0, 6, 0, 94}},
    {"bump-1p-shaded", 600, {2, 3, 38, 57}},   {"bump-1p-shaded", 1000, {3, 11, 29, 57}},
    {"bump-1p-shaded", 1400, {2, 14, 36, 48}}, {"bump-2p-shaded", 600, {0, 35, 16, 48}},
    {"bump-2p-shaded", 1000, {0, 12, 2, 87}},  {"bump-2p-shaded", 1400, {1, 6, 8, 85}},
    {"bump-3p-shaded", 600, {1, 3, 39, 57}},   {"bump-3p-shaded", 1000, {1, 3, 15, 81}},
    {"bump-3p-shaded", 1400, {0, 7, 8, 86}},
}};

// The thesis's own measures (6.1.1) of one participant's trials of one condition.
Cell cell_of(const std::vector<const MatchingResult*>& trials) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  Cell cell{};
  std::map<double, std::vector<double>> by_reference;
  for (const MatchingResult* trial : trials) {
    n += 1;
    x += trial->reference_radius;
    y += trial->final_radius;
    xx += trial->reference_radius * trial->reference_radius;
    xy += trial->reference_radius * trial->final_radius;
    cell.satisfaction += trial->satisfaction;
    cell.steps += trial->steps;
    by_reference[trial->reference_radius].push_back(trial->final_radius);
  }
  cell.slope = (n * xy - x * y) / (n * xx - x * x);
  cell.satisfaction /= n;
  cell.steps /= n;
  for (const auto& [reference, finals] : by_reference) {
    double mean = 0, squares = 0;
    for (const double value : finals) mean += value / static_cast<double>(finals.size());
    for (const double value : finals) squares += (value - mean) * (value - mean);
    cell.deviation +=
        100 * std::sqrt(squares / static_cast<double>(finals.size() - 1)) / mean / static_cast<double>(by_reference.size());
  }
  return cell;
}

// A session in memory.
Results results_of_one(const Protocol& protocol, const Language& language, const Feel& feel, const Observer& observer,
                       int number) {
  Random seeds(1995, static_cast<std::uint64_t>(number));
  SavedSession saved{std::to_string(number), seeds.next(), protocol, language, {}, {}};
  Session session(protocol, language, saved.seed, [&](const Event& event) { saved.events.push_back(event); });
  VirtualParticipant participant(protocol, observer, feel, seeds.next());
  run_to_end(session, participant);
  return results_of(saved);
}

struct Simulated {
  std::array<std::array<Cell, 2>, 4> matching{};
  std::array<std::array<double, 4>, 21> classification{};
};

class Study {
 public:
  // All participants have the same observer, and seeds of their own.
  Study(const std::filesystem::path& examples, int participants)
      : participants_(participants),
        matching_(read_protocol(examples / "matching.toml")),
        classification_(read_protocol(examples / "classification.toml")),
        language_(read_language(matching_.language)),
        feel_matching_(feel_of_laws(matching_)),
        feel_classification_(feel_of_laws(classification_)) {}

  Simulated run(const Observer& observer, bool fitted_alone) const {
    Simulated all;
    Protocol protocol = matching_;
    if (fitted_alone) protocol.vision = {false};
    for (int number = 1; number <= participants_; ++number) {
      const Results matched = results_of_one(protocol, language_, feel_matching_, observer, number);
      for (std::size_t i = 0; i < kMatching.size(); ++i)
        for (const bool vision : protocol.vision) {
          std::vector<const MatchingResult*> trials;
          for (const MatchingResult& trial : matched.matching)
            if (trial.stimulus == kMatching[i].stimulus && trial.vision == vision) trials.push_back(&trial);
          const Cell cell = cell_of(trials);
          Cell& mean = all.matching[i][vision ? 1 : 0];
          mean.slope += cell.slope / participants_;
          mean.deviation += cell.deviation / participants_;
          mean.satisfaction += cell.satisfaction / participants_;
          mean.steps += cell.steps / participants_;
        }
      const Results classified = results_of_one(classification_, language_, feel_classification_, observer, number);
      for (const ClassificationResult& trial : classified.classification)
        for (std::size_t i = 0; i < kClassification.size(); ++i)
          if (trial.stimulus == kClassification[i].stimulus && trial.radius == kClassification[i].radius)
            all.classification[i][static_cast<std::size_t>(trial.answer - 1)] += 100.0 / (24 * participants_);
    }
    return all;
  }

 private:
  int participants_;
  Protocol matching_, classification_;
  Language language_;
  Feel feel_matching_, feel_classification_;
};

// Sums of squared differences, each in a unit that makes the kinds of numbers comparable: 0.1 in slope, 2 % in SD, 1 in
// satisfaction, 5 steps, and 10 % in a share, which weighs a quarter, because a row has four.
struct Errors {
  std::array<double, 5> squares{}, counts{};

  void add(std::size_t kind, double value, double thesis) {
    constexpr std::array<double, 5> units{0.1, 2, 1, 5, 10};
    const double difference = (value - thesis) / units[kind], weight = kind == 4 ? 0.25 : 1;
    squares[kind] += weight * difference * difference;
    counts[kind] += weight;
  }
  void add(const Cell& cell, const Cell& thesis) {
    add(0, cell.slope, thesis.slope);
    add(1, cell.deviation, thesis.deviation);
    add(2, cell.satisfaction, thesis.satisfaction);
    add(3, cell.steps, thesis.steps);
  }

  // Root mean square, of all or of one kind.
  double all() const {
    double sum = 0, count = 0;
    for (std::size_t kind = 0; kind < 5; ++kind) {
      sum += squares[kind];
      count += counts[kind];
    }
    return std::sqrt(sum / count);
  }
  double of(std::size_t kind) const { return std::sqrt(squares[kind] / counts[kind]); }
};

Errors errors_of(const Simulated& simulated, bool of_fitted) {
  Errors errors;
  const std::size_t vision = of_fitted ? 0 : 1;
  for (std::size_t i = 0; i < kMatching.size(); ++i) errors.add(simulated.matching[i][vision], kMatching[i].thesis[vision]);
  for (std::size_t i = of_fitted ? 0 : 1; i < kClassification.size(); i += 2)
    for (std::size_t answer = 0; answer < 4; ++answer)
      errors.add(4, simulated.classification[i][answer], kClassification[i].thesis[answer]);
  return errors;
}

double error_of(const Simulated& simulated, bool of_fitted) {
  return errors_of(simulated, of_fitted).all();
}

// The errors without a model: numbers with vision are those without, and a row of Table 6.9 is the mean of the rows before and
// after it.
Errors errors_without_a_model() {
  Errors errors;
  for (const Condition& condition : kMatching) errors.add(condition.thesis[0], condition.thesis[1]);
  for (std::size_t i = 1; i + 1 < kClassification.size(); i += 2)
    for (std::size_t answer = 0; answer < 4; ++answer)
      errors.add(4, (kClassification[i - 1].thesis[answer] + kClassification[i + 1].thesis[answer]) / 2,
                 kClassification[i].thesis[answer]);
  return errors;
}

void print(const char* name, const Errors& errors) {
  std::printf("%-18s slope %.3f  SD %.1f %%  SI %.2f  steps %.1f  share %.0f %%  all %.2f\n", name, 0.1 * errors.of(0),
              2 * errors.of(1), errors.of(2), 5 * errors.of(3), 10 * errors.of(4), errors.all());
}

void print(const Simulated& simulated) {
  std::printf("%-16s %-7s %-9s slope         SD %%          SI            steps\n", "stimulus", "vision", "half");
  for (std::size_t i = 0; i < kMatching.size(); ++i)
    for (std::size_t vision = 0; vision < 2; ++vision) {
      const Cell &cell = simulated.matching[i][vision], &thesis = kMatching[i].thesis[vision];
      std::printf("%-16s %-7s %-9s %.2f (%.2f)   %4.1f (%4.1f)   %4.1f (%4.1f)   %4.1f (%4.1f)\n", kMatching[i].stimulus,
                  vision == 1 ? "yes" : "no", vision == 1 ? "predicted" : "fitted", cell.slope, thesis.slope, cell.deviation,
                  thesis.deviation, cell.satisfaction, thesis.satisfaction, cell.steps, thesis.steps);
    }
  int right = 0, predicted = 0;
  for (std::size_t i = 0; i < kClassification.size(); ++i) {
    const Row& row = kClassification[i];
    const auto& shares = simulated.classification[i];
    std::printf("%-16s %4d %-9s", row.stimulus, row.radius, i % 2 == 0 ? "fitted" : "predicted");
    for (std::size_t answer = 0; answer < 4; ++answer) std::printf("  %3.0f (%3.0f)", shares[answer], row.thesis[answer]);
    std::printf("\n");
    if (i % 2 == 0) continue;
    ++predicted;
    const auto most = [](const std::array<double, 4>& all) { return std::max_element(all.begin(), all.end()) - all.begin(); };
    right += most(shares) == most(row.thesis) ? 1 : 0;
  }
  std::printf("most frequent answer right in %d of %d predicted rows\n", right, predicted);
  std::printf("root mean square errors; all: in the units of Errors\n");
  print("fitted", errors_of(simulated, true));
  print("predicted", errors_of(simulated, false));
  print("without a model", errors_without_a_model());
}

// Random changes of one to all numbers, kept where they are better; smaller from search to search.
Observer fit(const Study& study, int searches) {
  Random random(7);
  Observer best = fitted_observer();
  double least = error_of(study.run(best, true), true);
  for (int i = 0; i < searches; ++i) {
    const double size = 0.5 * std::pow(0.05, static_cast<double>(i) / searches);
    const auto changed = [&](double value) {
      return random.uniform() < 0.5 ? value : value * std::exp(size * random.normal());
    };
    Observer tried{changed(best.position_noise),    changed(best.direction_noise),   changed(best.criterion),
                   changed(best.best_satisfaction), changed(best.satisfaction_loss), changed(best.round_preference)};
    const double error = error_of(study.run(tried, true), true);
    if (error >= least) continue;
    least = error;
    best = tried;
    std::printf("%4d %.3f: %.3f %.3f %.3f %.2f %.3f %.3f\n", i, error, best.position_noise, best.direction_noise,
                best.criterion, best.best_satisfaction, best.satisfaction_loss, best.round_preference);
    std::fflush(stdout);
  }
  return best;
}

}  // namespace
}  // namespace forceshade::experiments

int main(int argc, char** argv) {
  using namespace forceshade::experiments;
  try {
    const int searches = argc > 2 ? std::atoi(argv[2]) : 0, participants = argc > 3 ? std::max(std::atoi(argv[3]), 1) : 5;
    const Study study(std::filesystem::path(argc > 1 ? argv[1] : ".") / "clients/study/examples", participants);
    print(study.run(searches > 0 ? fit(study, searches) : fitted_observer(), false));
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "virtual_fit: %s\n", error.what());
    return 2;
  }
}

// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A model of a person in the experiments: feels bumps with noise, combines force direction and position, presses keys.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "study/experiments/session.h"
#include "study/experiments/session_folder.h"

namespace forceshade::experiments {

// The sensation of the hand at one place of a bump, pressing with a constant force.
struct Felt {
  double height = 0;     // mm, of the hand above where it is beside the bump, pressing as hard
  double direction = 0;  // degrees of the force from the vertical, positive away from the middle
};

// At stroke_places(), from left to right.
inline constexpr std::size_t kStrokePlaces = 16;
using Stroke = std::vector<Felt>;

// mm from the middle of a bump: the middles of sixteen equal parts of its width.
std::vector<double> stroke_places(const Protocol& protocol);

// Gives the stroke over a bump. A run on a device may take it from the device's samples instead of from the laws.
using Feel = std::function<Stroke(const Bump&)>;

// Strokes from the laws' real-time path, at a force of 1 N; each is computed once. Throws std::invalid_argument for a stimulus
// that is no law.
Feel feel_of_laws(const Protocol& protocol);

// The numbers of the model. virtual_participants.md defines it and describes the fit.
struct Observer {
  // Standard deviation of what one comparison yields, as a multiple of a threshold from the literature.
  double position_noise = 1;   // of the mean height of a bump; 1: 0.43 mm
  double direction_noise = 1;  // of the mean direction; 1: 25.6 degrees without vision, 18.4 degrees with it
  double criterion = 0.5;      // a match is accepted below this multiple of the felt difference's standard deviation
  double best_satisfaction = 8.5;
  double satisfaction_loss = 1;  // for each standard deviation of difference that is left
  // Head start of the round bump over the other pictures, as a squared distance in standard deviations.
  double round_preference = 0;
};

// Fitted to half of the thesis's numbers by study/tests/experiments/virtual_fit.cpp.
Observer fitted_observer();

struct Response {
  Press press;
  double seconds = 0;  // that pass before it
};

// Reads screens and scenes and presses keys as a person does. The same seed and strokes give the same presses.
class VirtualParticipant {
 public:
  VirtualParticipant(const Protocol& protocol, const Observer& observer, Feel feel, std::uint64_t seed);
  ~VirtualParticipant();
  VirtualParticipant(VirtualParticipant&&) noexcept;

  // The next press. Precondition: the screen is not the end.
  Response next(const Screen& screen, const Scene& scene);

 private:
  class Model;
  std::unique_ptr<Model> model_;
};

// Lets the participant press until the session is over, and closes it; how long that took the participant, in s.
double run_to_end(Session& session, VirtualParticipant& participant);

// Session folders FOLDER/V1 to FOLDER/V<participants>, without ticks, each run from start to end. Throws Error.
std::vector<std::filesystem::path> run_virtual_study(const std::filesystem::path& folder, const std::filesystem::path& protocol,
                                                     int participants, std::uint64_t seed,
                                                     const Observer& observer = fitted_observer(), Sync sync = Sync::never);

}  // namespace forceshade::experiments

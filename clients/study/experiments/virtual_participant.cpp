// SPDX-License-Identifier: BSD-3-Clause
#include "study/experiments/virtual_participant.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

#include "forceshade/fast.h"
#include "study/experiments/random.h"

namespace forceshade::experiments {
namespace {

constexpr double kPress = 1;  // N
// Louw, Kappers and Koenderink (2000): a Gaussian bump of 240 mm is detected at a height of 8 mm, with the height proportional
// to the width to the power of 1.3; at 25.4 mm that is 0.43 mm.
constexpr double kHeightThreshold = 0.43;  // mm
// Barbagli and others (2006): just-noticeable difference of a force's direction, without vision and with congruent vision.
constexpr double kDirectionThreshold = 25.6, kDirectionThresholdWithVision = 18.4;  // degrees
constexpr int kMostComparisons = 60, kMostPressesAtOnce = 20;
constexpr double kMotorNoise = 0.3;         // of the number of presses of a burst, as a share of it
constexpr double kSatisfactionNoise = 0.5;  // standard deviation
constexpr int kRoundPicture = 4;            // of figure 5-8
constexpr double kLapses = 0.02;            // share of classifications at random
// The participant's own time, which no fit uses: the thesis states a minute and a half, and ten seconds, for a trial.
constexpr double kSecondsOfStroke = 4, kSecondsOfPress = 0.4, kSecondsOfAnswer = 3, kSecondsOfText = 15;

double degrees(double radians) {
  return radians * (180 / std::numbers::pi);
}

// The place of the hand at x under a force of kPress, and the force there. The force grows with depth.
Felt felt_at(const fast::Law& law, double x, double beside) {
  const auto force = [&](double z) {
    return law.force(Eigen::Vector3f(static_cast<float>(x), 0, static_cast<float>(z))).cast<double>().eval();
  };
  const double highest = law.parameters().radius + 1.0;
  double below = beside - 1, above = highest;
  for (int i = 0; i < 50; ++i) {
    const double z = (below + above) / 2;
    (force(z).norm() > kPress ? below : above) = z;
  }
  const Eigen::Vector3d at = force(below);
  return {below - beside, degrees(std::atan2(x < 0 ? -at.x() : at.x(), at.z()))};
}

Stroke stroke_over(const Protocol& protocol, LawId id, Mil radius) {
  const auto law = fast::Law::build(id, protocol.parameters(radius));
  if (const auto* error = std::get_if<ParameterError>(&law)) throw std::invalid_argument(error->message());
  Stroke stroke;
  for (const double x : stroke_places(protocol))
    stroke.push_back(felt_at(std::get<fast::Law>(law), x, -kPress / protocol.stiffness));
  return stroke;
}

// Mean height in mm and mean direction in degrees.
struct Cues {
  double height = 0, direction = 0;
};

Cues cues_of(const Stroke& stroke) {
  Cues cues;
  for (const Felt& felt : stroke) {
    cues.height += felt.height / static_cast<double>(stroke.size());
    cues.direction += felt.direction / static_cast<double>(stroke.size());
  }
  return cues;
}

// The participant's knowledge of round bumps: the mean height that belongs to each mean direction.
class RoundBumps {
 public:
  explicit RoundBumps(const Protocol& protocol) {
    known_.push_back({0, 0});  // the plane
    for (Mil radius = 16 * protocol.width; 2 * radius >= protocol.width; radius = radius * 49 / 50)
      known_.push_back(cues_of(stroke_over(protocol, LawId::bump_cylinder, radius)));
  }

  // mm, and mm per degree; linear between known bumps, and beyond them along the last piece.
  std::pair<double, double> height_of(double direction) const {
    std::size_t i = 1;
    while (i + 1 < known_.size() && known_[i].direction < direction) ++i;
    const Cues &low = known_[i - 1], &high = known_[i];
    const double slope = (high.height - low.height) / (high.direction - low.direction);
    return {low.height + slope * (direction - low.direction), slope};
  }

 private:
  std::vector<Cues> known_;  // by rising direction
};

// One of the four pictures in one size.
struct Template {
  int picture;
  Stroke stroke;
};

// The shapes of figure 5-8 in many sizes, because pictures do not show the size.
std::vector<Template> templates_of(const Protocol& protocol) {
  constexpr std::array shapes{LawId::bump_1p, LawId::bump_2p, LawId::bump_3p, LawId::bump_cylinder};
  std::vector<Template> all;
  for (std::size_t i = 0; i < shapes.size(); ++i)
    for (Mil radius = 3 * protocol.width; 2 * radius >= protocol.width; radius = radius * 15 / 16) {
      all.push_back({static_cast<int>(i) + 1, stroke_over(protocol, shapes[i], radius)});
      if (i == 0) break;  // a plane has no size
    }
  return all;
}

}  // namespace

std::vector<double> stroke_places(const Protocol& protocol) {
  const double width = protocol.width * kMillimetresPerMil;
  std::vector<double> places;
  for (std::size_t i = 0; i < kStrokePlaces; ++i)
    places.push_back(width * ((static_cast<double>(i) + 0.5) / static_cast<double>(kStrokePlaces) - 0.5));
  return places;
}

Feel feel_of_laws(const Protocol& protocol) {
  auto known = std::make_shared<std::map<std::pair<std::string, Mil>, Stroke>>();
  return [protocol, known](const Bump& bump) {
    const auto [at, is_new] = known->try_emplace({bump.stimulus, bump.radius});
    if (is_new) {
      const Stimulus& stimulus = protocol.stimulus(bump.stimulus);
      if (stimulus.kind != StimulusKind::law) throw std::invalid_argument(stimulus.name + " is no law");
      at->second = stroke_over(protocol, stimulus.law, bump.radius);
    }
    return at->second;
  };
}

class VirtualParticipant::Model {
 public:
  Model(const Protocol& protocol, const Observer& observer, Feel feel, std::uint64_t seed)
      : protocol_(protocol), observer_(observer), feel_(std::move(feel)), random_(seed), round_(protocol) {
    if (protocol.experiment == Experiment::classification) templates_ = templates_of(protocol);
  }

  Response next(const Screen& screen, const Scene& scene) {
    switch (screen.kind) {
      case ScreenKind::matching: return match(screen, scene);
      case ScreenKind::satisfaction:
        if (screen.entry.empty()) return {type(std::to_string(satisfaction())), kSecondsOfAnswer};
        // A 1 of a 10 stands already; the entry holds one digit a press.
        if (!rest_.empty()) return {type(std::exchange(rest_, "")), kSecondsOfPress};
        is_matching_ = false;
        return {{Action::enter}, kSecondsOfPress};
      case ScreenKind::classification:
        if (screen.entry.empty()) return {type(std::to_string(classify(*scene.left))), 2 * kSecondsOfStroke};
        return {{Action::enter}, kSecondsOfPress};
      case ScreenKind::question:
      case ScreenKind::text:
      case ScreenKind::end: return {{Action::enter}, kSecondsOfText};
    }
    return {};
  }

 private:
  // A size in mm of mean height, as felt once: by its deviation from the truth, noise included.
  struct Percept {
    double size = 0, deviation = 0;
    double weight_of_direction = 0;
    Cues truth;
    double size_of_direction = 0;
  };

  // Digits are pressed one by one.
  Press type(std::string digits) {
    rest_ = digits.substr(1);
    return {Action::type, digits.substr(0, 1)};
  }

  double height_noise() const { return observer_.position_noise * kHeightThreshold; }
  double direction_noise(bool vision) const {
    return observer_.direction_noise * (vision ? kDirectionThresholdWithVision : kDirectionThreshold);
  }

  const Cues& cues(const Bump& bump) {
    const auto [at, is_new] = cues_.try_emplace({bump.stimulus, bump.radius});
    if (is_new) at->second = cues_of(feel_(bump));
    return at->second;
  }

  // The estimate of least variance: each cue weighs by the inverse of its variance (Ernst and Banks 2002).
  Percept perceive(const Bump& bump, bool vision) {
    Percept percept;
    percept.truth = cues(bump);
    const auto [of_direction, slope] = round_.height_of(percept.truth.direction);
    percept.size_of_direction = of_direction;
    const double height_variance = height_noise() * height_noise(), direction_deviation = slope * direction_noise(vision),
                 direction_variance = direction_deviation * direction_deviation;
    percept.weight_of_direction = height_variance / (height_variance + direction_variance);
    percept.deviation = std::sqrt(height_variance * direction_variance / (height_variance + direction_variance));
    percept.size = percept.weight_of_direction * of_direction + (1 - percept.weight_of_direction) * percept.truth.height +
                   percept.deviation * random_.normal();
    return percept;
  }

  // Compares; then presses towards the reference as often as the difference seems to need, or is content.
  Response match(const Screen& screen, const Scene& scene) {
    if (!is_matching_) {
      is_matching_ = true;
      comparisons_ = presses_ = 0;
      before_burst_ = -1;
    }
    if (presses_ > 0) {
      --presses_;
      return {{is_raising_ ? raise() : lower()}, kSecondsOfPress};
    }
    const bool vision = screen.shows_scene;
    const Percept reference = perceive(*scene.left, vision), matching = perceive(*scene.right, vision);
    const double difference = matching.size - reference.size;
    const double deviation = std::hypot(matching.deviation, reference.deviation);
    const bool is_stuck = before_burst_ == scene.right->radius;
    before_burst_ = scene.right->radius;
    const double of_height = matching.truth.height - reference.truth.height,
                 of_direction = matching.size_of_direction - reference.size_of_direction;
    // The disagreement of the two cues, seen with the weights of the combination; noise of the estimate aside.
    left_ = std::sqrt(matching.weight_of_direction * of_direction * of_direction +
                      (1 - matching.weight_of_direction) * of_height * of_height) /
            deviation;
    if (++comparisons_ > kMostComparisons || is_stuck || std::fabs(difference) < observer_.criterion * deviation)
      return {{Action::done}, kSecondsOfStroke};
    // A step changes a round bump of the reference's size by so much.
    const double step = std::max(1e-6, cues(stepped(*scene.left, -1)).height - cues(stepped(*scene.left, 1)).height) / 2;
    const double presses = std::fabs(difference) / step * std::max(0.0, 1 + kMotorNoise * random_.normal());
    presses_ = static_cast<int>(std::lround(std::clamp(presses, 1.0, static_cast<double>(kMostPressesAtOnce)))) - 1;
    is_raising_ = difference < 0;
    return {{is_raising_ ? raise() : lower()}, 2 * kSecondsOfStroke};
  }

  Bump stepped(const Bump& bump, int direction) const {
    return {bump.stimulus, protocol_.stepped(protocol_.stimulus(bump.stimulus), bump.radius, direction), 0};
  }

  Action raise() const { return protocol_.bigger == Bigger::higher ? Action::bigger : Action::smaller; }
  Action lower() const { return protocol_.bigger == Bigger::higher ? Action::smaller : Action::bigger; }

  int satisfaction() {
    const double felt =
        observer_.best_satisfaction - observer_.satisfaction_loss * left_ + kSatisfactionNoise * random_.normal();
    return static_cast<int>(std::lround(std::clamp(felt, 1.0, 10.0)));
  }

  // The picture that, in its best size, is nearest to what was felt. Noise at each place is so large that the mean over the
  // places has the noise of a comparison.
  int classify(const Bump& bump) {
    if (random_.uniform() < kLapses) return 1 + static_cast<int>(random_.below(4));
    const double noise = std::sqrt(static_cast<double>(kStrokePlaces));
    const double of_height = noise * height_noise(), of_direction = noise * direction_noise(true);  // pictures are seen
    Stroke felt = feel_(bump);
    for (Felt& place : felt) {
      place.height += of_height * random_.normal();
      place.direction += of_direction * random_.normal();
    }
    int best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (const Template& one : templates_) {
      double distance = one.picture == kRoundPicture ? -observer_.round_preference : 0;
      for (std::size_t i = 0; i < felt.size(); ++i) {
        const double height = (felt[i].height - one.stroke[i].height) / of_height,
                     direction = (felt[i].direction - one.stroke[i].direction) / of_direction;
        distance += height * height + direction * direction;
      }
      if (distance < least) {
        least = distance;
        best = one.picture;
      }
    }
    return best;
  }

  Protocol protocol_;
  Observer observer_;
  Feel feel_;
  Random random_;
  RoundBumps round_;
  std::vector<Template> templates_;
  std::map<std::pair<std::string, Mil>, Cues> cues_;
  bool is_matching_ = false, is_raising_ = false;
  int comparisons_ = 0, presses_ = 0;  // in this trial; left of a burst
  Mil before_burst_ = -1;
  double left_ = 0;  // difference between the cues at the end, in standard deviations of a comparison
  std::string rest_;
};

VirtualParticipant::VirtualParticipant(const Protocol& protocol, const Observer& observer, Feel feel, std::uint64_t seed)
    : model_(std::make_unique<Model>(protocol, observer, std::move(feel), seed)) {}
VirtualParticipant::~VirtualParticipant() = default;
VirtualParticipant::VirtualParticipant(VirtualParticipant&&) noexcept = default;

Response VirtualParticipant::next(const Screen& screen, const Scene& scene) {
  return model_->next(screen, scene);
}

Observer fitted_observer() {
  return {1.04, 0.123, 0.563, 7.76, 0.405, 3.331};
}

double run_to_end(Session& session, VirtualParticipant& participant) {
  double time = 0;
  while (!session.is_over()) {
    const Response response = participant.next(session.screen(), session.scene());
    time += response.seconds;
    session.press(response.press, time);
  }
  session.close(time);
  return time;
}

std::vector<std::filesystem::path> run_virtual_study(const std::filesystem::path& folder, const std::filesystem::path& protocol,
                                                     int participants, std::uint64_t seed, const Observer& observer,
                                                     Sync sync) {
  std::vector<std::filesystem::path> folders;
  const Protocol read = read_protocol(protocol);
  const Feel feel = feel_of_laws(read);
  for (int i = 1; i <= participants; ++i) {
    std::string name = "V";
    name += std::to_string(i);
    Random seeds(seed, static_cast<std::uint64_t>(i));
    RecordedSession recorded =
        RecordedSession::start(folder / name, protocol, name, seeds.next(), {}, sync, {AnsweredBy::model, "none", {}});
    VirtualParticipant participant(read, observer, feel, seeds.next());
    run_to_end(recorded.session(), participant);
    folders.push_back(folder / name);
  }
  return folders;
}

}  // namespace forceshade::experiments

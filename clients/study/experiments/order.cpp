// SPDX-License-Identifier: BSD-3-Clause
#include "study/experiments/order.h"

#include <algorithm>
#include <array>

#include "study/experiments/random.h"

namespace forceshade::experiments {
namespace {

// Streams of the seed. Those of blocks begin at kOfBlocks.
constexpr std::uint64_t kOfBlockOrder = 0, kOfPractice = 1, kOfBlocks = 2;

std::vector<Trial> matching_trials(const Protocol& protocol, const Stimulus& stimulus) {
  const std::array initials{InitialRadius::large, InitialRadius::same, InitialRadius::small};
  std::vector<Trial> all;
  for (const Mil radius : protocol.reference_radii)
    for (const InitialRadius initial : initials)
      for (int repetition = 1; repetition <= protocol.repetitions; ++repetition) {
        const Mil first = initial == InitialRadius::large   ? protocol.large_initial_radius
                          : initial == InitialRadius::small ? protocol.small_initial_radius
                                                            : radius;
        all.push_back({0, stimulus.name, radius, initial, first, repetition});
      }
  return all;
}

std::vector<Block> matching_blocks(const Protocol& protocol) {
  std::vector<Block> blocks;
  for (const Stimulus& stimulus : protocol.stimuli)
    for (const bool vision : protocol.vision) blocks.push_back({0, false, vision, matching_trials(protocol, stimulus)});
  return blocks;
}

Block classification_block(const Protocol& protocol) {
  Block block;
  for (const Stimulus& stimulus : protocol.stimuli)
    for (const Mil radius : protocol.radii_of(stimulus))
      for (int repetition = 1; repetition <= protocol.repetitions; ++repetition)
        block.trials.push_back({0, stimulus.name, radius, InitialRadius::same, 0, repetition});
  return block;
}

// Different conditions as long as there are some.
Block practice_block(const Protocol& protocol, const Block& first, std::uint64_t seed) {
  Block practice{0, true, first.vision, first.trials};
  Random random(seed, kOfPractice);
  random.shuffle(std::span(practice.trials));
  const auto count = static_cast<std::size_t>(protocol.practice_trials);
  for (std::size_t i = practice.trials.size(); i < count; ++i)
    practice.trials.push_back(practice.trials[i - first.trials.size()]);
  practice.trials.resize(count);
  return practice;
}

}  // namespace

std::vector<Block> order(const Protocol& protocol, std::uint64_t seed) {
  std::vector<Block> blocks =
      protocol.experiment == Experiment::matching ? matching_blocks(protocol) : std::vector{classification_block(protocol)};
  if (protocol.experiment == Experiment::matching && protocol.block_order == BlockOrder::random)
    Random(seed, kOfBlockOrder).shuffle(std::span(blocks));
  int number = 0;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    blocks[i].number = static_cast<int>(i) + 1;
    Random(seed, kOfBlocks + i).shuffle(std::span(blocks[i].trials));
    for (Trial& trial : blocks[i].trials) trial.number = ++number;
  }
  if (protocol.practice_trials > 0) {
    Block practice = practice_block(protocol, blocks.front(), seed);
    for (Trial& trial : practice.trials) trial.number = 0;
    blocks.insert(blocks.begin(), std::move(practice));
  }
  return blocks;
}

}  // namespace forceshade::experiments

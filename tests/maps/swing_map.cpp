// SPDX-License-Identifier: BSD-3-Clause
// Prints what a hand is given on a virtual wall over the rate of the loop and the stiffness, for each simulated device and each
// passivity controller: the CSV of tests/maps/swing_map.sh.

#include <cmath>
#include <cstdio>
#include <string>

#include "device/passive_rate.h"
#include "device/simulated/simulated.h"
#include "tests/device/hand_on_wall.h"

int main() {
  using namespace forceshade::device;
  constexpr int kRates = 12, kStiffnesses = 12;
  const auto spaced = [](double low, double high, int i, int points) { return low * std::pow(high / low, i / (points - 1.0)); };
  std::printf("model,controller,hand,rate_Hz,stiffness_N_per_mm,energy_mJ,swing_mm,warned,limited_ticks,tripped\n");
  for (const auto& make : kModels)
    for (const Passivity passivity : {Passivity::damping, Passivity::tank, Passivity::observer})
      for (const bool presses : {false, true})
        for (int row = 0; row < kStiffnesses; ++row)
          for (int column = 0; column < kRates; ++column) {
            const HandOnWall wall{.model = make(),
                                  .rate = std::round(spaced(100, 4000, column, kRates)),
                                  .stiffness = static_cast<float>(spaced(0.1, 8, row, kStiffnesses)),
                                  .passivity = passivity,
                                  .presses = presses};
            const FeltOnWall felt = felt_on(wall);
            const Capabilities capabilities = Simulated(wall.model, std::nullopt).capabilities();
            const auto stiffness = static_cast<double>(wall.stiffness);
            std::size_t limited = 0;  // for any reason but the gentle start
            for (std::size_t rule = 0; rule < kRules; ++rule)
              if (static_cast<Rule>(rule) != Rule::gentle_start) limited += felt.run.limited_ticks[rule];
            std::printf("%s,%s,%s,%g,%.4g,%.4g,%.4g,%s,%zu,%s\n", std::string(wall.model.name).c_str(),
                        name_of(passivity).data(), presses ? "presses" : "strokes", wall.rate, stiffness, felt.energy,
                        felt.swing, words_if_active(stiffness, capabilities, wall.rate).empty() ? "no" : "yes", limited,
                        felt.run.trip ? name_of(felt.run.trip->rule).data() : "no");
          }
}

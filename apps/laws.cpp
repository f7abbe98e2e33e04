// SPDX-License-Identifier: BSD-3-Clause
// forceshade laws: ids, parameters, domains.

#include <iostream>

#include "apps/command.h"

namespace forceshade::apps {

void add_laws(CLI::App& app, int&) {
  app.add_subcommand("laws", "List the force laws with their parameters and domains")->callback([] {
    for (const LawName& law : kLaws) {
      std::cout << law.name << '\n';
      if (has_bump_geometry(law.id)) {
        std::cout << "  --radius     R  0.1 to 1e4 mm\n"
                     "  --width      w  1e-3 mm to 2R\n";
      }
      std::cout << "  --stiffness  K  1e-3 to 1e3 N/mm\n";
    }
    std::cout << "positions: x, y, z from -1e4 to 1e4 mm; a coordinate below 2^-30 mm in size is read as 0\n";
  });
}

}  // namespace forceshade::apps

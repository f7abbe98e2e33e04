// SPDX-License-Identifier: BSD-3-Clause
// forceshade plot and forceshade figures: pictures of a law, and figures of the thesis drawn again.

#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "forceshade/apps/command.h"
#include "forceshade/properties/pictures.h"
#include "forceshade/properties/thesis_figures.h"

namespace forceshade::apps {
namespace {

using properties::Drawn;
using properties::Picture;

Picture force_of(const Drawn& drawn) {
  const properties::ForceProfile profile(drawn, properties::profile_depths({drawn}));
  return force_profile(drawn, profile, profile.side, profile.up);
}

struct Kind {
  const char* name;
  Picture (*draw)(const Drawn& drawn);
};
constexpr std::array kKinds{Kind{"force", force_of}, Kind{"directions", properties::direction_field},
                            Kind{"geometry", properties::cross_section}, Kind{"energy", properties::energy_map}};

void write(const Picture& picture, const std::filesystem::path& stem) {
  write_file(stem.string() + ".svg", svg_file(picture));
  write_file(stem.string() + ".png", png_file(picture));
  std::printf("%s.svg\n%s.png\n", stem.c_str(), stem.c_str());
}

}  // namespace

void add_plot(CLI::App& app, int&) {
  CLI::App* command = app.add_subcommand("plot", "Draw a law: force profile, directions, nominal geometry, energy map");
  const auto law = std::make_shared<LawOptions>(*command, LawOptions::Laws::one_or_all, LawOptions::Defaults::thesis);
  const auto out = std::make_shared<std::string>(), what = std::make_shared<std::string>("all");
  command->add_option("--what", *what, "force, directions, geometry, energy or all")
      ->type_name("PICTURE")
      ->check(CLI::IsMember({"force", "directions", "geometry", "energy", "all"}))
      ->capture_default_str();
  command->add_option("--out", *out, "directory for LAW-PICTURE.svg and .png")->type_name("DIR")->required();
  command->callback([law, out, what] {
    const Parameters parameters = law->parameters();
    make_directory("--out", *out);
    for (const LawId id : law->laws()) {
      properties::LawResult result;
      result.law = id;
      result.parameters = parameters;
      const Drawn drawn(result);
      for (const Kind& kind : kKinds)
        if (*what == "all" || *what == kind.name)
          write(kind.draw(drawn), std::filesystem::path(*out) / (drawn.name() + '-' + kind.name));
    }
  });
}

void add_figures(CLI::App& app, int&) {
  CLI::App* command = app.add_subcommand("figures", "Draw figures of the thesis again, with their numbers");
  const auto out = std::make_shared<std::string>();
  command->add_option("--out", *out, "directory for figure-N-M.svg, .png and .csv")->type_name("DIR")->required();
  command->callback([out] {
    make_directory("--out", *out);
    for (const properties::ThesisFigure& figure : properties::thesis_figures()) {
      const std::filesystem::path stem = std::filesystem::path(*out) / figure.name;
      write(figure.picture, stem);
      write_file(stem.string() + ".csv", figure.csv);
      std::printf("%s.csv\n", stem.c_str());
    }
  });
}

}  // namespace forceshade::apps

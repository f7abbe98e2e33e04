// SPDX-License-Identifier: BSD-3-Clause
#include "forceshade/report/panels.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "forceshade/properties/binary32.h"
#include "forceshade/report/gnuplot.h"
#include "forceshade/report/html.h"

namespace forceshade::properties {
namespace {

template <class L>
L built(LawId id, const Parameters& parameters) {
  auto law = L::build(id, parameters);
  if (const auto* error = std::get_if<ParameterError>(&law))
    throw PlotError(std::string(name_of(id)) + ": " + error->message());
  return std::get<L>(law);
}

}  // namespace

Drawn::Drawn(LawId its_id, const Parameters& its_parameters, Findings its_findings)
    : id(its_id),
      parameters(its_parameters),
      findings(std::move(its_findings)),
      law(built<fast::Law>(id, parameters)),
      reference(built<reference::Law>(id, parameters)),
      shape(reference) {}

// Not a number of few bits: on a grid made from one the force would need no rounding, and the error map would show none.
double Drawn::reach() const {
  return shape.R > 0 ? std::min(0.65 * static_cast<double>(shape.w), 1e4) : 9.7;
}

std::vector<Drawn> drawn(const Certificate& certificate) {
  std::vector<Drawn> laws;
  for (const SubjectResult& result : certificate.subjects) {
    const auto its = law_of(result.identity);
    if (!its) continue;
    const auto is_same = [&](const Drawn& other) { return other.id == its->law; };
    if (std::none_of(laws.begin(), laws.end(), is_same)) laws.emplace_back(its->law, its->parameters, result);
  }
  return laws;
}

bool contains(const std::vector<Drawn>& laws, std::initializer_list<LawId> wanted) {
  return std::any_of(laws.begin(), laws.end(),
                     [&](const Drawn& drawn) { return std::find(wanted.begin(), wanted.end(), drawn.id) != wanted.end(); });
}

bool are_one_size(const std::vector<Drawn>& laws) {
  const Drawn* first = nullptr;
  for (const Drawn& law : laws) {
    if (law.parameters.stiffness != laws.front().parameters.stiffness) return false;
    if (law.shape.R == 0) continue;
    if (first != nullptr && !(first->parameters == law.parameters)) return false;
    first = &law;
  }
  return true;
}

Heights heights(const Drawn& drawn) {
  const auto w = static_cast<double>(drawn.shape.w), h = static_cast<double>(drawn.shape.h);
  return drawn.shape.R > 0 ? Heights{-0.21 * w, h + 0.06 * w} : Heights{-4.7, 1.3};
}

std::vector<Sample> across(const Drawn& drawn) {
  constexpr int kSteps = 240;
  std::vector<Sample> samples;
  for (int i = 0; i <= kSteps; ++i) samples.push_back({static_cast<float>(drawn.reach() * (2.0 * i / kSteps - 1)), false});
  for (const JumpLine& line : drawn.shape.jump_lines) {
    for (const long double x : {line.x, -line.x}) {
      const auto nearest = static_cast<float>(x);
      samples.push_back({nearest == 0 ? -1e-6F : neighbour(nearest, -2), false});
      samples.push_back({nearest == 0 ? 0.0F : neighbour(nearest, 2), true});
      if (line.x == 0) break;
    }
  }
  std::erase_if(samples, [&](const Sample& sample) { return std::fabs(static_cast<double>(sample.x)) > drawn.reach(); });
  std::sort(samples.begin(), samples.end(), [](const Sample& a, const Sample& b) { return a.x < b.x; });
  return samples;
}

std::string plotted(double value) {
  return std::isfinite(value) ? digits(value, 9) : "NaN";
}

std::string range(const char* axis, double low, double high) {
  return std::string("set ") + axis + "range [" + plotted(low) + ':' + plotted(high) + "]\n";
}

std::string margins(double left, double right, double top, double bottom) {
  return "set lmargin at screen " + plotted(left) + "\nset rmargin at screen " + plotted(right) + "\nset tmargin at screen " +
         plotted(top) + "\nset bmargin at screen " + plotted(bottom) + '\n';
}

std::string ticks(const char* axis, double length, int count) {
  if (!(length > 0)) return "";
  const double power = std::pow(10, std::floor(std::log10(length / count)));
  double step = 10 * power;
  for (const double multiple : {5.0, 2.0, 1.0})
    if (multiple * power * count >= length) step = multiple * power;
  return std::string("set ") + axis + "tics " + plotted(step) + '\n';
}

std::string vertical_name(const char* text) {
  return std::string("set label 1 \"") + text + "\" at graph 0, graph 1 offset character -3.6, 0.9 textcolor rgb '#333333'\n";
}

std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'') result += c;
    result += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return result + '\'';
}

std::string legend_line(const std::string& border_colour, const std::string& words) {
  return "<span class=\"key\"><i style=\"border-color:" + border_colour + "\"></i>" + words + "</span>";
}

std::string figure(int number, const char* columns, const std::string& title, const std::string& legend,
                   const std::vector<Panel>& panels, const std::string& caption) {
  std::string html = "<figure>\n<h3><span>Figure " + std::to_string(number) + "</span> " + title + "</h3>\n";
  if (!legend.empty()) html += "<p class=\"legend\">" + legend + "</p>\n";
  html += std::string("<div class=\"panels ") + columns + "\">\n";
  for (const Panel& panel : panels) html += "<div class=\"panel\"><h4>" + panel.heading + "</h4>\n" + panel.svg + "</div>\n";
  return html + "</div>\n<figcaption>" + caption + "</figcaption>\n</figure>\n";
}

}  // namespace forceshade::properties

// SPDX-License-Identifier: BSD-3-Clause
#include "report/plot_text.h"

#include <cmath>

#include "text/number_text.h"

namespace forceshade::properties {

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

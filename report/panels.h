// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What the figures of a certificate share: a law with all that a picture of it needs, where to sample it, axes, and the
// <figure> around the panels.

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "forceshade/certificate/certificate.h"
#include "forceshade/fast/law.h"
#include "forceshade/properties/law_claims.h"
#include "forceshade/reference/law.h"

namespace forceshade::properties {

struct Drawn {
  LawId id;
  Parameters parameters;
  Findings findings;  // of a certificate; else none
  fast::Law law;
  reference::Law reference;
  LawClaims shape;

  // Throws PlotError if the parameters are outside the law's domain.
  Drawn(LawId id, const Parameters& parameters, Findings findings = {});

  std::string name() const { return std::string(name_of(id)); }
  // Half of the width shown, mm: the bump and a little of the plane beside it.
  double reach() const;
  double surface(double x) const { return static_cast<double>(shape.surface(static_cast<long double>(x))); }
};

// Each law of the certificate, as it was first certified.
std::vector<Drawn> drawn(const Certificate& certificate);

bool contains(const std::vector<Drawn>& laws, std::initializer_list<LawId> wanted);

// Panels are compared by eye only if they share their axes, and can share them only if the laws are of one size.
bool are_one_size(const std::vector<Drawn>& laws);

struct Heights {
  double low, high;  // mm
};

// What a map over x and z shows of the law: the surface and some way into it.
Heights heights(const Drawn& drawn);

struct Sample {
  float x;
  bool after_jump;  // the force may have jumped since the one before
};

// Evenly spaced, and close to both sides of every line on which the force jumps.
std::vector<Sample> across(const Drawn& drawn);

// For gnuplot: enough digits for a plot; "NaN", which it leaves out, for what is not finite.
std::string plotted(double value);

// Commands of gnuplot. Axis is "x" or "y"; margins are fractions of the panel, seen from its lower left corner.
inline constexpr const char* kPlain =
    "set border 3 lc rgb '#777777'\n"
    "set tics nomirror out scale 0.5 textcolor rgb '#333333'\n"
    "set format '%g'\n"
    "unset key\n";
inline constexpr const char* kXName =
    "set xlabel \"{/:Italic x} (mm)\" offset 0, 0.7 textcolor rgb '#333333'\nset xtics offset 0, 0.3\n";
std::string range(const char* axis, double low, double high);
std::string margins(double left, double right, double top, double bottom);
// At 1, 2 or 5 times a power of ten, at most `count` of them over `length`.
std::string ticks(const char* axis, double length, int count);
// Names the vertical axis above its upper end, to be read without turning the head.
std::string vertical_name(const char* text);

// In single quotes, as it stands; a control character becomes a space.
std::string quoted(const std::string& text);

struct Panel {
  std::string heading;  // HTML
  std::string svg;
};

std::string legend_line(const std::string& border_colour, const std::string& words);

// columns: "two", "three" or "four", as many as fit. Everything is HTML; an empty legend is left out.
std::string figure(int number, const char* columns, const std::string& title, const std::string& legend,
                   const std::vector<Panel>& panels, const std::string& caption);

}  // namespace forceshade::properties

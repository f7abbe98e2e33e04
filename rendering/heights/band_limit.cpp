// SPDX-License-Identifier: BSD-3-Clause
#include "rendering/heights/band_limit.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <unsupported/Eigen/FFT>

namespace forceshade::heights {
namespace {

using Complex = std::complex<double>;

// The waves along one axis as n real numbers, and back: of a repeated line harmonic h has its cosine at 2h, its sine before
// that; of a mirrored one there are cosines alone. The shortest wave of all, two samples long, is left out: nothing keeps it.
// As the axes are transformed apart, number (i, j) belongs to waves (±frequency(i), ±frequency(j)).
class Axis {
 public:
  Axis(std::size_t n, height::Edge edge)
      : n_(n), length_(edge == height::Edge::tile ? n : 2 * n), line_(length_), spectrum_(length_ / 2 + 1) {
    fft_.SetFlag(Eigen::FFT<double>::HalfSpectrum);
    for (std::size_t i = 0; is_mirrored() && i < n; ++i)  // half a sample: from the edge of the mirror to the first sample
      turn_.push_back(std::polar(1.0, -std::numbers::pi * static_cast<double>(i) / static_cast<double>(length_)));
  }

  // Waves per sample.
  double frequency(std::size_t i) const {
    return static_cast<double>(is_mirrored() ? i : (i + 1) / 2) / static_cast<double>(length_);
  }

  void to_waves(double* data) {
    for (std::size_t i = 0; i < length_; ++i) line_[i] = data[i < n_ ? i : length_ - 1 - i];
    fft_.fwd(spectrum_.data(), line_.data(), static_cast<Eigen::Index>(length_));
    for (std::size_t i = 0; i < n_; ++i) {
      const Complex& wave = spectrum_[is_mirrored() ? i : (i + 1) / 2];
      data[i] = is_mirrored() ? (turn_[i] * wave).real() : i % 2 == 0 ? wave.real() : wave.imag();
    }
  }

  void to_heights(double* data) {
    std::fill(spectrum_.begin(), spectrum_.end(), 0);
    for (std::size_t i = 0; i < n_; ++i) {
      if (is_mirrored())
        spectrum_[i] = data[i] * std::conj(turn_[i]);
      else
        spectrum_[(i + 1) / 2] += i % 2 == 0 ? Complex(data[i], 0) : Complex(0, data[i]);
    }
    fft_.inv(line_.data(), spectrum_.data(), static_cast<Eigen::Index>(length_));
    std::copy_n(line_.begin(), n_, data);
  }

 private:
  bool is_mirrored() const { return length_ != n_; }

  std::size_t n_, length_;
  std::vector<double> line_;
  std::vector<Complex> spectrum_, turn_;
  Eigen::FFT<double> fft_;
};

// The remaining share of a wave of length l: share_squared is (L/l)².
double gain(double share_squared) {
  if (share_squared >= 1) return 0;
  return share_squared <= 0.25 ? 1 : 0.5 - 0.5 * std::cos(2 * std::numbers::pi * std::sqrt(share_squared));
}

}  // namespace

void limit_band(std::vector<float>& heights, std::uint32_t columns, std::uint32_t rows, height::Edge edge,
                double shortest_wavelength) {
  Axis across(columns, edge), up(rows, edge);
  std::vector<double> waves(heights.begin(), heights.end()), column(rows);
  for (std::size_t j = 0; j < rows; ++j) across.to_waves(&waves[j * columns]);
  for (std::size_t i = 0; i < columns; ++i) {
    const double x = across.frequency(i) * shortest_wavelength;
    if (x >= 1) {  // nothing is left of these
      for (std::size_t j = 0; j < rows; ++j) waves[j * columns + i] = 0;
      continue;
    }
    for (std::size_t j = 0; j < rows; ++j) column[j] = waves[j * columns + i];
    up.to_waves(column.data());
    for (std::size_t j = 0; j < rows; ++j) {
      const double y = up.frequency(j) * shortest_wavelength;
      column[j] *= gain(x * x + y * y);
    }
    up.to_heights(column.data());
    for (std::size_t j = 0; j < rows; ++j) waves[j * columns + i] = column[j];
  }
  for (std::size_t j = 0; j < rows; ++j) across.to_heights(&waves[j * columns]);
  for (std::size_t i = 0; i < waves.size(); ++i) heights[i] = static_cast<float>(waves[i]);
}

}  // namespace forceshade::heights

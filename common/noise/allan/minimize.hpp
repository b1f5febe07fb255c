#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace inslab::allan {

/// A minimum of `f` over as many variables as `start` has, by the simplex of Nelder and Mead (Computer Journal 7,
/// 1965): begins with steps of `step` and ends when the simplex's values differ by less than `tolerance`, or after 400
/// calls a variable. Returns the place and the value; f(start) where there is no variable.
template <class Function>
std::pair<std::vector<double>, double> minimize(const Function& f, std::vector<double> start, double step,
                                                double tolerance) {
  const std::size_t n = start.size();
  if (n == 0) return {start, f(start)};
  struct Vertex {
    std::vector<double> x;
    double value;
  };
  std::vector<Vertex> simplex{{start, f(start)}};
  for (std::size_t i = 0; i < n; ++i) {
    std::vector<double> x = start;
    x[i] += step;
    simplex.push_back({x, f(x)});
  }
  const auto by_value = [](const Vertex& a, const Vertex& b) { return a.value < b.value; };
  for (std::size_t calls = n + 1; calls < 400 * n;) {
    std::sort(simplex.begin(), simplex.end(), by_value);
    if (simplex.back().value - simplex.front().value < tolerance) break;
    Vertex& worst = simplex.back();
    std::vector<double> centre(n, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < n; ++j) centre[j] += simplex[i].x[j] / static_cast<double>(n);
    }
    const auto along = [&](double factor) {
      std::vector<double> x(n);
      for (std::size_t j = 0; j < n; ++j) x[j] = centre[j] + factor * (centre[j] - worst.x[j]);
      ++calls;
      const double value = f(x);
      return Vertex{std::move(x), value};
    };
    Vertex reflected = along(1.0);
    if (reflected.value < simplex.front().value) {
      Vertex expanded = along(2.0);
      worst = expanded.value < reflected.value ? std::move(expanded) : std::move(reflected);
      continue;
    }
    if (reflected.value < simplex[n - 1].value) {
      worst = std::move(reflected);
      continue;
    }
    Vertex contracted = along(reflected.value < worst.value ? 0.5 : -0.5);
    if (contracted.value < std::min(reflected.value, worst.value)) {
      worst = std::move(contracted);
      continue;
    }
    for (std::size_t i = 1; i <= n; ++i) {
      for (std::size_t j = 0; j < n; ++j) simplex[i].x[j] = 0.5 * (simplex[i].x[j] + simplex[0].x[j]);
      simplex[i].value = f(simplex[i].x);
      ++calls;
    }
  }
  const auto best = std::min_element(simplex.begin(), simplex.end(), by_value);
  return {best->x, best->value};
}

}  // namespace inslab::allan

#include "inslab/nav/cubic_spline.hpp"

namespace inslab::nav {

/// One linear equation a point makes the second derivatives of neighbouring cubics agree:
/// h_k m_(k-1) + 2 (h_(k-1) + h_k) m_k + h_(k-1) m_(k+1) = 3 (h_k D_(k-1) + h_(k-1) D_k), with D the chords' slopes.
/// Source: C. de Boor, A Practical Guide to Splines, chapter IV. Solved by elimination: the matrix is diagonally
/// dominant.
std::vector<Vector3> cubic_spline_slopes(const std::vector<double>& intervals, const std::vector<Vector3>& chord_slopes,
                                         const std::optional<Vector3>& first, const std::optional<Vector3>& last) {
  const std::vector<double>& h = intervals;
  const std::vector<Vector3>& D = chord_slopes;
  const std::size_t n = D.size();
  if (n == 1 && !first && !last) return {D[0], D[0]};
  std::vector<Vector3> m(n + 1);
  std::vector<double> above(n);  // what multiplies m_(k+1) in row k after elimination
  // A parabola's end slopes add up to twice its chord's.
  above[0] = first ? 0.0 : 1.0;
  m[0] = first ? *first : Vector3(2.0 * D[0]);
  for (std::size_t k = 1; k < n; ++k) {
    const double pivot = 2.0 * (h[k - 1] + h[k]) - h[k] * above[k - 1];
    above[k] = h[k - 1] / pivot;
    m[k] = (3.0 * (h[k] * D[k - 1] + h[k - 1] * D[k]) - h[k] * m[k - 1]) / pivot;
  }
  m[n] = last ? *last : Vector3((2.0 * D[n - 1] - m[n - 1]) / (1.0 - above[n - 1]));
  for (std::size_t k = n; k-- > 0;) m[k] -= above[k] * m[k + 1];
  return m;
}

}  // namespace inslab::nav

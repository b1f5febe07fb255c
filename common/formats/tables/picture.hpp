#pragma once

#include <stdexcept>
#include <string>
#include <vector>

/// Pictures of curves, drawn by gnuplot (the program of that name, a package of every distribution).
namespace inslab::tables {

/// gnuplot is not there, or did not like what it was given.
class PictureError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// One curve. `x` and `y` are equally long; a NaN interrupts the curve.
struct Curve {
  std::string title;  ///< in the panel's key; empty: none
  std::vector<double> x;
  std::vector<double> y;
  std::string style = "lines";  ///< gnuplot's words for it, such as "lines dashtype 2" or "points"
};

/// A stretch of x that is shaded from the bottom to the top of a panel.
struct Band {
  double begin = 0.0;
  double end = 0.0;
};

/// One diagram. Texts are plain: nothing in them is markup.
struct Panel {
  std::string title;
  std::string x_label;
  std::string y_label;
  std::vector<Curve> curves;
  std::vector<Band> bands;
  std::vector<double> marks;  ///< values of x with a dashed line from bottom to top
  bool equal_scales = false;  ///< a unit of x is as long as a unit of y
  double tic_step = 0.0;      ///< of both axes; 0: as gnuplot likes
  bool log_x = false;
  bool log_y = false;
  bool tight_x = false;  ///< x reaches from the first to the last value, not to the next tic
  bool has_key = true;
};

/// Panels in rows of `columns`.
struct Picture {
  std::string title;  ///< empty: none
  std::vector<Panel> panels;
  std::size_t columns = 1;
  int panel_width_px = 420;
  int panel_height_px = 300;
};

enum class PictureFormat { Svg, Png };

/// What gnuplot is told to draw the picture, its data included.
std::string gnuplot_script(const Picture& picture, PictureFormat format);

/// The picture as the bytes of a file. Throws PictureError, saying what is missing or what gnuplot said.
std::string drawn(const Picture& picture, PictureFormat format, const std::string& program = "gnuplot");

/// 1, 2 or 5 times a power of ten, some four to nine of which make the extent, which is above 0.
double tic_step_over(double extent);

/// At most 2 `bins` points of a curve over time that show it as all of them would: the smallest and the largest of each
/// bin and both ends, without those that a straight line shows as well. `x` increases; nothing is NaN.
Curve thinned(const Curve& curve, std::size_t bins);

/// The same of a curve that a logarithmic y axis shows; points whose y is not above 0 are left out.
Curve thinned_by_logarithm(const Curve& curve, std::size_t bins);

/// The points of a track further than `distance` from the last one kept, and the last; at most `most` in all, or else
/// the distance is doubled until they are.
Curve thinned_by_distance(const Curve& track, double distance, std::size_t most);

}  // namespace inslab::tables

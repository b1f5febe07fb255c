#include "inslab/formats/tables/picture.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <utility>

#include "inslab/foundation/files/unfinished.hpp"
#include "inslab/foundation/text/shown.hpp"

extern char** environ;

namespace inslab::tables {

namespace {

/// A text as gnuplot's own, without its markup.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text::shown(text)) {
    if (c == '\'') out += '\'';
    out += c;
  }
  return out + "'";
}

void write_data(std::ostringstream& script, const Curve& curve, std::size_t number) {
  script << "$curve" << number << " << end_of_data\n";
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    if (std::isfinite(curve.x[i]) && std::isfinite(curve.y[i])) {
      script << curve.x[i] << ' ' << curve.y[i] << '\n';
    } else {
      script << '\n';
    }
  }
  script << "end_of_data\n";
}

void write_panel(std::ostringstream& script, const Panel& panel, std::size_t first_curve) {
  // An empty line under the label: the key, which stands below it, would touch it.
  const bool room_for_key = panel.has_key && !panel.x_label.empty();
  script << "set title " << quoted(panel.title) << "\nset xlabel " << quoted(panel.x_label)
         << (room_for_key ? ".\"\\n\"" : "") << "\nset ylabel " << quoted(panel.y_label) << '\n';
  script << (panel.equal_scales ? "set size ratio -1\n" : "set size noratio\n");
  const std::string tics = panel.tic_step > 0.0 ? std::to_string(panel.tic_step) : "autofreq";
  script << "set xtics " << tics << "\nset ytics " << tics << '\n';
  script << (panel.log_x ? "set logscale x\n" : "unset logscale x\n")
         << (panel.log_y ? "set logscale y\n" : "unset logscale y\n") << "set format y '"
         << (panel.log_y ? "%g" : "% h") << "'\n";
  script << (panel.tight_x ? "set autoscale xfix\n" : "set autoscale x\n")
         << (panel.has_key ? "set key on\n" : "unset key\n");
  script << "unset object\nunset arrow\n";
  for (const Band& band : panel.bands) {
    script << "set object rectangle from first " << band.begin << ", graph 0 to first " << band.end
           << ", graph 1 behind fillcolor rgb '#9aa7b8' fillstyle solid 0.35 noborder\n";
  }
  for (const double mark : panel.marks) {
    script << "set arrow from first " << mark << ", graph 0 to first " << mark
           << ", graph 1 nohead dashtype 2 linecolor rgb '#505050'\n";
  }
  for (std::size_t i = 0; i < panel.curves.size(); ++i) {
    const Curve& curve = panel.curves[i];
    script << (i == 0 ? "plot " : ", ") << "$curve" << first_curve + i << " with " << curve.style
           << (curve.title.empty() ? " notitle" : " title " + quoted(curve.title));
  }
  script << '\n';
}

/// A file for gnuplot to read or write, gone afterwards.
class TemporaryFile {
 public:
  TemporaryFile() : path_((std::filesystem::temp_directory_path() / "inslab-plot-XXXXXX").string()) {
    const int descriptor = mkstemp(path_.data());
    if (descriptor < 0) throw PictureError("no temporary file for gnuplot: " + std::string(std::strerror(errno)));
    close(descriptor);
    unfinished_.emplace(path_);
  }
  ~TemporaryFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::string& path() const { return path_; }
  void write(const std::string& text) const { std::ofstream(path_, std::ios::binary) << text; }
  std::string read() const {
    std::ostringstream text;
    text << std::ifstream(path_, std::ios::binary).rdbuf();
    return text.str();
  }

 private:
  std::string path_;
  std::optional<files::UnfinishedFile> unfinished_;
};

/// Runs `program file` with its outputs in files; returns its wait status.
int run(const std::string& program, const std::string& file, const std::string& output, const std::string& messages) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, output.c_str(), O_WRONLY | O_TRUNC, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, messages.c_str(), O_WRONLY | O_TRUNC, 0);
  std::string name = program, argument = file;
  char* argv[] = {name.data(), argument.data(), nullptr};
  pid_t pid = 0;
  const int error = posix_spawnp(&pid, program.c_str(), &actions, nullptr, argv, environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) {
    throw PictureError(program + " cannot be run: " + std::strerror(error) +
                       "; pictures need gnuplot (Debian: the package gnuplot-nox)");
  }
  const int status = files::wait_for_program(pid);
  if (status < 0) throw PictureError("waiting for " + program + ": " + std::strerror(errno));
  return status;
}

/// Without the points that lie within a fraction of a pixel of the lines between those kept: D. Douglas, T. Peucker
/// (Cartographica 10 (1973) 112), with distances along y.
Curve without_straight_points(const Curve& curve) {
  if (curve.x.size() < 3) return curve;
  constexpr double kOfTheHeight = 1.0 / 2000.0;
  const auto [low, high] = std::minmax_element(curve.y.begin(), curve.y.end());
  const double tolerance = kOfTheHeight * (*high - *low);
  std::vector<bool> is_kept(curve.x.size(), false);
  is_kept.front() = is_kept.back() = true;
  std::vector<std::pair<std::size_t, std::size_t>> open{{0, curve.x.size() - 1}};
  while (!open.empty()) {
    const auto [begin, end] = open.back();
    open.pop_back();
    const double slope = (curve.y[end] - curve.y[begin]) / (curve.x[end] - curve.x[begin]);
    double largest = tolerance;
    std::size_t furthest = begin;
    for (std::size_t i = begin + 1; i < end; ++i) {
      const double off = std::abs(curve.y[begin] + slope * (curve.x[i] - curve.x[begin]) - curve.y[i]);
      if (off <= largest) continue;
      largest = off;
      furthest = i;
    }
    if (furthest == begin) continue;
    is_kept[furthest] = true;
    open.emplace_back(begin, furthest);
    open.emplace_back(furthest, end);
  }
  Curve kept{curve.title, {}, {}, curve.style};
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    if (!is_kept[i]) continue;
    kept.x.push_back(curve.x[i]);
    kept.y.push_back(curve.y[i]);
  }
  return kept;
}

}  // namespace

std::string gnuplot_script(const Picture& picture, PictureFormat format) {
  const std::size_t rows = (picture.panels.size() + picture.columns - 1) / picture.columns;
  std::ostringstream script;
  script.precision(7);
  script
      << "set encoding utf8\nset terminal " << (format == PictureFormat::Svg ? "svg" : "pngcairo")
      << " noenhanced size " << picture.panel_width_px * static_cast<int>(picture.columns) << ','
      << picture.panel_height_px * static_cast<int>(rows) + (picture.title.empty() ? 0 : 30)
      << " font 'sans,11' background rgb 'white'\n"
      << "set key outside bottom center horizontal\nset tics nomirror\nset border 3\n"
      << "set linetype 1 linecolor rgb '#0060ad' linewidth 1.2\nset linetype 2 linecolor rgb '#c03020' linewidth 1.2\n"
      << "set linetype 3 linecolor rgb '#208040' linewidth 1.2\n";
  std::size_t number = 0;
  for (const Panel& panel : picture.panels) {
    for (const Curve& curve : panel.curves) write_data(script, curve, number++);
  }
  // One below the other, panels of the same x have the same edges.
  if (picture.columns == 1 && picture.panels.size() > 1) script << "set lmargin 11\nset rmargin 3\n";
  script << "set multiplot layout " << rows << ',' << picture.columns;
  if (!picture.title.empty()) script << " title " << quoted(picture.title);
  script << '\n';
  number = 0;
  for (const Panel& panel : picture.panels) {
    write_panel(script, panel, number);
    number += panel.curves.size();
  }
  script << "unset multiplot\n";
  return script.str();
}

std::string drawn(const Picture& picture, PictureFormat format, const std::string& program) {
  const TemporaryFile script, output, messages;
  script.write(gnuplot_script(picture, format));
  const int status = run(program, script.path(), output.path(), messages.path());
  std::string bytes = output.read();
  if (status == 0 && !bytes.empty()) return bytes;
  throw PictureError(program + " drew nothing (wait status " + std::to_string(status) + "): " + messages.read());
}

double tic_step_over(double extent) {
  const double decade = std::pow(10.0, std::floor(std::log10(extent / 4.0)));
  const double leading = extent / 4.0 / decade;
  return decade * (leading >= 5.0 ? 5.0 : leading >= 2.0 ? 2.0 : 1.0);
}

Curve thinned(const Curve& curve, std::size_t bins) {
  Curve kept{curve.title, {}, {}, curve.style};
  const auto keep = [&](std::size_t i) {
    if (!kept.x.empty() && curve.x[i] <= kept.x.back()) return;
    kept.x.push_back(curve.x[i]);
    kept.y.push_back(curve.y[i]);
  };
  const std::size_t count = curve.x.size();
  if (count <= 2 * bins) return without_straight_points(curve);
  keep(0);
  for (std::size_t bin = 0; bin < bins - 1; ++bin) {
    const std::size_t begin = bin * count / (bins - 1), end = (bin + 1) * count / (bins - 1);
    const auto first = curve.y.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto last = curve.y.begin() + static_cast<std::ptrdiff_t>(end);
    const auto [low, high] = std::minmax_element(first, last);
    keep(static_cast<std::size_t>(std::min(low, high) - curve.y.begin()));
    keep(static_cast<std::size_t>(std::max(low, high) - curve.y.begin()));
  }
  keep(count - 1);
  return without_straight_points(kept);
}

Curve thinned_by_logarithm(const Curve& curve, std::size_t bins) {
  Curve logarithms{curve.title, {}, {}, curve.style};
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    if (!(curve.y[i] > 0.0)) continue;
    logarithms.x.push_back(curve.x[i]);
    logarithms.y.push_back(std::log10(curve.y[i]));
  }
  Curve kept = thinned(logarithms, bins);
  for (double& y : kept.y) y = std::pow(10.0, y);
  return kept;
}

Curve thinned_by_distance(const Curve& track, double distance, std::size_t most) {
  Curve kept{track.title, {}, {}, track.style};
  for (std::size_t i = 0; i < track.x.size(); ++i) {
    const bool is_near =
        !kept.x.empty() && std::hypot(track.x[i] - kept.x.back(), track.y[i] - kept.y.back()) <= distance;
    if (is_near && i + 1 < track.x.size()) continue;
    if (kept.x.size() >= most) return thinned_by_distance(track, 2.0 * distance, most);
    kept.x.push_back(track.x[i]);
    kept.y.push_back(track.y[i]);
  }
  return kept;
}

}  // namespace inslab::tables

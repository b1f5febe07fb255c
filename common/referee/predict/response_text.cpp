#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "inslab/foundation/units/units.hpp"
#include "inslab/referee/predict/response.hpp"

namespace inslab::predict {
namespace {

constexpr std::size_t kRowsOfASource = 12;

/// North, east, height (m), as the model has them and as the closed form does.
using Curves = std::array<double, 2>;
std::array<Curves, 3> positions(const Response& response, std::size_t k) {
  const ErrorState& x = response.errors[k];
  const ClosedForms& closed = response.closed[k];
  return {{{x[0], closed.north_m}, {x[1], closed.east_m}, {0.0 - x[2], closed.height_m}}};
}

}  // namespace

std::string table_text(const std::vector<Response>& responses) {
  std::string text;
  for (const Response& response : responses) {
    text += fmt::format("{}, m\n{:>10}{:>14}{:>14}{:>14}{:>14}{:>14}{:>14}{:>14}\n", response.source.text, "time, s",
                        "north", "(68)", "east", "(68)", "height", "(72)", "(73)");
    const std::size_t stride = std::max<std::size_t>(1, (response.time_s.size() - 1) / kRowsOfASource);
    for (std::size_t k = 0; k < response.time_s.size(); k += stride) {
      text += fmt::format("{:>10.1f}", response.time_s[k]);
      for (const Curves& pair : positions(response, k)) text += fmt::format("{:>14.6g}{:>14.6g}", pair[0], pair[1]);
      text += fmt::format("{:>14.6g}\n", response.closed[k].height_short_m);
    }
    text += "\n";
  }
  return text;
}

std::string csv_text(const std::vector<Response>& responses) {
  std::string text =
      "source,time_s,position_north_m,position_east_m,position_down_m,velocity_north_m_per_s,velocity_east_m_per_s,"
      "velocity_down_m_per_s,phi_north_deg,phi_east_deg,phi_down_deg,closed_68_north_m,closed_68_east_m,"
      "closed_72_height_m,closed_73_height_m\n";
  for (const Response& response : responses) {
    for (std::size_t k = 0; k < response.time_s.size(); ++k) {
      text += fmt::format("\"{}\",{:.12g}", response.source.text, response.time_s[k]);
      for (int state = 0; state < 9; ++state) {
        text += fmt::format(",{:.12g}", response.errors[k][state] * (state < 6 ? 1.0 : units::kDegPerRad));
      }
      const ClosedForms& closed = response.closed[k];
      text += fmt::format(",{:.12g},{:.12g},{:.12g},{:.12g}\n", closed.north_m, closed.east_m, closed.height_m,
                          closed.height_short_m);
    }
  }
  return text;
}

tables::Picture picture_of(const std::vector<Response>& responses, const std::string& title) {
  constexpr std::array<const char*, 3> kNames{"north (m)", "east (m)", "height (m)"};
  constexpr std::size_t kBins = 400;
  tables::Picture picture;
  picture.title = title;
  picture.columns = 3;
  for (const Response& response : responses) {
    for (std::size_t axis = 0; axis < kNames.size(); ++axis) {
      tables::Curve model{"linear model", {}, {}, "lines linewidth 2 linecolor rgb '#1f3f75'"};
      tables::Curve closed{"closed form", {}, {}, "lines dashtype 2 linewidth 1.5 linecolor rgb '#c03020'"};
      for (std::size_t k = 0; k < response.time_s.size(); ++k) {
        for (tables::Curve* curve : {&model, &closed}) curve->x.push_back(response.time_s[k] / 3600.0);
        model.y.push_back(positions(response, k)[axis][0]);
        closed.y.push_back(positions(response, k)[axis][1]);
      }
      tables::Panel panel;
      panel.title = response.source.text;
      panel.x_label = "time (h)";
      panel.y_label = kNames[axis];
      panel.tight_x = true;
      panel.curves = {tables::thinned(model, kBins), tables::thinned(closed, kBins)};
      picture.panels.push_back(panel);
    }
  }
  return picture;
}

}  // namespace inslab::predict

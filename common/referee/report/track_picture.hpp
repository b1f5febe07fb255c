#pragma once

#include <string>
#include <vector>

#include "inslab/data/samples/truth_state.hpp"
#include "inslab/formats/tables/picture.hpp"
#include "inslab/nav/attitude.hpp"
#include "inslab/nav/geodesy.hpp"
#include "inslab/scenario/load.hpp"

namespace inslab::report {

/// Where the vehicle was, over time; thinned to what a picture can show.
class Track {
 public:
  /// Adds a sample, or passes it over when there are so many that the picture would not show it.
  void add(const TruthState& truth);

  bool empty() const { return points_.empty(); }

  /// Track over the ground, height, speed, and attitude, with this title. The track is in NED at its first point.
  tables::Picture picture(const std::string& title) const;

 private:
  struct Point {
    double t_s;
    nav::Geodetic position;
    double speed_m_per_s;
    nav::RollPitchYaw rpy;
  };

  tables::Curve over_time(const std::string& title, double (*value)(const Point&)) const;
  tables::Panel ground_panel() const;
  tables::Panel attitude_panel() const;

  std::vector<Point> points_;
  std::uint64_t added_ = 0;
  std::uint64_t keep_every_ = 1;
};

/// The track of a scenario. Throws files::ReadError when it follows a live vehicle; as the truth model does.
Track track_of_scenario(const scenario::LoadedScenario& scenario);

/// The track in a log. Throws files::ReadError, also when the log holds no truth.
Track track_of_log(const std::string& log_path);

}  // namespace inslab::report

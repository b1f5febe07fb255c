#pragma once

#include <string>
#include <vector>

#include "inslab/formats/tables/picture.hpp"
#include "inslab/referee/predict/expected_errors.hpp"
#include "inslab/scenario/load.hpp"

namespace inslab::predict {

/// What is asked for, and the sigmas of each axis at the start.
struct PredictionOptions {
  std::uint32_t sensor_number = 0;
  double position_m = 0.0;
  double velocity_m_per_s = 0.0;
  double tilt_deg = 0.0;
  double yaw_deg = 0.0;
  bool hold_vertical = false;
  bool free_inertial = false;
  bool plumb_line = false;  ///< the start's attitude leans with gravity's departure there
};

/// What a run lets one expect, and when it has no fixes.
struct Prediction {
  ExpectedErrors errors;
  std::vector<tables::Band> outages = {};
};

/// Runs a scenario for what it lets one expect. Throws files::ReadError for one that follows a live vehicle.
Prediction predicted(const scenario::LoadedScenario& loaded, const PredictionOptions& options);

/// "demo: the best filter of the fixes of gnss 0 with imu 0, height free, 1 sigma"
std::string heading(const scenario::LoadedScenario& loaded, const PredictionOptions& options);

/// A dozen rows of the curve, for people.
std::string table_text(const std::vector<PredictedError>& errors);

/// All of it.
std::string csv_text(const std::vector<PredictedError>& errors);

tables::Picture picture_of(const Prediction& prediction, const scenario::Scenario& scenario);

}  // namespace inslab::predict

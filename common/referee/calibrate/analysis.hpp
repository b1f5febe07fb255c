#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "inslab/formats/recordings/imu_recording.hpp"
#include "inslab/noise/allan/chosen_fit.hpp"
#include "inslab/noise/allan/goodness.hpp"
#include "inslab/referee/calibrate/phase_store.hpp"

/// `inslab allan`: what the output of a recorded IMU says of its random errors.
namespace inslab::calibrate {

inline constexpr double kIntervalConfidence = 0.99;

/// A parameter with the values that the record does not speak against at 99 %.
struct FittedParameter {
  allan::Parameter parameter = allan::Parameter::White;
  double value = 0.0;  ///< SI
  allan::Interval interval;
};

/// A point of the curve with its confidence interval at 99 %, deviations in SI.
struct CurvePoint {
  double tau_s = 0.0;
  double deviation = 0.0;
  allan::Interval interval;
  double fitted = 0.0;  ///< of the fitted model
};

struct AxisAnalysis {
  std::size_t axis = 0;  ///< of recordings::kImuAxisNames
  double mean = 0.0;     ///< rad/s | m/s^2
  double span_s = 0.0;
  allan::Fit fit;
  std::vector<FittedParameter> parameters;
  allan::Goodness goodness;
  double finest_tau_s = 0.0;    ///< the fit begins there
  double fast_process_s = 0.0;  ///< correlation time of a process that is taken for white noise; 0: there is none
  std::vector<CurvePoint> curve;

  bool is_gyro() const { return axis < 3; }
};

struct AnalysisOptions {
  recordings::ImuRecordingOptions recording;
  std::vector<allan::Term> terms;  ///< none: those that the record speaks for
  double finest_tau_s = 0.0;       ///< smaller tau are shown, but not fitted
};

struct ImuAnalysis {
  std::string path;
  recordings::ImuRecordingInfo recording;
  bool is_error = false;  ///< the truth was taken off
  std::vector<AxisAnalysis> axes;
};

/// Analyses a recording that somebody else reads.
class ImuAnalyser {
 public:
  explicit ImuAnalyser(AnalysisOptions options) : options_(std::move(options)) {}

  /// Before the first sample.
  void begin(const recordings::ImuRecordingInfo& info);
  void add(const recordings::ImuIncrements& increments);

  /// Fits each axis that the recording has.
  ImuAnalysis finish(const std::string& path, const recordings::ImuRecordingInfo& recording) const;

 private:
  AnalysisOptions options_;
  std::array<bool, recordings::kImuAxes> has_axis_{};
  std::vector<allan::Record> records_;
  std::vector<PhaseStore> phases_;
};

/// "gyro x: the fit is poor: ...", of each axis whose fit is; empty when none is.
std::string poor_fits(const ImuAnalysis& analysis);

/// Reads the recording once and fits each axis it has. Throws files::ReadError, and files::WriteError of PhaseStore.
ImuAnalysis analyse_imu(const std::string& path, const AnalysisOptions& options);

}  // namespace inslab::calibrate

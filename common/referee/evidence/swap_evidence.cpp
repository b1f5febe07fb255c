#include "inslab/referee/evidence/swap_evidence.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/referee/evidence/air_data_evidence.hpp"
#include "inslab/referee/evidence/arm_evidence.hpp"
#include "inslab/referee/evidence/baseline_evidence.hpp"
#include "inslab/referee/evidence/evidence_lines.hpp"
#include "inslab/referee/evidence/evidence_uses.hpp"
#include "inslab/referee/evidence/imu_promise.hpp"
#include "inslab/referee/evidence/sample_joiner.hpp"
#include "inslab/referee/evidence/time_tag_evidence.hpp"

namespace inslab::evidence {

namespace {

constexpr std::uint64_t kFewest = 30;
/// Of a density, in the unit of a profile: what sums of doubles leave of rates up to 10 rad/s and forces up to 100
/// m/s^2.
constexpr double kRounding = 1e-13;
constexpr const char* kThroughTheBandwidth = ", as the bandwidth lets it pass";
double duration_s(const SwapWindow& window) { return time::to_seconds(window.until_ns - window.after_ns); }

/// A standard deviation, how many values tell as much of it as one independent one, and what may be added to its
/// tolerance.
struct Promised {
  double sigma;
  double values_per_independent;
  double more = 0.0;
};

/// One line for a white noise density: rate sigma times sqrt(dt), in the profile's unit.
EvidenceLine density_line(const std::string& quantity, const char* unit, double per_unit, const NoiseStatistics& before,
                          const NoiseStatistics& after, const Promised& promised_before, const Promised& promised_after,
                          double dt_s) {
  const auto measured = [&](const NoiseStatistics& series, const Promised& promised) {
    const double scale = std::sqrt(dt_s) / per_unit;
    return judged(series.pooled_white_sigma(kAllAxes) * scale, promised.sigma * scale,
                  sigma_tolerance(promised.sigma * scale, 3.0 * static_cast<double>(series.differences()),
                                  promised.values_per_independent) +
                      kRounding);
  };
  return {quantity, unit, measured(before, promised_before), measured(after, promised_after)};
}

EvidenceLine sigma_line(const std::string& quantity, const char* unit, double per_unit,
                        const ResidualStatistics& before, const ResidualStatistics& after,
                        const Promised& promised_before, const Promised& promised_after, double extra_relative) {
  const auto measured = [&](const ResidualStatistics& series, const Promised& promised) {
    const double values = 3.0 * static_cast<double>(series.count());
    return judged(series.pooled_sigma() / per_unit, promised.sigma / per_unit,
                  (sigma_tolerance(promised.sigma, values, promised.values_per_independent) +
                   extra_relative * promised.sigma + promised.more) /
                      per_unit);
  };
  return {quantity, unit, measured(before, promised_before), measured(after, promised_after)};
}

class Weigher {
 public:
  Weigher(const LogSummary& summary, const SwapWindows& swap) : summary_(summary), swap_(swap) {}

  /// Why nothing can be measured; empty when it can.
  std::string why_nothing() const {
    if (swap_.ack.kind == ProfileKind::Fault) return "a fault promises no figure; its samples and their flags show it";
    for (const SwapWindow* window : {&swap_.before, &swap_.after}) {
      const std::uint64_t pairs = series_of(*window).differences();
      if (pairs >= kFewest) continue;
      return fmt::format(
          "only {} pairs of usable samples {} it, in the {:.3f} s to its neighbour or the end; {} are needed", pairs,
          window == &swap_.before ? "before" : "after", std::max(0.0, duration_s(*window)), kFewest);
    }
    if (swap_.ack.target.kind == SensorKind::Odometer && std::min(way_m(swap_.before), way_m(swap_.after)) < 1.0) {
      return "the wheel rolled less than 1 m on a side of it";
    }
    if (swap_.ack.kind == ProfileKind::GnssError && (has_recording(swap_.before) || has_recording(swap_.after))) {
      return "the errors of a real receiver are on top, which promises nothing";
    }
    if (has_common_fault(swap_.before) || has_common_fault(swap_.after)) {
      return "a fault of the sensor's samples was in effect";
    }
    if (!is_imu() || swap_.ack.kind == ProfileKind::Installation) return "";
    const std::string before = promise(swap_.before).why_not(), after = promise(swap_.after).why_not();
    return !before.empty() ? before + " before it" : after.empty() ? "" : after + " after it";
  }

  std::vector<EvidenceLine> lines() const {
    std::vector<EvidenceLine> lines = lines_of_the_value();
    const std::vector<EvidenceLine> of_the_tag = time_tag_lines(summary_, swap_, period_s());
    lines.insert(lines.end(), of_the_tag.begin(), of_the_tag.end());
    return lines;
  }

 private:
  std::vector<EvidenceLine> lines_of_the_value() const {
    switch (swap_.ack.kind) {
      case ProfileKind::ImuError:
        return imu_error();
      case ProfileKind::Vibration:
        return vibration();
      case ProfileKind::Installation:
        return installation();
      case ProfileKind::GnssError:
        return gnss_error();
      case ProfileKind::MagnetometerError:
        return magnetometer();
      case ProfileKind::BarometerError:
        return barometer();
      case ProfileKind::OdometerError:
        return odometer();
      case ProfileKind::HeadingError:
        return baseline_noise_lines(summary_, swap_, period_s());
      case ProfileKind::AirDataError:
        return air_data_lines(summary_, swap_, period_s());
      case ProfileKind::Fault:
        break;
    }
    return {};
  }

  /// Of which there is an entry for every usable sample of the sensor.
  const NoiseStatistics& series_of(const SwapWindow& window) const {
    switch (swap_.ack.target.kind) {
      case SensorKind::Imu:
        return window.gyro_rad_per_s;
      case SensorKind::Gnss:
        return window.position_ned_m;
      case SensorKind::Magnetometer:
        return window.magnetic_nt;
      case SensorKind::Barometer:
        return window.pressure;
      case SensorKind::Heading:
        return window.baseline_ned_m;
      case SensorKind::AirData:
        return window.airflow;
      case SensorKind::Odometer:
        break;
    }
    return window.way_m;
  }
  std::vector<EvidenceLine> installation() const {
    switch (swap_.ack.target.kind) {
      case SensorKind::Imu:
        return imu_installation();
      case SensorKind::Gnss:
        return antenna_installation();
      case SensorKind::Magnetometer:
        return magnetometer();
      case SensorKind::Barometer:
        return barometer();
      case SensorKind::Heading:
        return baseline_lines(summary_, swap_);
      case SensorKind::AirData:
        return air_data_lines(summary_, swap_, period_s());
      case SensorKind::Odometer:
        break;
    }
    return odometer();
  }
  bool is_imu() const { return swap_.ack.target.kind == SensorKind::Imu; }
  double period_s() const {
    double period_s = 0.0;
    for_each_sensor(summary_.scenario, [&](auto kind, const auto& sensor) {
      if (SensorAddress{decltype(kind)::type::kind, sensor.number} == swap_.ack.target) period_s = 1.0 / sensor.rate_hz;
    });
    return period_s;
  }
  ImuPromise promise(const SwapWindow& window) const {
    return ImuPromise(summary_, swap_.ack.target, window.after_ns + 1, period_s());
  }
  template <class Profile>
  Profile in_use(const SwapWindow& window) const {
    return profile_in_use<Profile>(summary_, swap_.ack.target, window.after_ns + 1);
  }

  bool has_recording(const SwapWindow& window) const {
    return !in_use<GnssErrorProfile>(window).recorded_error.file.empty();
  }

  bool has_common_fault(const SwapWindow& window) const { return !in_use<FaultProfile>(window).common.are_none(); }

  std::vector<EvidenceLine> imu_error() const {
    const ImuPromise before = promise(swap_.before);
    const ImuPromise after = promise(swap_.after);
    const std::string through = before.is_filtered() || after.is_filtered() ? kThroughTheBandwidth : "";
    const auto promised = [](const ImuPromise& from, double sigma) {
      return Promised{sigma, from.differences_per_independent()};
    };
    return {density_line("gyro white noise" + through, "deg/sqrt(h)", units::kDegPerSqrtH, swap_.before.gyro_rad_per_s,
                         swap_.after.gyro_rad_per_s, promised(before, before.gyro_white_sigma()),
                         promised(after, after.gyro_white_sigma()), period_s()),
            density_line("accelerometer white noise" + through, "m/s/sqrt(h)", units::kMPerSPerSqrtH,
                         swap_.before.accel_m_per_s2, swap_.after.accel_m_per_s2,
                         promised(before, before.accel_white_sigma()), promised(after, after.accel_white_sigma()),
                         period_s())};
  }

  std::vector<EvidenceLine> vibration() const {
    const ImuPromise before = promise(swap_.before);
    const ImuPromise after = promise(swap_.after);
    const std::string through = before.is_filtered() || after.is_filtered() ? kThroughTheBandwidth : "";
    const auto accel = [](const ImuPromise& from, const SwapWindow& window) {
      const std::uint64_t samples = window.accel_residual_m_per_s2.count();
      return Promised{from.accel_sigma(samples), from.values_per_independent(), from.accel_sigma_error(samples)};
    };
    const auto gyro = [](const ImuPromise& from, const SwapWindow& window) {
      const std::uint64_t samples = window.gyro_residual_rad_per_s.count();
      return Promised{from.gyro_sigma(samples), from.values_per_independent(), from.gyro_sigma_error(samples)};
    };
    const double extra =
        std::max(before.spread_error(duration_s(swap_.before)), after.spread_error(duration_s(swap_.after)));
    return {
        sigma_line("specific force, noise and vibration" + through, "m/s^2", 1.0, swap_.before.accel_residual_m_per_s2,
                   swap_.after.accel_residual_m_per_s2, accel(before, swap_.before), accel(after, swap_.after), extra),
        sigma_line("angular rate, noise and vibration" + through, "deg/s", units::kDeg,
                   swap_.before.gyro_residual_rad_per_s, swap_.after.gyro_residual_rad_per_s,
                   gyro(before, swap_.before), gyro(after, swap_.after), extra)};
  }

  std::vector<EvidenceLine> imu_installation() const {
    return arms("IMU arm", swap_.before.imu_arm_v_m, swap_.after.imu_arm_v_m, promise(swap_.before).mount_reach_m(),
                promise(swap_.after).mount_reach_m());
  }
  std::vector<EvidenceLine> antenna_installation() const {
    // White noise averages out over the fixes of a window; a Gauss-Markov error as slow as the window does not.
    const auto mean_error_m = [this](const SwapWindow& window) {
      const auto profile = in_use<GnssErrorProfile>(window);
      return std::hypot(
          profile.position_sigma_ned_m.maxCoeff() / std::sqrt(static_cast<double>(window.antenna_arm_v_m.count())),
          profile.position_gm_sigma_ned_m.maxCoeff());
    };
    return arms("antenna arm", swap_.before.antenna_arm_v_m, swap_.after.antenna_arm_v_m, mean_error_m(swap_.before),
                mean_error_m(swap_.after));
  }
  std::vector<EvidenceLine> arms(const std::string& name, const NoiseStatistics& before, const NoiseStatistics& after,
                                 double error_before_m, double error_after_m) const {
    const auto arm_v_m = [this](const SwapWindow& window) { return in_use<InstallationProfile>(window).lever_arm_v_m; };
    return arm_lines(name, {before, arm_v_m(swap_.before), error_before_m},
                     {after, arm_v_m(swap_.after), error_after_m});
  }

  /// Noise, and what stands: under the true place, angles and iron that is the hard iron.
  std::vector<EvidenceLine> magnetometer() const {
    const auto before = in_use<MagnetometerErrorProfile>(swap_.before);
    const auto after = in_use<MagnetometerErrorProfile>(swap_.after);
    // A count is as good as uniform noise of its width where the noise is not much narrower.
    const auto white = [](const MagnetometerErrorProfile& p) {
      return Vector3((p.white_sigma_nt.cwiseAbs2() + p.quantization_nt.cwiseAbs2() / 12.0).cwiseSqrt());
    };
    const auto noise = [&](const MagnetometerErrorProfile& p) {
      return promised_difference_sigma(white(p), p.gm_sigma_nt, p.gm_correlation_time_s, period_s(), kAllAxes);
    };
    std::vector<EvidenceLine> lines{fix_line("magnetic noise", "nT", swap_.before.magnetic_nt, swap_.after.magnetic_nt,
                                             noise(before), noise(after), kAllAxes)};
    const auto standing = [&](const SwapWindow& window, const MagnetometerErrorProfile& p, int axis) {
      constexpr double kFieldNt = 0.1;  // to which the model of the Earth is interpolated
      const double error_nt =
          std::hypot(white(p)[axis] / std::sqrt(static_cast<double>(window.magnetic_nt.count())), p.gm_sigma_nt[axis]);
      return judged(window.magnetic_nt.mean()[axis], p.hard_iron_nt[axis], 4.0 * error_nt + kFieldNt);
    };
    static constexpr const char* kAxes[] = {"hard iron x", "hard iron y", "hard iron z"};
    for (int axis = 0; axis < 3; ++axis) {
      lines.push_back({kAxes[axis], "nT", standing(swap_.before, before, axis), standing(swap_.after, after, axis)});
    }
    return lines;
  }

  /// Noise, and what stands: in the air that the profile describes that is the offset.
  std::vector<EvidenceLine> barometer() const {
    static const Vector3 kPressure(1.0, 0.0, 0.0);
    constexpr double kPaPerKM = 0.042;  // of the pressure by the air's temperature, for each metre above the sea
    const auto noise = [&](const SwapWindow& window) {
      const auto p = in_use<BarometerErrorProfile>(window);
      const double white_pa = std::hypot(p.white_sigma_pa, p.quantization_pa / std::sqrt(12.0));
      const double by_temperature_pa = p.temperature_deviation_gm_sigma_deg_c * kPaPerKM * window.pressure.mean().y();
      const Vector3 sigma(p.gm_sigma_pa, p.sea_level_pressure_gm_sigma_pa, std::abs(by_temperature_pa));
      const Vector3 time_s(p.gm_correlation_time_s, p.sea_level_pressure_gm_correlation_time_s,
                           p.temperature_deviation_gm_correlation_time_s);
      const double drifts = promised_difference_sigma(Vector3::Zero(), sigma, time_s, period_s(), kAllAxes);
      return std::hypot(white_pa, std::sqrt(3.0) * drifts);
    };
    const auto standing = [&](const SwapWindow& window) {
      const auto p = in_use<BarometerErrorProfile>(window);
      const double white_pa = std::hypot(p.white_sigma_pa, p.quantization_pa / std::sqrt(12.0));
      const double air_pa = std::hypot(p.sea_level_pressure_gm_sigma_pa,
                                       p.temperature_deviation_gm_sigma_deg_c * kPaPerKM * window.pressure.mean().y());
      const double error_pa =
          std::hypot(white_pa / std::sqrt(static_cast<double>(window.pressure.count())), p.gm_sigma_pa, air_pa);
      return judged(window.pressure.mean().x(), p.offset_pa, 4.0 * error_pa + 1e-3);
    };
    return {fix_line("pressure noise", "Pa", swap_.before.pressure, swap_.after.pressure, noise(swap_.before),
                     noise(swap_.after), kPressure),
            {"pressure offset", "Pa", standing(swap_.before), standing(swap_.after)}};
  }

  static double way_m(const SwapWindow& window) {
    return window.way_m.mean().y() * static_cast<double>(window.way_m.count());
  }

  /// The scale factor: what all intervals together show too much of the way.
  std::vector<EvidenceLine> odometer() const {
    const auto scale = [this](const SwapWindow& window) {
      const auto p = in_use<OdometerErrorProfile>(window);
      const double count_m = p.counts_per_revolution > 0.0 ? p.wheel_circumference_m / p.counts_per_revolution : 0.0;
      const double road = p.noise_m_per_sqrt_m / std::sqrt(way_m(window));
      const double drawn = units::kPpm * std::hypot(p.scale_factor_turn_on_sigma_ppm, p.scale_factor_gm_sigma_ppm);
      const double tolerance = 4.0 * std::hypot(road, drawn) + count_m / way_m(window) + 1e-6;
      return judged(window.way_m.mean().x() / window.way_m.mean().y() / units::kPpm, p.scale_factor_ppm,
                    tolerance / units::kPpm);
    };
    return {{"scale factor of the wheel", "ppm", scale(swap_.before), scale(swap_.after)}};
  }

  std::vector<EvidenceLine> gnss_error() const {
    const auto before = in_use<GnssErrorProfile>(swap_.before);
    const auto after = in_use<GnssErrorProfile>(swap_.after);
    const auto position = [&](const char* name, const Vector3& mask) {
      const auto promised = [&](const GnssErrorProfile& p) {
        return promised_difference_sigma(p.position_sigma_ned_m, p.position_gm_sigma_ned_m,
                                         p.position_gm_correlation_time_s, period_s(), mask);
      };
      return fix_line(name, "m", swap_.before.position_ned_m, swap_.after.position_ned_m, promised(before),
                      promised(after), mask);
    };
    const auto velocity = [&](const GnssErrorProfile& p) {
      return promised_difference_sigma(p.velocity_sigma_ned_m_per_s, p.velocity_gm_sigma_ned_m_per_s,
                                       p.velocity_gm_correlation_time_s, period_s(), kAllAxes);
    };
    return {position("horizontal position noise", kHorizontal), position("vertical position noise", kVertical),
            fix_line("velocity noise", "m/s", swap_.before.velocity_ned_m_per_s, swap_.after.velocity_ned_m_per_s,
                     velocity(before), velocity(after), kAllAxes)};
  }

  const LogSummary& summary_;
  const SwapWindows& swap_;
};

}  // namespace

bool SwapEvidence::holds() const {
  return first_sample_holds && std::all_of(lines.begin(), lines.end(), [](const EvidenceLine& line) {
           return line.before.holds && line.after.holds;
         });
}

/// The windows, and what brings samples together for them.
struct SwapWeigher::Gathered {
  explicit Gathered(const LogSummary& log_summary) : summary(log_summary), windows(log_summary), joiner(windows) {}
  const LogSummary& summary;
  SwapWindowsOfLog windows;
  SampleJoiner joiner;
};

SwapWeigher::SwapWeigher(const LogSummary& summary) : gathered_(std::make_unique<Gathered>(summary)) {}
SwapWeigher::~SwapWeigher() = default;

void SwapWeigher::take_part(log::LogWalk& walk) {
  if (!gathered_->windows.all().empty()) gathered_->joiner.take_part(walk);
}

std::vector<SwapEvidence> SwapWeigher::finish() {
  gathered_->joiner.finish();
  std::vector<SwapEvidence> evidence;
  for (const SwapWindows& swap : gathered_->windows.all()) {
    SwapEvidence weighed;
    weighed.ack = swap.ack;
    weighed.profile_name = catalog::name_of(*swap.profile);
    weighed.left_out = names_left_out(*swap.profile);
    weighed.first_sample_holds = swap.first_sequence_seen == swap.ack.first_sequence;
    const Weigher weigher(gathered_->summary, swap);
    weighed.why_nothing = weigher.why_nothing();
    if (weighed.why_nothing.empty()) weighed.lines = weigher.lines();
    evidence.push_back(weighed);
  }
  return evidence;
}

std::vector<SwapEvidence> weigh_swaps(const mcap::McapReader& log, const LogSummary& summary) {
  SwapWeigher weigher(summary);
  log::LogWalk walk(log);
  weigher.take_part(walk);
  walk.go();
  return weigher.finish();
}

}  // namespace inslab::evidence

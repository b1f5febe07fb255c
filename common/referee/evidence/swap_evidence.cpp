#include "inslab/referee/evidence/swap_evidence.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "inslab/foundation/units/units.hpp"
#include "inslab/referee/evidence/evidence_uses.hpp"
#include "inslab/referee/evidence/imu_promise.hpp"
#include "inslab/referee/evidence/sample_joiner.hpp"

namespace inslab::evidence {

namespace {

constexpr std::uint64_t kFewest = 30;
constexpr const char* kThroughTheBandwidth = ", as the bandwidth lets it pass";
const Vector3 kAllAxes(1.0, 1.0, 1.0);
const Vector3 kHorizontal(1.0, 1.0, 0.0);
const Vector3 kVertical(0.0, 0.0, 1.0);

Measured judged(double value, double promised, double tolerance) {
  return {value, promised, tolerance, std::abs(value - promised) <= tolerance};
}

/// Values of which so many tell as much as one independent one. First differences of white noise overlap: 1.5.
constexpr double kWhiteDifferences = 1.5;

/// Standard deviation from n independent values has the relative standard error sqrt(1/(2n)).
double sigma_tolerance(double promised, double values, double per_independent = 1.0) {
  return 4.0 * promised * std::sqrt(per_independent / (2.0 * values));
}

double mean_square(const Vector3& v, const Vector3& mask) { return v.cwiseProduct(v).dot(mask) / mask.sum(); }

double duration_s(const SwapWindow& window) { return static_cast<double>(window.until_ns - window.after_ns) * 1e-9; }

/// A standard deviation, and how many values tell as much of it as one independent one.
struct Promised {
  double sigma;
  double values_per_independent;
};

/// One line for a white noise density: rate sigma times sqrt(dt), in the profile's unit.
EvidenceLine density_line(const std::string& quantity, const char* unit, double per_unit, const NoiseStatistics& before,
                          const NoiseStatistics& after, const Promised& promised_before, const Promised& promised_after,
                          double dt_s) {
  const auto measured = [&](const NoiseStatistics& series, const Promised& promised) {
    const double scale = std::sqrt(dt_s) / per_unit;
    return judged(series.pooled_white_sigma(kAllAxes) * scale, promised.sigma * scale,
                  sigma_tolerance(promised.sigma * scale, 3.0 * static_cast<double>(series.differences()),
                                  promised.values_per_independent));
  };
  return {quantity, unit, measured(before, promised_before), measured(after, promised_after)};
}

EvidenceLine sigma_line(const std::string& quantity, const char* unit, double per_unit,
                        const ResidualStatistics& before, const ResidualStatistics& after,
                        const Promised& promised_before, const Promised& promised_after, double extra_relative) {
  const auto measured = [&](const ResidualStatistics& series, const Promised& promised) {
    const double values = 3.0 * static_cast<double>(series.count());
    return judged(
        series.pooled_sigma() / per_unit, promised.sigma / per_unit,
        (sigma_tolerance(promised.sigma, values, promised.values_per_independent) + extra_relative * promised.sigma) /
            per_unit);
  };
  return {quantity, unit, measured(before, promised_before), measured(after, promised_after)};
}

/// One line for the noise of fixes, from first differences: of a Gauss-Markov error, which is slow, they pass the power
/// 1 - exp(-dt/T).
EvidenceLine fix_line(const char* quantity, const char* unit, const NoiseStatistics& before,
                      const NoiseStatistics& after, double promised_before, double promised_after,
                      const Vector3& mask) {
  const auto measured = [&](const NoiseStatistics& series, double promised) {
    return judged(series.pooled_white_sigma(mask), promised,
                  sigma_tolerance(promised, mask.sum() * static_cast<double>(series.differences()), kWhiteDifferences));
  };
  return {quantity, unit, measured(before, promised_before), measured(after, promised_after)};
}

/// What fix_line() should find for a white and a Gauss-Markov error, pooled over the axes of `mask`.
double promised_difference_sigma(const Vector3& white, const Vector3& gm_sigma, const Vector3& correlation_time_s,
                                 double dt_s, const Vector3& mask) {
  Vector3 passed = Vector3::Zero();
  for (int axis = 0; axis < 3; ++axis) {
    if (gm_sigma[axis] > 0.0) passed[axis] = gm_sigma[axis] * std::sqrt(-std::expm1(-dt_s / correlation_time_s[axis]));
  }
  return std::sqrt(mean_square(white, mask) + mean_square(passed, mask));
}

/// One line for one axis of an arm, of which the series shows the mean with the given standard error.
EvidenceLine arm_line(const std::string& quantity, int axis, const NoiseStatistics& before,
                      const NoiseStatistics& after, const Vector3& promised_before, const Vector3& promised_after,
                      double error_before_m, double error_after_m) {
  constexpr double kResolution_m = 1e-6;
  const auto measured = [&](const NoiseStatistics& series, const Vector3& promised, double error_m) {
    return judged(series.mean()[axis], promised[axis], 4.0 * error_m + kResolution_m);
  };
  return {quantity, "m", measured(before, promised_before, error_before_m),
          measured(after, promised_after, error_after_m)};
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
    if (!is_imu() || swap_.ack.kind == ProfileKind::Installation) return "";
    const std::string before = promise(swap_.before).why_not(), after = promise(swap_.after).why_not();
    return !before.empty() ? before + " before it" : after.empty() ? "" : after + " after it";
  }

  std::vector<EvidenceLine> lines() const {
    const bool imu = is_imu();
    switch (swap_.ack.kind) {
      case ProfileKind::ImuError:
        return imu_error();
      case ProfileKind::Vibration:
        return vibration();
      case ProfileKind::Installation:
        if (swap_.ack.target.kind == SensorKind::Gnss) return antenna_installation();
        return imu ? imu_installation() : magnetometer();
      case ProfileKind::GnssError:
        return gnss_error();
      case ProfileKind::MagnetometerError:
        return magnetometer();
      case ProfileKind::Fault:
        break;
    }
    return {};
  }

 private:
  /// Of which there is an entry for every usable sample of the sensor.
  const NoiseStatistics& series_of(const SwapWindow& window) const {
    switch (swap_.ack.target.kind) {
      case SensorKind::Imu:
        return window.gyro_rad_per_s;
      case SensorKind::Gnss:
        return window.position_ned_m;
      case SensorKind::Magnetometer:
        break;
    }
    return window.magnetic_nt;
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
    const catalog::AnyProfile* profile = summary_.in_use(Profile::kind, swap_.ack.target, window.after_ns + 1);
    return profile ? std::get<Profile>(*profile) : Profile{};
  }

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
    const auto promised = [](const ImuPromise& from, double sigma) {
      return Promised{sigma, from.values_per_independent()};
    };
    const double extra =
        std::max(before.spread_error(duration_s(swap_.before)), after.spread_error(duration_s(swap_.after)));
    return {sigma_line("specific force, noise and vibration" + through, "m/s^2", 1.0,
                       swap_.before.accel_residual_m_per_s2, swap_.after.accel_residual_m_per_s2,
                       promised(before, before.accel_sigma()), promised(after, after.accel_sigma()), extra),
            sigma_line("angular rate, noise and vibration" + through, "deg/s", units::kDeg,
                       swap_.before.gyro_residual_rad_per_s, swap_.after.gyro_residual_rad_per_s,
                       promised(before, before.gyro_sigma()), promised(after, after.gyro_sigma()), extra)};
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
    const Vector3 promised_before = in_use<InstallationProfile>(swap_.before).lever_arm_v_m;
    const Vector3 promised_after = in_use<InstallationProfile>(swap_.after).lever_arm_v_m;
    static constexpr const char* kAxes[] = {" forward", " right", " down"};
    std::vector<EvidenceLine> lines;
    for (int axis = 0; axis < 3; ++axis) {
      lines.push_back(arm_line(name + kAxes[axis], axis, before, after, promised_before, promised_after, error_before_m,
                               error_after_m));
    }
    return lines;
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

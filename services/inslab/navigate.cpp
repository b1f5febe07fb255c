#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <map>
#include <memory>

#include "app/exit_code.hpp"
#include "io/error.hpp"
#include "io/gnss_text.hpp"
#include "io/imu_text.hpp"
#include "io/log_topic.hpp"
#include "io/nav_text.hpp"
#include "nav/attitude.hpp"
#include "samples/imu_truth.hpp"
#include "samples/units.hpp"
#include "scenario/load.hpp"
#include "services/inslab/commands.hpp"
#include "services/reference_nav/matching_parameters.hpp"
#include "services/reference_nav/navigation_filter.hpp"
#include "services/reference_nav/parameters_file.hpp"
#include "wire/topic_names.hpp"

namespace inslab::cli {
namespace {

struct NavigateOptions {
  std::string log;
  std::string imu_file;
  std::string gnss_file;
  std::string parameters;
  std::string scenario;
  std::string output;
  std::uint32_t imu_number = 0;
  std::uint32_t gnss_number = 0;
  std::uint32_t gps_week = 0;
  bool start_at_truth = false;
};

/// Errors against the truth of a log.
struct ErrorSums {
  double count = 0.0;
  Vector3 position_squares = Vector3::Zero();
  Vector3 velocity_squares = Vector3::Zero();
  Vector3 attitude_squares = Vector3::Zero();
  double largest_horizontal_m = 0.0;

  void add(const NavSolution& found, const ImuTruth& truth) {
    const Vector3 error_m = nav::ned_from({truth.latitude_rad, truth.longitude_rad, truth.height_m},
                                          {found.latitude_rad, found.longitude_rad, found.height_m});
    const nav::RollPitchYaw a = nav::rpy_from_quaternion(found.q_n_body), b = nav::rpy_from_quaternion(truth.q_nb);
    const Vector3 angles(nav::wrapped_to_pi(a.roll_rad - b.roll_rad), a.pitch_rad - b.pitch_rad,
                         nav::wrapped_to_pi(a.yaw_rad - b.yaw_rad));
    count += 1.0;
    position_squares += error_m.cwiseAbs2();
    velocity_squares += (found.v_n - truth.v_n).cwiseAbs2();
    attitude_squares += angles.cwiseAbs2();
    largest_horizontal_m = std::max(largest_horizontal_m, error_m.head<2>().norm());
  }

  std::string text() const {
    const Vector3 r = (position_squares / count).cwiseSqrt(), v = (velocity_squares / count).cwiseSqrt();
    const Vector3 a = (attitude_squares / count).cwiseSqrt() / units::kDeg;
    return fmt::format(
        "against the IMU's truth, RMS: position north {:.4f} east {:.4f} down {:.4f} m (largest horizontal {:.4f}); "
        "velocity {:.5f} {:.5f} {:.5f} m/s; roll {:.5f} pitch {:.5f} yaw {:.5f} deg\n",
        r.x(), r.y(), r.z(), largest_horizontal_m, v.x(), v.y(), v.z(), a.x(), a.y(), a.z());
  }
};

/// The 11-column result and, line by line beside it, the standard deviations.
class ResultFiles {
 public:
  explicit ResultFiles(const std::string& stem) : solution_(stem + ".nav"), sigmas_(stem + "_sigmas.txt", " ") {}

  void write(const NavSolution& s) {
    io::TrajectoryRow row;
    row.position = {s.latitude_rad, s.longitude_rad, s.height_m};
    row.v_n = s.v_n;
    row.rpy = nav::rpy_from_quaternion(s.q_n_body);
    solution_.write({s.gps_week, s.gps_time_of_week_ns}, row);
    sigmas_.integer(s.gps_week).number(static_cast<double>(s.gps_time_of_week_ns) * 1e-9, 9);
    for (const double sigma : s.position_sigma_ned_m) sigmas_.number(sigma, 6);
    for (const double sigma : s.velocity_sigma_ned_m_per_s) sigmas_.number(sigma, 6);
    for (const double sigma : s.attitude_sigma_rad) sigmas_.number(sigma / units::kDeg, 9);
    sigmas_.end_line();
    ++rows_;
  }
  void close() {
    solution_.close();
    sigmas_.close();
  }
  std::uint64_t rows() const { return rows_; }

 private:
  io::NavTextWriter solution_;
  io::TextWriter sigmas_;
  std::uint64_t rows_ = 0;
};

bool navigates(const NavSolution& solution) {
  return solution.mode == NavMode::Navigating || solution.mode == NavMode::Coasting;
}

struct Told {
  reference_nav::NavigationParameters parameters;
  nav::Gravity gravity;
};

/// From a file of parameters, or those that match the scenario's sensors as the app is told they are mounted.
Told told(const NavigateOptions& options) {
  Told t;
  if (!options.scenario.empty()) {
    const scenario::LoadedScenario loaded = scenario::load(options.scenario, {}, scenario::TrajectoryRows::LeaveOut);
    const scenario::LoadedImu& imu = loaded.imu_number(options.imu_number);
    t.parameters = reference_nav::matching_parameters(imu.errors, imu.nominal_installation,
                                                      loaded.gnss_number(options.gnss_number).nominal_installation);
    t.gravity = loaded.gravity();
  }
  if (!options.parameters.empty()) {
    t.parameters = reference_nav::read_parameters(options.parameters);
  }
  return t;
}

/// Feeds the fixes that are valid up to a time, in their order.
class FixFeed {
 public:
  explicit FixFeed(std::vector<GnssFix> fixes) : fixes_(std::move(fixes)) {}
  void feed(std::int64_t up_to_ns, reference_nav::NavigationFilter& filter) {
    for (; next_ < fixes_.size() && fixes_[next_].header.sim_time_ns <= up_to_ns; ++next_) filter.add(fixes_[next_]);
  }

 private:
  std::vector<GnssFix> fixes_;
  std::size_t next_ = 0;
};

int finish(ResultFiles& files, const NavigateOptions& options, const reference_nav::NavigationFilter& filter) {
  files.close();
  if (files.rows() == 0) {
    const std::string& why = filter.alignment_refusal();
    std::cerr << "inslab navigate: no solution: " << (why.empty() ? "the filter never began" : why) << "\n";
    return app::kFailed;
  }
  const auto& counts = filter.counts();
  fmt::print("{} solutions in {}.nav, standard deviations in {}_sigmas.txt\n", files.rows(), options.output,
             options.output);
  fmt::print("fixes not used {}, too old {}; IMU samples not valid {}, out of order {}, gaps {}; begun anew {} times\n",
             counts.fixes_not_used, counts.fixes_too_old, counts.imu_not_valid, counts.imu_out_of_order,
             counts.imu_gaps, counts.restarts);
  return app::kOk;
}

int navigate_log(const NavigateOptions& options) {
  const io::McapReader log(options.log);
  const Told t = told(options);
  std::vector<GnssFix> fixes;
  io::for_each_sample<GnssFix>(log, wire::topic_names::gnss(options.gnss_number),
                               [&](const GnssFix& fix, std::uint64_t) {
                                 fixes.push_back(fix);
                                 return true;
                               });
  std::map<std::int64_t, ImuTruth> truths;
  const std::string truth_topic = wire::topic_names::imu_truth(options.imu_number);
  if (!io::channels_of(log, truth_topic, wire::WireType<ImuTruth>::name).empty()) {
    io::for_each_sample<ImuTruth>(log, truth_topic, [&](const ImuTruth& truth, std::uint64_t) {
      truths.emplace(truth.header.sim_time_ns, truth);
      return true;
    });
  }
  reference_nav::NavigationFilter filter(t.parameters, t.gravity);
  FixFeed feed(std::move(fixes));
  ResultFiles files(options.output);
  ErrorSums errors;
  bool begun = !options.start_at_truth;
  if (!begun && truths.empty()) throw io::ReadError(options.log + ": has no " + truth_topic + " to start at");
  io::for_each_sample<ImuSample>(
      log, wire::topic_names::imu(options.imu_number), [&](const ImuSample& sample, std::uint64_t) {
        const auto truth = truths.find(sample.header.sim_time_ns);
        if (!begun && truth != truths.end()) {
          const ImuTruth& at = truth->second;
          filter.start({{at.latitude_rad, at.longitude_rad, at.height_m}, at.v_n, at.q_nb}, at.header.sim_time_ns);
          begun = true;
          return true;
        }
        feed.feed(sample.header.sim_time_ns, filter);
        const auto solution = filter.add(sample);
        if (!solution || !navigates(*solution)) return true;
        files.write(*solution);
        if (truth != truths.end()) errors.add(*solution, truth->second);
        return true;
      });
  const int code = finish(files, options, filter);
  if (errors.count > 0.0) fmt::print("{}", errors.text());
  return code;
}

/// A position of the 7-column text; it has no velocity, which a sigma of 0 says.
GnssFix fix_of(const io::GnssTextRecord& record) {
  GnssFix fix;
  fix.header.sim_time_ns = record.in_week.count();
  fix.fix_type = FixType::Single;
  fix.latitude_rad = record.position.latitude_rad;
  fix.longitude_rad = record.position.longitude_rad;
  fix.height_m = record.position.height_m;
  fix.position_sigma_ned_m = record.sigma_ned_m;
  return fix;
}

int navigate_files(const NavigateOptions& options) {
  const Told t = told(options);
  std::vector<GnssFix> fixes;
  io::GnssTextReader gnss(options.gnss_file);
  for (io::GnssTextRecord record; gnss.next(record);) fixes.push_back(fix_of(record));
  reference_nav::NavigationFilter filter(t.parameters, t.gravity);
  FixFeed feed(std::move(fixes));
  io::ImuTextReader imu(options.imu_file);
  ResultFiles files(options.output);
  std::optional<time::Nanoseconds> before;
  ImuSample sample;
  for (io::ImuTextRecord record; imu.next(record); before = record.in_week) {
    if (!before) continue;  // the first line's interval has no known beginning
    sample.interval_ns = (record.in_week - *before).count();
    sample.header.sim_time_ns = sample.header.gps_time_of_week_ns = record.in_week.count();
    sample.header.gps_week = options.gps_week;
    sample.header.sequence_number += 1;
    sample.dtheta_b = record.dtheta_b;
    sample.dv_b = record.dv_b;
    feed.feed(sample.header.sim_time_ns, filter);
    const auto solution = filter.add(sample);
    if (solution && navigates(*solution)) files.write(*solution);
  }
  return finish(files, options, filter);
}

int navigate(const NavigateOptions& options) {
  const bool has_files = !options.imu_file.empty() && !options.gnss_file.empty();
  if (options.log.empty() == !has_files) {
    std::cerr << "inslab navigate: give a log, or --imu and --gnss\n";
    return app::kBadInput;
  }
  if (options.parameters.empty() && options.scenario.empty()) {
    std::cerr << "inslab navigate: give the filter's --parameters, or the --scenario whose sensors it is to match\n";
    return app::kBadInput;
  }
  return has_files ? navigate_files(options) : navigate_log(options);
}

}  // namespace

void add_navigate(CLI::App& app, std::function<int()>& action) {
  auto options = std::make_shared<NavigateOptions>();
  CLI::App* command =
      app.add_subcommand("navigate", "The reference navigation filter offline, on a log or on text files");
  command->add_option("log", options->log, "an MCAP log of Inslab");
  command->add_option("--imu", options->imu_file, "7 columns: seconds of week, dtheta rad, dv m/s, forward-right-down");
  command->add_option("--gnss", options->gnss_file, "7 columns: seconds of week, lat lon deg, height m, sigmas m");
  command->add_option("--parameters", options->parameters, "what the filter believes (config/nav)");
  command->add_option("--scenario", options->scenario,
                      "parameters that match this scenario's sensors; its gravity, with --parameters too");
  command->add_option("--imu-number", options->imu_number, "of a log: inslab/imu/N")->capture_default_str();
  command->add_option("--gnss-number", options->gnss_number, "of a log: inslab/gnss/N")->capture_default_str();
  command->add_option("--week", options->gps_week, "of text files, which do not say it")->capture_default_str();
  command->add_flag("--start-at-truth", options->start_at_truth, "of a log: begin at the IMU's true state");
  command->add_option("-o,--output", options->output, "writes OUTPUT.nav and OUTPUT_sigmas.txt")->required();
  command->callback([&action, options] { action = [options] { return navigate(*options); }; });
}

}  // namespace inslab::cli

#include "inslab/referee/verify/town_drive.hpp"

#include "inslab/data/samples/nav_state.hpp"
#include "inslab/nav/attitude.hpp"
#include "inslab/noise/random/stream.hpp"
#include "inslab/referee/verify/catalogue.hpp"
#include "inslab/referee/verify/navigation_runs.hpp"
#include "inslab/referee/verify/written_rows.hpp"
#include "inslab/sim/offline_run.hpp"

namespace inslab::verify {

namespace {

// The first IMU sample ends an interval after the start of the run, and the rows begin with it.
constexpr double kFirstRow_s = 1.0 / kImuRate_hz;

using scenario::Motion;
using scenario::MotionType;

/// Draws and strings segments together.
class Drive {
 public:
  explicit Drive(std::uint64_t seed) : draws_(seed, "verify/town_drive") {}

  double between(double from, double to) { return from + (to - from) * draws_.uniform(next_++); }
  bool in_share(double share) { return between(0.0, 1.0) < share; }

  void go_on(const char* name, double duration_s, std::vector<Motion> motions = {}) {
    scenario::Segment segment;
    segment.name = name;
    segment.duration_s = duration_s;
    segment.motions = std::move(motions);
    segments.push_back(std::move(segment));
    length_s += duration_s;
  }
  void change_speed(const char* name, double duration_s, double to_m_per_s) {
    Motion motion;
    motion.type = MotionType::TargetSpeed;
    motion.final_speed_m_per_s = to_m_per_s;
    go_on(name, duration_s, {motion});
  }
  void turn(const char* name, double duration_s, scenario::Axis axis, double angle_deg) {
    Motion motion;
    motion.type = MotionType::Turn;
    motion.axis = axis;
    motion.angle_deg = angle_deg;
    go_on(name, duration_s, {motion});
  }
  void uneven(double duration_s, double amplitude_m_per_s2) {
    Motion motion;
    motion.type = MotionType::SineAccel;
    motion.amplitude_m_per_s2 = amplitude_m_per_s2;
    motion.period_s = duration_s / 3.0;
    go_on("uneven traffic", duration_s, {motion});
  }

  std::vector<scenario::Segment> segments;
  double length_s = 0.0;

 private:
  random::Stream draws_;
  std::uint64_t next_ = 0;
};

void drive_a_leg(Drive& drive) {
  drive.change_speed("speed up", drive.between(8.0, 14.0), drive.between(8.0, 14.0));
  const double slope_deg = drive.between(-1.5, 1.5);
  drive.turn("onto the slope", 3.0, scenario::Axis::Y, slope_deg);
  drive.uneven(drive.between(15.0, 60.0), drive.between(0.0, 0.5));
  drive.turn("off the slope", 3.0, scenario::Axis::Y, -slope_deg);
  if (drive.in_share(0.3)) {
    drive.change_speed("stop", drive.between(7.0, 12.0), 0.0);
    drive.go_on("wait", drive.between(5.0, 30.0));
    drive.change_speed("pull away", drive.between(5.0, 8.0), drive.between(5.0, 7.0));
  } else {
    drive.change_speed("slow down", drive.between(6.0, 10.0), drive.between(5.0, 7.0));
  }
  const double side = drive.in_share(0.5) ? 1.0 : -1.0;
  drive.turn("turn", drive.between(6.0, 9.0), scenario::Axis::Z, side * drive.between(70.0, 110.0));
}

/// Writes what a filter finds.
class Recorder : public sim::RunSink {
 public:
  Recorder(const navigation::NavigationParameters& parameters, const nav::Gravity& gravity, const std::string& name)
      : filter_(parameters, gravity), rows_(name) {}

  void journal(const catalog::AnyProfile&) override {}
  void truth(const TruthState&) override {}
  void imu(std::size_t, const ImuSample& sample, const ImuTruth& truth) override {
    if (filter_.filter() == nullptr) {
      filter_.start(nav_state(truth), truth.header.sim_time_ns);
    } else {
      filter_.add(sample);
    }
    const nav::NavState& state = filter_.filter()->state();
    TrajectoryRow row;
    row.position = state.position;
    row.v_n = state.v_n;
    row.rpy = nav::rpy_from_quaternion(state.q_nb);
    rows_.add({sample.header.gps_week, sample.header.gps_time_of_week_ns}, row);
  }
  void gnss(std::size_t, const GnssFix& fix) override { filter_.add(fix); }
  void ack(const ProfileAck&) override {}

  std::shared_ptr<const TrajectoryFile> read() { return rows_.read(); }

 private:
  navigation::NavigationFilter filter_;
  WrittenRows rows_;
};

}  // namespace

scenario::Trajectory town_drive(std::uint64_t seed, double standing_s, double duration_s) {
  Drive drive(seed);
  scenario::Trajectory trajectory = catalogue_scenario("vehicle").trajectory;
  trajectory.initial.yaw_deg = drive.between(0.0, 360.0);
  if (standing_s > 0.0) drive.go_on("stand", standing_s);
  while (drive.length_s < duration_s) drive_a_leg(drive);
  trajectory.segments = std::move(drive.segments);
  return trajectory;
}

std::shared_ptr<const TrajectoryFile> recorded_drive(std::uint64_t seed, double standing_s, double duration_s) {
  NavigationSetup setup;
  setup.seed = random::seed_of(seed, "verify/recorded_drive");
  const auto imu = catalogue_profile<ImuErrorProfile>("imu/pos830_thesis");
  setup.imus = {{imu, imu, {}}};
  setup.motion = town_drive(seed, standing_s, duration_s + kFirstRow_s);
  setup.gnss = catalogue_profile<GnssErrorProfile>("gnss/rtk_white");
  setup.duration_s = duration_s + kFirstRow_s;
  setup.outages.first_s = setup.duration_s;
  setup.shifts_s = {0.0};
  const scenario::LoadedScenario loaded = navigation_scenario(setup);
  Recorder recorder(filter_parameters(setup, 0), loaded.gravity_model(), "drive_" + std::to_string(seed));
  sim::OfflineRun run(loaded, kNavigationStart, RunId{}, recorder);
  while (run.step()) {
  }
  return recorder.read();
}

}  // namespace inslab::verify

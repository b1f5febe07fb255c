#include "inslab/referee/predict/response.hpp"

#include <cmath>
#include <stdexcept>

#include "inslab/foundation/files/file_error.hpp"
#include "inslab/foundation/host/host.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/sim/offline_run.hpp"

namespace inslab::predict {
namespace {

constexpr double kRestingStep_s = 10.0, kMovingStep_s = 0.2, kNearestToPoleDeg = 0.1;

class StepSink : public sim::RunSink {
 public:
  StepSink(LinearMotion motion, std::uint32_t number, const StepTaker& take)
      : motion_(std::move(motion)), number_(number), take_(take) {}
  void journal(const catalog::AnyProfile&) override {}
  void truth(const TruthState&) override {}
  void imu(std::size_t, const ImuSample&, const ImuTruth& truth) override {
    if (truth.sensor_number != number_) return;
    if (const std::optional<LinearStep> step = motion_.advance(truth)) take_(*step);
  }
  void gnss(std::size_t, const GnssFix&) override {}
  void ack(const ProfileAck&) override {}

 private:
  LinearMotion motion_;
  std::uint32_t number_;
  const StepTaker& take_;
};

ErrorState drive_of(const ConstantErrors& errors, Vertical vertical) {
  ErrorState drive;
  drive << Vector3::Zero(), errors.accel_n, -errors.gyro_n;
  if (vertical == Vertical::Held) drive[5] = 0.0;
  return drive;
}

}  // namespace

Responses::Responses(const std::vector<ErrorSource>& sources, const nav::Gravity& gravity, Vertical vertical)
    : gravity_(gravity), vertical_(vertical) {
  for (const ErrorSource& source : sources) list_.push_back({source, {}, {}, {}});
}

void Responses::begin(const LinearStep& first) {
  begin_s_ = first.end_s - first.dt_s;
  C_nb_begin_ = first.C_nb;
  closed_.emplace_back(first.position, gravity_);
  for (Response& response : list_) {
    const ConstantErrors errors = constant_errors(response.source, C_nb_begin_);
    ErrorState start;
    start << errors.position_n, errors.velocity_n, errors.phi_n;
    if (vertical_ == Vertical::Held) start[2] = start[5] = 0.0;
    response.time_s.push_back(begin_s_);
    response.errors.push_back(start);
    response.closed.push_back(closed_.front().at(errors, 0.0));
  }
}

void Responses::add(const LinearStep& step) {
  if (closed_.empty()) begin(step);
  for (Response& response : list_) {
    const ErrorState drive = drive_of(constant_errors(response.source, step.C_nb), vertical_);
    response.time_s.push_back(step.end_s);
    response.errors.emplace_back(step.Phi * response.errors.back() + step.Phi_u * drive);
    response.closed.push_back(closed_.front().at(constant_errors(response.source, C_nb_begin_), step.end_s - begin_s_));
  }
}

void steps_at_rest(const ResponseOptions& options, const StepTaker& take) {
  if (!(std::abs(options.latitude_deg) <= 90.0 - kNearestToPoleDeg)) {
    throw std::invalid_argument("the latitude is within 0.1 deg of a pole, where north and east are not defined");
  }
  const nav::Gravity gravity;
  const double step_s = options.step_s > 0.0 ? options.step_s : kRestingStep_s;
  LinearStep step =
      resting_step({options.latitude_deg * units::kDeg, 0.0, options.height_m}, gravity, options.vertical(), step_s);
  const auto count = static_cast<std::int64_t>(std::llround(options.hours * 3600.0 / step_s));
  for (std::int64_t k = 1; k <= count; ++k) {
    step.end_s = static_cast<double>(k) * step_s;
    take(step);
  }
}

void steps_along(const scenario::LoadedScenario& loaded, const ResponseOptions& options, const StepTaker& take) {
  if (loaded.scenario.trajectory.source == scenario::TrajectorySource::VehicleState) {
    throw files::ReadError(loaded.file.string() + ": follows a live vehicle, whose motion is not known beforehand");
  }
  const double step_s = options.step_s > 0.0 ? options.step_s : kMovingStep_s;
  StepSink sink(LinearMotion(loaded.gravity(), options.vertical(), step_s),
                loaded.sensor<catalog::Imu>(options.sensor_number).number, take);
  sim::OfflineRun run(loaded, loaded.start(host::realtime_now()), RunId{}, sink);
  while (run.step()) {
  }
}

}  // namespace inslab::predict

#include "inslab/models/heading/heading_model.hpp"

#include "inslab/models/heading/baseline.hpp"
#include "inslab/nav/direction.hpp"

namespace inslab::heading {

HeadingModel::HeadingModel(const Setup& setup)
    : instrument_(setup),
      outages_(setup.outages, setup.outage_areas),
      ladder_(setup.errors, setup.rate.period_s(), setup.seed, "heading" + std::to_string(setup.sensor_number)),
      noise_(instrument_.stream("baseline"), random::VectorNoise::kNed, setup.rate.period_s()),
      wrong_fixes_(instrument_.stream("wrong_fix"), setup.rate.period_s()) {
  wrong_fixes_.retune(instrument_.errors());
  take_errors_of(instrument_.errors().lesser_solutions.size());
}

void HeadingModel::apply(const HeadingErrorProfile& profile) {
  instrument_.take(profile);
  const Continuity continuity = profile.request.continuity;
  ladder_.retune(profile, continuity);
  sensing::go_on(continuity, instrument_.instant(), noise_, wrong_fixes_);
  wrong_fixes_.retune(profile);
  take_errors_of(profile.lesser_solutions.size());
}

const BaselineErrors& HeadingModel::errors_on(std::size_t rung) const {
  const HeadingErrorProfile& errors = instrument_.errors();
  if (rung < errors.lesser_solutions.size()) return errors.lesser_solutions[rung];
  return errors;
}

FixType HeadingModel::fix_type_on(std::size_t rung) const {
  const HeadingErrorProfile& errors = instrument_.errors();
  return rung < errors.lesser_solutions.size() ? errors.lesser_solutions[rung].fix_type : errors.fix_type;
}

void HeadingModel::take_errors_of(std::size_t rung) {
  const BaselineErrors& errors = errors_on(rung);
  noise_.retune(errors.relative_sigma_ned_m, errors.relative_gm_sigma_ned_m, errors.relative_gm_correlation_time_s);
  rung_ = rung;
}

std::optional<BaselineHeading> HeadingModel::observe(const TruthState& truth) {
  const std::optional<StreamHeader> tagged = instrument_.reach(truth);
  if (!tagged) return std::nullopt;
  const std::uint64_t k = instrument_.instant();
  const std::int64_t time_ns = truth.header.sim_time_ns;
  const FaultProfile& fault = instrument_.fault();

  const SensorSite first = sensor_site(truth, instrument_.installation().lever_arm_v_m);
  const bool signals = !fault.heading_outage && !outages_.covers(time_ns, first.position);
  const std::optional<std::size_t> rung = ladder_.advance(k, time_ns, signals);
  if (rung && *rung != rung_) take_errors_of(*rung);
  const bool is_best = rung && *rung == instrument_.errors().lesser_solutions.size();
  const Vector3 error_ned_m = noise_.advance(k) + wrong_fixes_.advance(k, time_ns, is_best) + fault.wrong_fix_ned_m;
  if (!rung || fix_type_on(*rung) == FixType::None) return std::nullopt;

  const Vector3 measured_ned_m = baseline_s_m(truth, first, instrument_.installation()) + error_ned_m;
  const nav::Direction shown = nav::direction_of(measured_ned_m);
  const Eigen::Matrix<double, 2, 3> D = nav::by_components(measured_ned_m);
  const Vector3 sigma_ned_m = errors_on(*rung).relative_total_sigma_ned_m();
  auto sample = instrument_.labelled<BaselineHeading>(*tagged);
  sample.fix_type = fix_type_on(*rung);
  sample.heading_rad = shown.heading_rad;
  sample.pitch_rad = shown.pitch_rad;
  sample.baseline_m = measured_ned_m.norm();
  sample.heading_sigma_rad = D.row(0).transpose().cwiseProduct(sigma_ned_m).norm();
  sample.pitch_sigma_rad = D.row(1).transpose().cwiseProduct(sigma_ned_m).norm();
  return sample;
}

}  // namespace inslab::heading

#include "inslab/referee/montecarlo/single_run.hpp"

#include <Eigen/Cholesky>

#include "inslab/foundation/time/gps_time.hpp"
#include "inslab/foundation/units/units.hpp"
#include "inslab/models/navigation/processes.hpp"
#include "inslab/referee/score/verdict.hpp"
#include "inslab/sim/drawn_start.hpp"
#include "inslab/sim/offline_run.hpp"

namespace inslab::montecarlo {

namespace {

namespace ref = navigation;

/// A scenario that starts "now" must say the same whenever it is run.
constexpr time::Nanoseconds kNow{std::chrono::seconds(1795600000)};

/// Hands everything to the scorer, and at the study's instants keeps the covariance until the scorer has the error.
class ScoringSink : public sim::RunSink {
 public:
  ScoringSink(const Study& study, std::uint64_t seed)
      : study_(study),
        app_(*study.loaded.scenario.reference_nav),
        spacing_ns_(time::from_seconds(study.loaded.scenario.duration_s / kInstants).count()),
        draws_(seed, "montecarlo/start"),
        scorer_(study.loaded.scenario, options()) {
    scorer_.without_latency("the run was offline");
    for_each_sensor(study.loaded, [this](auto, const auto& sensor) { scorer_.add(sensor.installation, -1); });
  }
  ScoringSink(const ScoringSink&) = delete;
  ScoringSink& operator=(const ScoringSink&) = delete;

  void attach(ref::Navigator* navigator) { navigator_ = navigator; }

  void journal(const catalog::AnyProfile& entry) override {
    const auto* installation = std::get_if<InstallationProfile>(&entry);
    if (installation != nullptr) scorer_.add(*installation, installation->request.apply_at_ns);
  }
  void truth(const TruthState& truth) override { scorer_.add(truth); }
  void imu(std::size_t index, const ImuSample& sample, const ImuTruth& truth) override {
    scorer_.add(sample);
    if (begun_ || study_.loaded.imus[index].number != app_.imu) return;
    if (study_.draw_start) {
      const Vector9 sigmas = ref::initial_sigmas(study_.app.parameters).head<ref::kNavStates>();
      navigator_->start(sim::drawn_start(truth, sigmas, draws_), truth.header.sim_time_ns);
    }
    begun_ = true;
  }
  void gnss(std::size_t, const GnssFix& fix) override { scorer_.add(fix); }
  void nav(const NavSolution& solution) override {
    note_covariance();
    scorer_.add(solution, 0);
  }
  void ack(const ProfileAck&) override {}

  void finish(RunResult& result) {
    scorer_.finish();
    if (scorer_.counts().scored == 0) {
      const std::string& refusal = navigator_->filter().alignment_refusal();
      result.failure = "no solution was scored: " + (refusal.empty() ? "the filter never began" : refusal);
      return;
    }
    result.instants = std::move(instants_);
    note_figures(result);
    for (const score::OutageDrift& outage : scorer_.outages()) {
      if (outage.solutions == 0) continue;
      result.outages.push_back(
          {time::to_seconds(outage.begin_ns), time::to_seconds(outage.end_ns), outage.horizontal_m, outage.vertical_m});
    }
    for (const score::Verdict& verdict : score::judge(scorer_, study_.loaded.scenario.acceptance)) {
      result.acceptance.push_back(
          {score::words_of(verdict.limit), !scenario::is_latency(verdict.limit.metric), verdict.passed, verdict.why});
    }
  }

 private:
  struct Belief {
    std::int64_t sim_time_ns;
    std::uint32_t number;
    ref::Matrix9 P;
  };

  score::Scorer::Options options() {
    score::Scorer::Options options;
    options.imu_number = app_.imu;
    options.gnss_number = app_.gnss;
    options.on_scored = [this](const score::ScoredSolution& scored) { note_instant(scored); };
    return options;
  }

  /// The first solution at or after each instant.
  void note_covariance() {
    const ref::InertialFilter* filter = navigator_->filter().filter();
    if (filter == nullptr) return;
    const auto number = static_cast<std::uint32_t>(filter->time_ns() / spacing_ns_);
    if (number == last_number_ || number > kInstants) return;
    last_number_ = number;
    ref::InertialFilter settled = *filter;
    settled.settle();
    beliefs_.push_back({filter->time_ns(), number, settled.covariance().matrix().topLeftCorner<9, 9>()});
  }

  void note_instant(const score::ScoredSolution& scored) {
    while (!beliefs_.empty() && beliefs_.front().sim_time_ns < scored.sim_time_ns) beliefs_.pop_front();
    if (beliefs_.empty() || beliefs_.front().sim_time_ns != scored.sim_time_ns) return;
    const Belief belief = beliefs_.front();
    beliefs_.pop_front();
    const score::SolutionError& error = scored.error;
    Vector9 e;
    e << error.position_ned_m, error.velocity_ned_m_per_s, error.phi_rad;
    const Vector9 sigma = belief.P.diagonal().cwiseSqrt();
    instants_.push_back({belief.number, time::to_seconds(belief.sim_time_ns), error.position_ned_m, sigma.head<3>(),
                         error.velocity_ned_m_per_s, sigma.segment<3>(3), error.phi_rad / units::kDeg,
                         sigma.tail<3>() / units::kDeg, e.dot(belief.P.llt().solve(e))});
  }

  void note_figures(RunResult& result) const {
    const auto note = [&](scenario::Metric metric, const score::PhaseKey& phase) {
      const auto value = score::figure(scorer_, metric, phase);
      if (value) result.figures.push_back({metric, phase.phase, phase.swap_interval, phase.after_s, *value});
    };
    for (std::size_t i = 0; i < EnumNames<scenario::Metric>::values.size(); ++i) {
      const auto metric = static_cast<scenario::Metric>(i);
      if (scenario::is_of_the_run(metric)) {
        note(metric, {});
        continue;
      }
      for (const auto& [phase, errors] : scorer_.phases()) note(metric, phase);
    }
  }

  const Study& study_;
  const scenario::ReferenceNav& app_;
  std::int64_t spacing_ns_;
  random::Stream draws_;
  score::Scorer scorer_;
  ref::Navigator* navigator_ = nullptr;
  bool begun_ = false;
  std::uint32_t last_number_ = 0;  ///< instant 0 is before the first solution
  std::deque<Belief> beliefs_;
  std::vector<Instant> instants_;
};

}  // namespace

std::optional<RunResult> single_run(const Study& study, std::uint32_t run, const std::function<bool()>& stop) {
  RunResult result;
  result.fingerprint = study.fingerprint;
  result.run = run;
  result.seed = study.seed_of(run);
  try {
    scenario::LoadedScenario loaded = study.loaded;
    loaded.scenario.seed = result.seed;
    ScoringSink sink(study, result.seed);
    sim::OfflineRun offline(loaded, loaded.start(kNow), RunId{}, sink);
    sink.attach(offline.navigator());
    constexpr int kStepsBetweenLooks = 4096;
    for (bool more = true; more;) {
      if (stop()) return std::nullopt;
      for (int i = 0; i < kStepsBetweenLooks && more; ++i) more = offline.step();
    }
    sink.finish(result);
  } catch (const std::exception& error) {
    result.failure = error.what();
  }
  return result;
}

}  // namespace inslab::montecarlo

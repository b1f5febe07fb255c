#include "tests/statistical/faulty_subjects.hpp"

#include "inslab/nav/attitude.hpp"
#include "inslab/nav/wgs84.hpp"

namespace inslab::verify {

namespace {

class DistortedTruth final : public trajectory::TruthModel {
 public:
  DistortedTruth(std::unique_ptr<trajectory::TruthModel> sound, Distortion distortion)
      : sound_(std::move(sound)), distortion_(std::move(distortion)) {}

  TruthState current() const override { return sound_->current(); }
  TruthState advance() override {
    TruthState truth = sound_->advance();
    distortion_(truth);
    return truth;
  }
  time::Nanoseconds end() const override { return sound_->end(); }

 private:
  std::unique_ptr<trajectory::TruthModel> sound_;
  Distortion distortion_;
};

class FaultyMechanization final : public Mechanization {
 public:
  FaultyMechanization(std::unique_ptr<Mechanization> sound, IncrementsChange change,
                      const std::optional<nav::ImuIncrements>& before)
      : sound_(std::move(sound)), change_(std::move(change)), before_(before.value_or(nav::ImuIncrements{})) {}

  void advance(const nav::ImuIncrements& imu) override {
    nav::ImuIncrements changed = imu;
    change_(changed, sound_->state(), before_);
    sound_->advance(changed);
    before_ = imu;
  }
  void hold_vertical(double height_m, double v_d_m_per_s) override { sound_->hold_vertical(height_m, v_d_m_per_s); }
  nav::NavState state() const override { return sound_->state(); }

 private:
  std::unique_ptr<Mechanization> sound_;
  IncrementsChange change_;
  nav::ImuIncrements before_;
};

/// Hands everything on, fixes changed.
class ChangedFixes final : public sim::RunSink {
 public:
  ChangedFixes(sim::RunSink& sink, const std::function<void(GnssFix& fix)>& change) : sink_(sink), change_(change) {}

  void journal(const catalog::AnyProfile& entry) override { sink_.journal(entry); }
  void truth(const TruthState& truth) override { sink_.truth(truth); }
  void imu(std::size_t index, const ImuSample& sample, const ImuTruth& truth) override {
    sink_.imu(index, sample, truth);
  }
  void gnss(std::size_t index, const GnssFix& fix) override {
    GnssFix changed = fix;
    change_(changed);
    sink_.gnss(index, changed);
  }
  void ack(const ProfileAck& ack) override { sink_.ack(ack); }

 private:
  sim::RunSink& sink_;
  const std::function<void(GnssFix& fix)>& change_;
};

}  // namespace

TruthOf truth_with(const Distortion& distortion) {
  return [distortion](const scenario::Trajectory& trajectory, const time::Rate& rate) {
    return std::make_unique<DistortedTruth>(product_truth(trajectory, rate), distortion);
  };
}

InverseOf inverse_with(const Distortion& distortion) {
  return [distortion](const std::shared_ptr<const TrajectoryFile>& file, const nav::Gravity& gravity,
                      const time::Rate& rate) {
    return std::make_unique<DistortedTruth>(product_inverse(file, gravity, rate), distortion);
  };
}

ImuOf imu_set_up_with(const std::function<void(imu::ImuModel::Setup& setup)>& change) {
  return [change](imu::ImuModel::Setup setup) {
    change(setup);
    return product_imu(setup);
  };
}

ImuOf imu_with(const std::function<void(imu::ImuModel::Output& output)>& change) {
  return [change](const imu::ImuModel::Setup& setup) -> Imu {
    return [change, sound = product_imu(setup)](const TruthState& truth) {
      auto output = sound(truth);
      if (output) change(*output);
      return output;
    };
  };
}

ImuOf late_imu(double part_of_a_sample) {
  return [part_of_a_sample](const imu::ImuModel::Setup& setup) -> Imu {
    auto before = std::make_shared<std::optional<imu::ImuModel::Output>>();
    return [part_of_a_sample, before, sound = product_imu(setup)](const TruthState& truth) {
      auto output = sound(truth);
      if (!output) return output;
      const imu::ImuModel::Output now = *output;
      if (*before) {
        const auto mix = [&](Vector3& late, const Vector3& earlier) {
          late = (1.0 - part_of_a_sample) * late + part_of_a_sample * earlier;
        };
        mix(output->sample.dtheta_b, (*before)->sample.dtheta_b);
        mix(output->sample.dv_b, (*before)->sample.dv_b);
        mix(output->truth.accel_error.vibration, (*before)->truth.accel_error.vibration);
      }
      *before = now;
      return output;
    };
  };
}

MechanizationOf mechanization_with(const IncrementsChange& change) {
  return [change](const nav::NavState& start, const nav::Gravity& gravity, const nav::Strapdown::Options& options,
                  const std::optional<nav::ImuIncrements>& before) {
    return std::make_unique<FaultyMechanization>(product_mechanization(start, gravity, options, before), change,
                                                 before);
  };
}

nav::Vector3 coriolis_of_wrong_sign_b(const nav::NavState& state, double dt_s) {
  const nav::Vector3 turning_n =
      2.0 * nav::omega_ie_n(state.position.latitude_rad) + nav::omega_en_n(state.position, state.v_n);
  return state.q_nb.conjugate() * nav::Vector3(2.0 * dt_s * turning_n.cross(state.v_n));
}

Simulation simulation_of(const std::function<void(scenario::LoadedScenario& scenario)>& change) {
  return [change](scenario::LoadedScenario scenario, const time::GpsTime& start, sim::RunSink& sink) {
    change(scenario);
    product_simulation(scenario, start, sink);
  };
}

Simulation simulation_with_fixes(const std::function<void(GnssFix& fix)>& change, const Simulation& sensors) {
  return [change, sensors](const scenario::LoadedScenario& scenario, const time::GpsTime& start, sim::RunSink& sink) {
    ChangedFixes changed(sink, change);
    sensors(scenario, start, changed);
  };
}

}  // namespace inslab::verify

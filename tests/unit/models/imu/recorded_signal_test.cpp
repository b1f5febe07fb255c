#include "inslab/models/imu/recorded_signal.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "inslab/models/imu/imu_model.hpp"
#include "inslab/noise/random/stream.hpp"
#include "tests/unit/models/imu/analytic_motion.hpp"

/// Errors of a recording on a simulated IMU.
namespace inslab::imu {
namespace recorded_signal_test {

/// White noise with a mean, every axis its own.
std::shared_ptr<const RecordedErrors> noise(std::size_t count, double hz) {
  auto recording = std::make_shared<RecordedErrors>();
  recording->rate = time::Rate(hz);
  for (std::size_t k = 0; k < count; ++k) {
    RecordedErrors::Increments& errors = recording->intervals.emplace_back();
    for (std::size_t axis = 0; axis < RecordedErrors::kAxes; ++axis) {
      const random::Stream stream(11, "axis" + std::to_string(axis));
      errors[axis] = 1e-6 * (static_cast<double>(axis) + 1.0) + 1e-5 * stream.normal(k);
    }
  }
  return recording;
}

RecordedError named() {
  RecordedError profile;
  profile.file = "noise.mcap";
  profile.sha256 = std::string(64, 'a');
  return profile;
}

RecordedError from(double seconds) {
  RecordedError profile = named();
  profile.from = RecordingStart::Given;
  profile.from_s = seconds;
  return profile;
}

RecordedSignal::Run run_of(const std::shared_ptr<const RecordedErrors>& recording, double end_s) {
  return {42, "imu0", time::from_seconds(end_s),
          [recording](const std::string&, const std::string&) { return recording; }};
}

Vector3 rotation(const RecordedErrors::Increments& errors) { return {errors[0], errors[1], errors[2]}; }
Vector3 velocity(const RecordedErrors::Increments& errors) { return {errors[3], errors[4], errors[5]}; }

TEST(RecordedSignal, OfTheImusRateIsTheRecordingSampleBySample) {
  const auto recording = noise(400, 200.0);
  const RecordedSignal signal(from(0.5), run_of(recording, 1.0));
  const time::Rate rate(200.0);
  for (std::uint64_t k = 0; k < 200; ++k) {
    const Increments errors = signal.between(rate.at(k).count(), rate.at(k + 1).count());
    EXPECT_EQ(errors.dtheta, rotation(recording->intervals[100 + k]));
    EXPECT_EQ(errors.dv, velocity(recording->intervals[100 + k]));
  }
}

TEST(RecordedSignal, OfAnotherRateLosesNothing) {
  const auto recording = noise(400, 200.0);
  const RecordedSignal signal(from(0.0), run_of(recording, 2.0));
  for (const double hz : {30.0, 77.0, 125.0, 1024.0}) {
    const time::Rate rate(hz);
    Increments sum;
    std::uint64_t k = 0;
    for (; rate.at(k + 1) <= time::from_seconds(2.0); ++k)
      sum += signal.between(rate.at(k).count(), rate.at(k + 1).count());
    sum += signal.between(rate.at(k).count(), time::from_seconds(2.0).count());
    Increments whole;
    for (const auto& errors : recording->intervals) whole += Increments{rotation(errors), velocity(errors)};
    // 2000 roundings of parts of 1e-5 at most.
    EXPECT_LT((sum.dtheta - whole.dtheta).norm(), 1e-17) << hz;
    EXPECT_LT((sum.dv - whole.dv).norm(), 1e-17) << hz;
  }
}

TEST(RecordedSignal, GoesToTheTriadsThatTheProfileNames) {
  RecordedError profile = from(0.0);
  profile.axes = RecordedAxes::Gyro;
  const Increments gyro = RecordedSignal(profile, run_of(noise(400, 200.0), 1.0)).between(0, 5'000'000);
  profile.axes = RecordedAxes::Accel;
  const Increments accel = RecordedSignal(profile, run_of(noise(400, 200.0), 1.0)).between(0, 5'000'000);
  EXPECT_NE(gyro.dtheta, Vector3::Zero());
  EXPECT_EQ(gyro.dv, Vector3::Zero());
  EXPECT_EQ(accel.dtheta, Vector3::Zero());
  EXPECT_NE(accel.dv, Vector3::Zero());
}

TEST(RecordedSignal, BeginsWhereTheSeedSaysAndLastsAsLongAsTheRun) {
  const auto recording = noise(1000, 100.0);
  int other = 0;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    RecordedSignal::Run run = run_of(recording, 9.0);
    run.seed = seed;
    const RecordedSignal signal(named(), run), again(named(), run);
    const Increments first = signal.between(0, 10'000'000);
    EXPECT_EQ(first.dtheta, again.between(0, 10'000'000).dtheta);
    EXPECT_NE(signal.between(8'990'000'000, 9'000'000'000).dtheta, Vector3::Zero());
    if (first.dtheta != rotation(recording->intervals[0])) ++other;
  }
  EXPECT_GT(other, 40);  // of 101 places
}

TEST(RecordedSignal, ThatBeginsLaterThanTheRunIsZeroBefore) {
  const auto recording = noise(400, 200.0);
  const RecordedSignal signal(from(-1.0), run_of(recording, 3.0));
  EXPECT_EQ(signal.between(990'000'000, 995'000'000).dtheta, Vector3::Zero());
  EXPECT_EQ(signal.between(1'000'000'000, 1'005'000'000).dtheta, rotation(recording->intervals[0]));
}

TEST(RecordedSignal, RefusesARunThatIsLongerAndSaysByHowMuch) {
  const auto recording = noise(400, 200.0);
  const auto refusal = [&](const RecordedError& profile, double end_s) -> std::string {
    try {
      RecordedSignal(profile, run_of(recording, end_s));
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal(named(), 2.0), "");
  EXPECT_EQ(refusal(named(), 2.5),
            "noise.mcap: lasts 2 s; the run needs 2.5 s (loop: crossfade goes on after the end)");
  EXPECT_EQ(refusal(from(1.0), 1.5),
            "noise.mcap: lasts 2 s; the run, from 1 s on, needs 2.5 s (loop: crossfade goes on after the end)");
  RecordedError looped = named();
  looped.loop = RecordingEnd::Crossfade;
  looped.crossfade_s = 1.5;
  EXPECT_EQ(refusal(looped, 60.0), "noise.mcap: lasts 2 s; a crossfade of 1.5 s takes twice its own");
  looped.crossfade_s = 0.5;
  EXPECT_EQ(refusal(looped, 60.0), "");
}

TEST(RecordedSignal, GoesOnAfterItsEndWithTheSameMeanAndSpread) {
  const auto recording = noise(4000, 100.0);
  RecordedError profile = from(0.0);
  profile.loop = RecordingEnd::Crossfade;
  profile.crossfade_s = 10.0;
  const RecordedSignal signal(profile, run_of(recording, 300.0));
  // The 1000 samples of each fade, of nine turns of 30 s: 9000 of which the spread is known to 4 sqrt(1 / 18000).
  double sum = 0.0, squares = 0.0;
  int count = 0;
  for (int turn = 1; turn < 10; ++turn) {
    for (int k = 0; k < 1000; ++k, ++count) {
      const std::int64_t at_ns = (turn * 3000 + k) * std::int64_t{10'000'000};
      const double error = signal.between(at_ns, at_ns + 10'000'000).dtheta.x() - 1e-6;
      sum += error;
      squares += error * error;
    }
  }
  // Each turn fades the same two pieces: 1000 values tell.
  EXPECT_NEAR(sum / count, 0.0, 4.0 * 1e-5 / std::sqrt(1000.0));
  EXPECT_NEAR(std::sqrt(squares / count), 1e-5, 4.0 * 1e-5 * std::sqrt(1.0 / 2000.0));
  // No step at the seam: the last sample of a turn is followed by what follows it in the recording.
  const Increments after = signal.between(30'000'000'000, 30'010'000'000);
  EXPECT_NEAR(after.dtheta.x(), recording->intervals[3000][0], 1e-7);
}

TEST(RecordedSignal, IsATermOfTheBudgetAndNothingElse) {
  const nav::Gravity gravity;
  const auto recording = noise(400, 200.0);
  ImuModel::Setup setup{42, 0, time::Rate(200.0), gravity, {}, {}, {}};
  setup.end = time::from_seconds(1.0);
  setup.recordings = run_of(recording, 1.0).find;
  ImuModel plain(setup);
  setup.errors.recorded_error = from(0.0);
  ImuModel grafted(setup);
  for (std::int64_t k = 0; k < 200; ++k) {
    const TruthState truth = test::AnalyticMotion().truth(k, 5'000'000, gravity);
    const auto without = plain.measure(truth), with = grafted.measure(truth);
    if (!with) continue;
    const RecordedErrors::Increments& errors = recording->intervals[static_cast<std::size_t>(k - 1)];
    EXPECT_EQ(with->truth.gyro_error.recorded, rotation(errors));
    EXPECT_EQ(with->truth.accel_error.recorded, velocity(errors));
    EXPECT_EQ(with->sample.dtheta_b, without->sample.dtheta_b + rotation(errors));
    EXPECT_EQ(with->sample.dv_b, without->sample.dv_b + velocity(errors));
  }
}

TEST(RecordedSignal, ThatIsNotThereIsRefusedBeforeItIsSwappedIn) {
  const nav::Gravity gravity;
  ImuModel model({42, 0, time::Rate(200.0), gravity, {}, {}, {}});
  ImuErrorProfile profile;
  profile.recorded_error = named();
  EXPECT_THROW(model.apply(profile), std::invalid_argument);
}

}  // namespace recorded_signal_test
}  // namespace inslab::imu

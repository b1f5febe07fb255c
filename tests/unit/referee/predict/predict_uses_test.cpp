#include "inslab/referee/predict/predict_uses.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <tuple>

#include "inslab/data/catalog/profile_kinds.hpp"
#include "inslab/referee/predict/sensor_terms.hpp"
#include "tests/unit/data/field_changer.hpp"

namespace inslab::predict {
namespace profile_uses_test {

// A new term of a profile is handled, or it is named as left out: there is no third.
TEST(PredictedProfiles, SaysOfEveryFieldOfEveryProfileWhatBecomesOfIt) {
  const std::string file = "common/referee/predict/predict_uses.hpp";
  for_each(catalog::ProfileKinds{}, [&file](auto kind) {
    EXPECT_EQ(profiles::faults_of<typename decltype(kind)::type>(uses_of(kind), file), "");
  });
}

using Term = std::tuple<Triad, TermKind, int, double, double>;

std::vector<Term> terms(const ImuErrorProfile& profile) {
  std::vector<Term> all;
  for (const SensorTerm& term : terms_of(profile)) {
    all.emplace_back(term.triad, term.kind, term.index, term.amplitude, term.correlation_time_s);
  }
  return all;
}

// White noise and the course of the temperature come in beside the terms; non-linearity is a part of the full scale.
TEST(PredictedProfiles, WhatIsSaidToBeHandledOfAnImuMakesATermAndNothingElseDoes) {
  const std::set<std::string> besides{"gyro.arw_deg_per_sqrt_h", "accel.vrw_m_per_s_per_sqrt_h", "temperature[].at_s",
                                      "temperature[].temperature_deg_c"};
  const std::set<std::string> full_scales{"gyro.full_scale_deg_per_s", "accel.full_scale_g"};
  ImuErrorProfile all;
  const auto entries = profiles::detail::numbers_of(all);
  for (const auto& entry : entries) {
    test::FieldChanger set(entry.path, 2.0);
    ImuErrorProfile::fields(all, set);
  }
  for (const auto& entry : entries) {
    if (besides.count(entry.path) == 1) continue;
    ImuErrorProfile changed = all;
    test::FieldChanger change(entry.path, 3.0);
    ImuErrorProfile::fields(changed, change);
    const bool handled = profiles::detail::use_of(kImuErrorUses, entry.path)->what == profiles::FieldUse::What::Handled;
    EXPECT_EQ(terms(changed) != terms(all), handled || full_scales.count(entry.path) == 1) << entry.path;
  }
}

}  // namespace profile_uses_test
}  // namespace inslab::predict

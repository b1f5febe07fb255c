// What a kind of sensor has not is refused as its fault, with the path: kinds times faults, from the catalogue.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "inslab/data/catalog/profile_rules.hpp"

namespace inslab::catalog {
namespace fault_rules_test {

using testing::HasSubstr;

/// Puts on the faults of one kind of sensor alone, one after the other: the n-th with each call.
class NthFaultOfAKind {
 public:
  explicit NthFaultOfAKind(int n) : left_(n) {}
  std::string path, kind;

  template <class T>
  void operator()(const Field& field, T& value) {
    if (field.sensor_kind.empty() || left_-- != 0) return;
    path = field.name;
    kind = field.sensor_kind;
    put_on(value);
  }

 private:
  static void put_on(Vector3& value) { value = Vector3(0.0, 1.0, 0.0); }
  static void put_on(double& value) { value = 1.0; }
  static void put_on(bool& value) { value = true; }
  static void put_on(AxisFault& value) { value = AxisFault::Stuck; }
  static void put_on(FixType& value) { value = FixType::Single; }
  template <class T>
  static void put_on(T&) {
    FAIL() << "no such fault is known here";
  }

  int left_;
};

TEST(FaultRules, AFaultOfOneKindIsTakenForThatKindAloneAndItsPathIsNamed) {
  int n = 0;
  for (;; ++n) {
    FaultProfile profile;
    NthFaultOfAKind put_on(n);
    FaultProfile::fields(profile, put_on);
    if (put_on.path.empty()) break;
    for_each(SensorKinds{}, [&](auto kind) {
      using Kind = typename decltype(kind)::type;
      profile.target = {Kind::kind, 0};
      const auto broken = violation(profile);
      if (Kind::name == put_on.kind) {
        EXPECT_FALSE(broken) << put_on.path << " of " << Kind::name;
      } else {
        ASSERT_TRUE(broken) << put_on.path << " of " << Kind::name;
        EXPECT_EQ(broken->rule, Rule::FaultFitsSensor);
        EXPECT_EQ(broken->path, put_on.path);
        EXPECT_THAT(broken->reason, HasSubstr(put_on.kind));
      }
    });
  }
  EXPECT_GE(n, 31);
}

TEST(FaultRules, EveryKindHasChannelsAndTakesNoneOfAnother) {
  for_each(SensorKinds{}, [](auto of) {
    using Of = typename decltype(of)::type;
    for_each(SensorKinds{}, [](auto target) {
      using Target = typename decltype(target)::type;
      const std::vector<MeasuredChannel> own = measured_channels(Target::kind);
      ASSERT_FALSE(own.empty()) << Target::name << ": no field of its sample is declared as measured";
      for (const MeasuredChannel& channel : measured_channels(Of::kind)) {
        EXPECT_LT(channel.least_shown, channel.most_shown) << channel.name;
        FaultProfile profile;
        profile.target = {Target::kind, 0};
        profile.common.channels.resize(2);
        profile.common.channels[0].channel = std::string(own.front().name);
        profile.common.channels[1].channel = std::string(channel.name);
        const bool is_own =
            std::any_of(own.begin(), own.end(), [&](const auto& each) { return each.name == channel.name; });
        const auto broken = violation(profile);
        ASSERT_EQ(broken.has_value(), !is_own) << channel.name << " of " << Target::name;
        if (is_own) continue;
        EXPECT_EQ(broken->rule, Rule::FaultFitsSensor);
        EXPECT_EQ(broken->path, "channels[1].channel");
        EXPECT_THAT(broken->reason,
                    HasSubstr(std::string(Target::name) + " measures " + std::string(own.front().name)));
      }
    });
  });
}

TEST(FaultRules, AChannelOfOneNumberTakesOneNumber) {
  FaultProfile profile;
  profile.target = {SensorKind::Barometer, 0};
  profile.common.channels.resize(1);
  ChannelFault& fault = profile.common.channels[0];
  fault.channel = "pressure_pa";
  fault.jump = Vector3::Constant(100.0);
  EXPECT_FALSE(violation(profile));
  fault.ramp_per_s = Vector3(1.0, 0.0, 0.0);
  ASSERT_TRUE(violation(profile));
  EXPECT_EQ(violation(profile)->path, "channels[0].ramp_per_s");
}

TEST(FaultRules, WhatComesAndGoesIsAFault) {
  FaultProfile profile;
  profile.common.intermittent_period_s = 2.0;
  ASSERT_TRUE(violation(profile));
  EXPECT_EQ(violation(profile)->rule, Rule::FaultComesAndGoes);
  EXPECT_EQ(violation(profile)->path, "intermittent_period_s");
  profile.common.off = true;
  EXPECT_FALSE(violation(profile));
}

}  // namespace fault_rules_test
}  // namespace inslab::catalog
